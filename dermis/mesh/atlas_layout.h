#pragma once
// One atlas for surfaces whose UVs share texels: materials that each have 0..1, UDIM tiles, mirrored halves,
// tiled patches.
//
// Triangles that share no texels stay together in a layer, a piece of a UV plane. The atlas has layers as
// large as their area on the surface, packed by their outlines (mesh/pack_charts.h). Triangles without UVs,
// and those whose UVs fold over themselves, get new ones (mesh/unwrap.h).

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/uv_seams.h"

namespace dermis::inline mesh {

struct AtlasLayout {
    bool is_as_it_was = false;  ///< the UVs lie in 0..1 and share no texels: the rest is empty
    struct Corners {
        std::array<Vec2, 3> uvs;  ///< in 0..1
        uint32_t layer = 0;       ///< two triangles of one layer that share a vertex agree on its place
    };
    std::vector<std::vector<Corners>> parts;  ///< of each part's triangles, in their order
    uint32_t layers = 0;
};

/// Share of its texels that a layer may have under more than one triangle; exporters round.
inline constexpr double kOverlapOfLayer = 0.01;

[[nodiscard]] AtlasLayout lay_out_atlas(std::span<const AtlasPart> parts);

}  // namespace dermis::inline mesh
