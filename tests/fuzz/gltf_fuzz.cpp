// glTF as JSON or GLB, by its first bytes. Its external buffers are the input itself.
// Dictionary: dermis/mesh/gltf/*.cpp

#include <cstdint>

#include "dermis/mesh/mesh_poser.h"
#include "dermis/mesh/rig.h"
#include "dermis/mesh/write_mesh.h"
#include "use_mesh.h"

namespace {

// As a head is exported: with its rig, in a file that loads again.
void use_rig(std::span<const std::byte> bytes, const dermis::ReadSibling& read_buffer,
             const dermis::Mesh& mesh, const dermis::Pose& pose) {
    if (mesh.file_vertices.empty()) return;  // nothing in the file moves
    const auto rig = dermis::read_rig(bytes, "dir/fuzz.gltf", read_buffer, mesh, pose, {.name = "root"});
    if (!rig) return;
    const auto written = dermis::glb_bytes(mesh, {}, {}, {}, &*rig);
    if (!written) return;
    const auto again = dermis::parse_mesh(*written, dermis::MeshFormat::gltf, "dir/written.glb", read_buffer,
                                          {.max_vertices = 100000});
    dermis::fuzz::require(bool(again));
    dermis::fuzz::use_mesh(*again);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span bytes = std::as_bytes(std::span(data, size));
    const dermis::ReadSibling read_buffer =
        [&](const std::string&) -> dermis::Result<std::vector<std::byte>> {
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    const auto loaded = dermis::parse_mesh(bytes, dermis::MeshFormat::gltf, "dir/fuzz.gltf", read_buffer,
                                           {.max_vertices = 20000});
    if (loaded) dermis::fuzz::use_mesh(*loaded);
    const dermis::Pose pose = {.clip = "#1", .time_s = 0.6, .loop = size % 2 == 0, .morph = {{"#1", 0.5f}}};
    const auto posed = dermis::parse_mesh(bytes, dermis::MeshFormat::gltf, "dir/fuzz.gltf", read_buffer,
                                          {.max_vertices = 20000, .pose = pose});
    if (posed) {
        dermis::fuzz::use_mesh(*posed);
        use_rig(bytes, read_buffer, posed->mesh, pose);
    }
    const auto poser =
        dermis::MeshPoser::create(bytes, "dir/fuzz.gltf", read_buffer, {.max_vertices = 20000});
    if (poser)
        for (const dermis::Pose& moment : {pose, dermis::Pose{}}) (void)poser->pose(moment);
    return 0;
}
