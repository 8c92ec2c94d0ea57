// A profile as the volume extensions of a glTF material, JSON or GLB.
// Dictionary: dermis/optics/gltf_profile.cpp

#include <cstdint>
#include <span>

#include "dermis/optics/gltf_profile.h"
#include "use_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    dermis::fuzz::use_profile(dermis::parse_gltf_profile(std::as_bytes(std::span(data, size)), "fuzz.gltf"));
    return 0;
}
