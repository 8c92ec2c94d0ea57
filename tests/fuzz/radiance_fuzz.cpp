// Radiance HDR.
// Dictionary: dermis/image/codec/radiance.cpp

#include "dermis/image/codec/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace dermis;
    const codec::Bytes file = std::as_bytes(std::span(data, size));
    (void)codec::decode_radiance(file, ImageUse::color);
    return 0;
}
