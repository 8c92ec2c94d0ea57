#include "dermis/technique/atlas_cull.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shaders/atlas/constants.h"

namespace dermis::inline technique {
namespace {

int in_tiles(float texels) {
    return int(std::ceil(texels / float(kCullTile)));
}

// Tiles that the farthest light crosses.
int most_tiles(const AtlasCullSettings& s) {
    return in_tiles(std::min(s.reach_texels + s.reach_steps * s.longest_texels, float(s.size)));
}

Pass over_tiles(std::string name, std::string shader, std::vector<ImageRead> reads, std::string target) {
    return {.name = std::move(name),
            .kind = PassKind::fullscreen,
            .shader = "atlas/" + std::move(shader),
            .reads = std::move(reads),
            .colors = {{.image = std::move(target), .load = LoadOp::discard}}};
}

// "atlas_reach": how many tiles the light of each tile may come from.
void add_reach(PassList& list, const AtlasCullSettings& settings) {
    for (const bool across : {true, false}) {
        Pass pass = over_tiles(across ? "cull reach across" : "cull reach down", "cull_reach.frag",
                               {{"tiles", across ? "atlas_tiles" : "atlas_steps"}},
                               across ? "atlas_steps" : "atlas_reach");
        pass.values = {{"across", int32_t(across)},
                       {"most_tiles", int32_t(most_tiles(settings))},
                       {"reach_texels", settings.reach_texels},
                       {"reach_steps", settings.reach_steps}};
        list.passes.push_back(std::move(pass));
    }
}

// The tiles of `from`, and those in reach of them.
void add_growth(PassList& list, const AtlasCullSettings& settings, const std::string& from,
                const std::string& to, const std::string& suffix) {
    for (const bool across : {true, false}) {
        Pass pass =
            over_tiles((across ? "cull grow across" : "cull grow down") + suffix, "cull_tiles_grow.frag",
                       {{"tiles", across ? from : "atlas_tiles_across"}, {"reach", "atlas_reach"}},
                       across ? "atlas_tiles_across" : to);
        pass.values = {{"across", int32_t(across)}, {"most_tiles", int32_t(most_tiles(settings))}};
        list.passes.push_back(std::move(pass));
    }
}

void add_images(PassList& list, const AtlasCullSettings& settings) {
    const ImageSize size = {settings.size, settings.size};
    const int side = in_tiles(float(settings.size));
    const auto add = [&](const char* name, ImageFormat format, ImageSize of) {
        list.images.push_back({.name = name, .format = format, .size = of});
    };
    add("atlas_visible", ImageFormat::r8, size);
    add("atlas_depth", ImageFormat::depth32f, size);
    add("atlas_tiles", ImageFormat::rg16f, {side, side});
    add("atlas_steps", ImageFormat::rgba16f, {side, side});
    for (const char* name : {"atlas_reach", "atlas_tiles_across", "atlas_tiles_grown"})
        add(name, ImageFormat::r16f, {side, side});
    if (!settings.across_seams) return;
    for (const char* name : {"atlas_tiles_seams", "atlas_tiles_beyond"})
        add(name, ImageFormat::r16f, {side, side});
}

}  // namespace

void add_atlas_cull(PassList& list, const AtlasCullSettings& settings) {
    if (!settings.any()) return;
    add_images(list, settings);
    list.passes.push_back({.name = "cull visible",
                           .kind = PassKind::geometry_uv_atlas,
                           .shader = "atlas/cull_visible.frag",
                           .colors = {{.image = "atlas_visible"}},
                           .constants = {{"cull_frustum", int32_t(settings.frustum)},
                                         {"cull_back_face", int32_t(settings.back_face)},
                                         {"keep_thin", int32_t(settings.keep_thin)}}});
    const bool by_steps = settings.reach_steps > 0;
    Pass tiles = over_tiles("cull tiles", "cull_tiles.frag",
                            {"atlas_visible", {"atlas_metric", by_steps ? "atlas_metric" : "atlas_visible"}},
                            "atlas_tiles");
    tiles.constants = {{"by_steps", int32_t(by_steps)}};
    list.passes.push_back(std::move(tiles));
    add_reach(list, settings);
    add_growth(list, settings, "atlas_tiles", "atlas_tiles_grown", "");
    std::string beyond = "atlas_tiles_grown";
    // Light from across a seam is in gutters: the tiles of those are needed too, and what is in reach of
    // them.
    if (settings.across_seams) {
        beyond = "atlas_tiles_beyond";
        list.passes.push_back(over_tiles("cull seams", "cull_tiles_seams.frag",
                                         {{"tiles", "atlas_tiles_grown"}, "seam_map"}, "atlas_tiles_seams"));
        add_growth(list, settings, "atlas_tiles_seams", beyond, " beyond seams");
    }
    list.passes.push_back({.name = "cull depth",
                           .kind = PassKind::fullscreen,
                           .shader = "atlas/cull_depth.frag",
                           .reads = {{"tiles", "atlas_tiles_grown"}, {"tiles_beyond", beyond}},
                           .depth = DepthTarget{.image = "atlas_depth", .compare = Compare::always}});
}

void keep_unculled(Pass& pass, const AtlasCullSettings& settings) {
    if (!settings.any()) return;
    pass.depth =
        DepthTarget{.image = "atlas_depth", .load = LoadOp::load, .write = false, .compare = Compare::equal};
    for (ColorTarget& color : pass.colors)
        if (color.load == LoadOp::discard) color.load = LoadOp::clear;
}

}  // namespace dermis::inline technique
