#pragma once
// The tables that preintegrated.frag reads, baked for a profile.

#include "dermis/bake/shadow_ramp.h"
#include "dermis/optics/preintegration.h"
#include "dermis/technique/technique.h"
#include "techniques/preintegrated/constants.h"

namespace dermis::preintegrated {

struct TableSettings {
    Construction construction = Construction::sphere;  ///< of every table; the published ring is half_ring
    double normal_lod_bias = 3;
    double shadow_width_mm = kShadowWidthMm;
    bool needs_beckmann = false;  ///< otherwise the table is one texel
};

/// skin_lut, skin_rows, skin_beckmann; all 32-bit float with four channels but skin_beckmann, which has one.
[[nodiscard]] Result<std::vector<TableImage>> bake_tables(const TableSettings& settings,
                                                          const SkinContext& skin);

}  // namespace dermis::preintegrated
