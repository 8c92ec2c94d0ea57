#pragma once
// Points of the tangent plane, drawn from a profile that is a sum of Gaussians.

#include "dermis/optics/profile.h"
#include "dermis/rays/random.h"

namespace dermis::inline rays {

struct ProbeAt {
    float density;     ///< of the probes, per mm^2 of the plane: the mean of the channels, over its integral
    Vec3 reflectance;  ///< the profile, red, green, blue in 1 / mm^2
};
[[nodiscard]] ProbeAt probe_at(const GaussianSum& profile, double r_mm);

[[nodiscard]] float sample_probe_radius_mm(const GaussianSum& profile, Pcg32& random);

}  // namespace dermis::inline rays
