// thickness MESH MAP.png: the depth of skin behind each texel, for transmission.
#include <cstdio>

#include "dermis/dermis.h"

namespace {

dermis::Result<void> write_thickness(const char* mesh_file, const char* map_file) {
    DERMIS_TRY_ASSIGN(dermis::LoadedMesh loaded, dermis::read_mesh(mesh_file, {.unit_mm = 1.0}));
    const dermis::SceneObject object = {"head", std::move(loaded.mesh), {dermis::MaterialClass::skin}};
    const dermis::BakeMapSettings settings = {
        .kind = dermis::MapKind::thickness, .size = 128, .gutter_texels = 4, .max_mm = 20};
    DERMIS_TRY_ASSIGN(const dermis::BakedMap map, dermis::bake_map({&object, 1}, settings));
    std::printf("thickness up to %.1f mm\n", map.max);
    return dermis::write_map(map_file, map, {mesh_file, settings});
}

}  // namespace

int main(int count, char** words) {
    if (count < 3) return std::fprintf(stderr, "usage: thickness MESH MAP\n"), 2;
    const auto done = write_thickness(words[1], words[2]);
    if (!done) return std::fprintf(stderr, "%s\n", done.error().message.c_str()), 1;
}
