#pragma once
// The direct-light table: pre-integrated diffuse skin over N.L and curvature (or radius).
//
//     LutOptions options = *lut_options("dermis");        // or "penner", "unity_2011", "faceworks"
//     options.profile = *find_profile("jensen_skin1");
//     Result<Table> table = bake_lut(options);
//     Result<void> written = write_table("skin.exr", *table);   // bake/table_io.h
//
// In a shader: D = texture(lut, vec2(n_dot_l * 0.5 + 0.5, curvature_per_mm / 0.5)).rgb, without mips,
// clamped, not flagged sRGB unless the convention says so; radiance = albedo / pi * D * light irradiance at
// normal incidence.

#include <string_view>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

/// Everything that decides the numbers. The profile's name and the tool are filled into the table's
/// convention.
struct LutOptions {
    Profile profile;
    int width = 256, height = 256;
    Convention convention;
    /// The published program's storage; `automatic` for the convention of Dermis.
    TableStorage storage = TableStorage::automatic;
};

/// "dermis"      sphere, exact; u: N.L -1..1; v: curvature 0..0.5/mm; texel centres.
/// "penner"      ring from -90 to 90 degrees, exact, the same axes (Penner 2011, GPU Pro 2).
/// "unity_2011"  the same ring by taps of 0.05 rad, all variances x 1.414; u: N.L at i/n; v: curvature at
///               0.5 (j+1)/n per mm, v = 0 at the bottom of the picture; linear 8 bit.
/// "faceworks"   ring, 200 taps over +-10 mm of arc (or the whole ring), not normalised; v: curvature
///               0.01..1/mm; stored as difference, 8 bit (NVIDIA FaceWorks 1.0).
/// All start from the GPU Gems 3 profile. Error: an unknown name, with the closest.
[[nodiscard]] Result<LutOptions> lut_options(std::string_view convention_name);

/// v as radius in mm instead of curvature: min and max > 0.
[[nodiscard]] TableAxis curvature_axis(double min_per_mm, double max_per_mm);
[[nodiscard]] TableAxis radius_axis(double min_mm, double max_mm);

/// The table, in float, decoded. Gaussian sums: 512 x 512 in under 10 ms on one core, every value within 1e-6
/// of the integral. Other profiles on the sphere: about 20 microseconds a texel and core, within 1e-6, kept
/// in the cache; on a ring they are refused (a profile with a pole has no ring integral): fit Gaussians first
/// (optics/gaussian_fit.h). Errors: the size, the profile, an axis other than n_dot_l within -1..1 over
/// curvature_per_mm 0..1000 or radius_mm 0.001..1e6, taps of a profile that is not a Gaussian sum.
[[nodiscard]] Result<Table> bake_lut(const LutOptions& options);

}  // namespace dermis::inline bake
