#include "dermis/technique/atlas_cull.h"

#include "shaders/atlas/constants.h"

namespace dermis {
namespace {

int in_tiles(int texels) {
    return (texels + kCullTile - 1) / kCullTile;
}

Vec3 circle(const UvCircle& c) {
    return {c.u, c.v, c.radius};
}

// Grows the tiles of `image`, with `other` for the step between; the result is in `image`.
void add_growth(PassList& list, const std::string& image, const std::string& other, int tiles,
                const std::string& suffix) {
    for (const bool across : {true, false})
        list.passes.push_back(
            {.name = std::string(across ? "cull grow across" : "cull grow down") + suffix,
             .kind = PassKind::fullscreen,
             .shader = "atlas/cull_tiles_grow.frag",
             .reads = {{"tiles", across ? image : other}},
             .colors = {{.image = across ? other : image, .load = LoadOp::discard}},
             .values = {
                 {"step_x", int32_t(across)}, {"step_y", int32_t(!across)}, {"count", int32_t(tiles)}}});
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
                           .shader = "atlas/cull_visible.frag",
                           .colors = {{.image = "atlas_visible"}},
                           .constants = {{"cull_frustum", int32_t(settings.frustum)},
                                         {"cull_back_face", int32_t(settings.back_face)}},
                           .values = {{"bias", settings.bias},
                                      {"exempt_a", circle(settings.exempt[0])},
                                      {"exempt_b", circle(settings.exempt[1])}}});
    list.passes.push_back({.name = "cull tiles",
                           .kind = PassKind::fullscreen,
                           .shader = "atlas/cull_tiles.frag",
                           .reads = {"atlas_visible"},
                           .colors = {{.image = "atlas_tiles", .load = LoadOp::discard}}});
    const int grow = in_tiles(settings.reach_texels);
    add_growth(list, "atlas_tiles", "atlas_tiles_grown", grow, "");
    // Light from across a seam is in gutters: their tiles are needed too, and those in reach of them.
    if (settings.across_seams) {
        list.passes.push_back({.name = "cull seams",
                               .kind = PassKind::fullscreen,
                               .shader = "atlas/cull_tiles_seams.frag",
                               .reads = {{"tiles", "atlas_tiles"}, "seam_map"},
                               .colors = {{.image = "atlas_tiles_grown", .load = LoadOp::discard}}});
        add_growth(list, "atlas_tiles_grown", "atlas_tiles", grow, " beyond seams");
    }
    list.passes.push_back({.name = "cull depth",
                           .kind = PassKind::fullscreen,
                           .shader = "atlas/cull_depth.frag",
                           .reads = {{"tiles", settings.across_seams ? "atlas_tiles_grown" : "atlas_tiles"}},
                           .depth = DepthTarget{.image = "atlas_depth", .compare = Compare::always}});
}

void keep_unculled(Pass& pass, const AtlasCullSettings& settings) {
    if (!settings.any()) return;
    pass.depth =
        DepthTarget{.image = "atlas_depth", .load = LoadOp::load, .write = false, .compare = Compare::equal};
    for (ColorTarget& color : pass.colors)
        if (color.load == LoadOp::discard) color.load = LoadOp::clear;
}

}  // namespace dermis
