#include "dermis/technique/atlas_cull.h"

namespace dermis {
namespace {

int in_tiles(int texels) {
    return (texels + kCullTile - 1) / kCullTile;
}

Vec3 circle(const UvCircle& c) {
    return {c.u, c.v, c.radius};
}

Pass grow_pass(const std::string& from, const std::string& to, bool across, int tiles) {
    return {.name = across ? "cull grow across" : "cull grow down",
            .kind = PassKind::fullscreen,
            .shader = "shared/atlas_tiles_grow.frag",
            .reads = {{"tiles", from}},
            .colors = {{.image = to, .load = LoadOp::discard}},
            .values = {{"step_x", int32_t(across)}, {"step_y", int32_t(!across)}, {"count", int32_t(tiles)}}};
}

}  // namespace

void add_atlas_cull(PassList& list, const AtlasCullSettings& settings) {
    if (!settings.any()) return;
    const ImageSize size = {settings.size, settings.size};
    const ImageSize tiles = {in_tiles(settings.size), in_tiles(settings.size)};
    list.images.push_back({.name = "atlas_visible", .format = ImageFormat::r8, .size = size});
    list.images.push_back({.name = "atlas_tiles", .format = ImageFormat::r8, .size = tiles});
    list.images.push_back({.name = "atlas_tiles_grown", .format = ImageFormat::r8, .size = tiles});
    list.images.push_back({.name = "atlas_depth", .format = ImageFormat::depth32f, .size = size});
    list.passes.push_back({.name = "cull visible",
                           .kind = PassKind::geometry_uv_atlas,
                           .shader = "shared/atlas_visible.frag",
                           .colors = {{.image = "atlas_visible"}},
                           .constants = {{"cull_frustum", int32_t(settings.frustum)},
                                         {"cull_back_face", int32_t(settings.back_face)}},
                           .values = {{"bias", settings.bias},
                                      {"exempt_a", circle(settings.exempt[0])},
                                      {"exempt_b", circle(settings.exempt[1])}}});
    list.passes.push_back({.name = "cull tiles",
                           .kind = PassKind::fullscreen,
                           .shader = "shared/atlas_tiles.frag",
                           .reads = {"atlas_visible"},
                           .colors = {{.image = "atlas_tiles", .load = LoadOp::discard}},
                           .constants = {{"tile", kCullTile}}});
    const int grow = in_tiles(settings.reach_texels);
    list.passes.push_back(grow_pass("atlas_tiles", "atlas_tiles_grown", true, grow));
    list.passes.push_back(grow_pass("atlas_tiles_grown", "atlas_tiles", false, grow));
    list.passes.push_back({.name = "cull depth",
                           .kind = PassKind::fullscreen,
                           .shader = "shared/atlas_depth.frag",
                           .reads = {{"tiles", "atlas_tiles"}},
                           .depth = DepthTarget{.image = "atlas_depth", .compare = Compare::always},
                           .constants = {{"tile", kCullTile}}});
}

void keep_unculled(Pass& pass, const AtlasCullSettings& settings) {
    if (!settings.any()) return;
    pass.depth =
        DepthTarget{.image = "atlas_depth", .load = LoadOp::load, .write = false, .compare = Compare::equal};
    for (ColorTarget& color : pass.colors)
        if (color.load == LoadOp::discard) color.load = LoadOp::clear;
}

}  // namespace dermis
