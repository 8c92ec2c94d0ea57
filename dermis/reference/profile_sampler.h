#pragma once
// A diffusion profile made ready for sampling: its reflectance by one table lookup, and radii drawn where
// they add most to the noise.
//
// The exitance at x is a quotient, so a probe at y adds noise as R(r) (E(y) - M(x)). The best density is the
// root of the expected square of that, summed over the channels: sqrt(sum R^2 D). D(r), the expected square
// of the difference, grows with r, so probes lie farther out than the light does.

#include <vector>

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"
#include "dermis/reference/guide_table.h"

namespace dermis::inline reference {

/// Radii are cells of equal ratio. Sampling picks a cell, then a point evenly in its ring, so that the
/// density is known exactly; the reflectance is interpolated (as r * R(r), linear in log r; relative error
/// below 2e-4 within the 99 % radius, tested). Beyond max_mm(), which leaves out 1e-5 of the widest channel,
/// everything is 0.
class ProfileSampler {
  public:
    /// The profile passed check(); width_scale > 0 stretches all radii.
    ProfileSampler(const Profile& profile, double width_scale);

    /// Red, green, blue in 1/mm^2.
    [[nodiscard]] Vec3 reflectance(float r_mm) const;
    [[nodiscard]] float sample_radius_mm(float u) const;
    /// Density of the sampled points, per mm^2 of the plane.
    [[nodiscard]] float density_per_mm2(float r_mm) const;
    [[nodiscard]] float max_mm() const { return max_mm_; }
    /// The integral of reflectance() over the plane.
    [[nodiscard]] Vec3 total() const { return total_; }

  private:
    /// Cell 0 is the disk within least_mm_, cell k the ring up to radius_mm_[k].
    [[nodiscard]] float cell_position(float r_mm) const;

    float least_mm_ = 0, max_mm_ = 0, cells_per_log_ = 0;
    std::vector<float> radius_mm_;          // outer, of every cell
    std::vector<float> cumulative_;         // share of the samples up to that radius
    GuideTable guide_;                      // of cumulative_
    std::vector<float> density_;            // of every cell
    std::vector<Vec3> radius_reflectance_;  // r R(r) at every outer radius
    Vec3 total_;
};

}  // namespace dermis::inline reference
