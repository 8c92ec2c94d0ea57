#pragma once
// Indirect light: zonal harmonics of pre-integrated skin over curvature.
//
// With the environment's irradiance in spherical harmonics L_lm (radiance), the diffuse light of a point with
// normal n is sum_lm sqrt(4 pi / (2l + 1)) zh_l L_lm Y_lm(n): zh_l takes the place of the clamped cosine's
// coefficients 0.886, 1.023, 0.495 (Ramamoorthi, Hanrahan 2001), which is what curvature 0 gives.

#include <vector>

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

enum class ZonalLayout {
    three_rows,          ///< rows are orders 0, 1, 2; values as they are
    two_rows_remapped_8  ///< orders 0 and 1 only, range 0.75..1.05 as 0..1: the 8-bit texture of published
                         ///< code
};

struct ZonalOptions {
    Profile profile;
    int width = 256;
    TableAxis curvature = {.name = "curvature_per_mm", .unit = "1/mm", .min = 0, .max = 0.5};
    Preintegration how = {};
    ZonalLayout layout = ZonalLayout::three_rows;
};

/// u = curvature (or radius), v = order (texel row l is order l). Errors as bake_lut.
[[nodiscard]] Result<Table> bake_zonal_harmonics(const ZonalOptions& options);

/// The exact values at one radius, for any profile; the options' profile and construction must be valid.
[[nodiscard]] std::array<Rgb, 3> zonal_harmonics_at(const Profile& profile, double radius_mm,
                                                    const Preintegration& how);

}  // namespace dermis::inline bake
