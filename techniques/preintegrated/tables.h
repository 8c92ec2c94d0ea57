#pragma once
// What the shaders read about a profile: tables, and the block Skin for shaders without tables.

#include "dermis/optics/preintegration.h"
#include "dermis/technique/technique.h"
#include "techniques/preintegrated/constants.h"

namespace dermis::preintegrated {

struct TableSettings {
    Preintegration how = {};  ///< of every table
    double shadow_width_mm = 2.5;
    bool by_walks = false;        ///< the diffuse table by walks in balls, over their gain
    bool needs_beckmann = false;  ///< otherwise the table is one texel
};

/// skin_lut, skin_rows, skin_beckmann; all 32-bit float with four channels but skin_beckmann, which has one.
/// The scene's own tables replace those of the bakers. With its own diffuse table the harmonics have its
/// factor on variances. Errors: a table of another construction or profile; a zonal table with another factor
/// than the diffuse one.
[[nodiscard]] Result<std::vector<TableImage>> bake_tables(const TableSettings& settings,
                                                          const SkinContext& skin);

/// The values of the block Skin (skin.glsl). The expressions are fitted with `fit` only, in about 20 ms;
/// otherwise they are 0. Errors: more Gaussians than kMaxGaussians, which profiles of other forms never have;
/// what the fits refuse.
[[nodiscard]] Result<std::vector<NamedValue>> skin_values(double shadow_width_mm, const SkinContext& skin,
                                                          bool fit);

}  // namespace dermis::preintegrated
