// OBJ, with the input's second half as its MTL. A mesh that loads must pass through all functions on meshes.
// Dictionary: dermis/mesh/obj.cpp dermis/mesh/mtl.cpp

#include <cstdint>
#include <cstdlib>

#include "use_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span bytes = std::as_bytes(std::span(data, size));
    const dermis::ReadSibling read_library =
        [&](const std::string&) -> dermis::Result<std::vector<std::byte>> {
        const auto half = bytes.subspan(size / 2);
        return std::vector<std::byte>(half.begin(), half.end());
    };
    const auto loaded = dermis::parse_mesh(bytes, dermis::MeshFormat::obj, "dir/fuzz.obj", read_library,
                                           {.unit_mm = 10, .max_vertices = 20000});
    if (loaded) dermis::fuzz::use_mesh(*loaded);
    return 0;
}
