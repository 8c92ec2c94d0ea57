#pragma once
// The diffusion profile of a volume by random walks: light enters a half-space diffusely at one point; where
// does it leave? What Burley's fit and the dipole approximate.

#include <array>
#include <functional>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline rays {

/// Called with the share of the walks that are done.
using WalkProfileProgress = std::function<void(double done)>;

/// A table of rings whose radii grow by a fixed ratio, scaled to the walks' own albedo. The error of a share
/// of the light is about 1 / sqrt(walks). Cost: 1 microsecond for each collision of a walk. Errors:
/// an invalid medium, fewer than 3000 walks, a medium that returns no light.
[[nodiscard]] Result<Profile> fit_walk_profile(const ScatteringMedium& medium, int walks, uint32_t seed,
                                               const WalkProfileProgress& progress = {});

/// How far a profile is from another one of the same channel.
struct ProfileError {
    double albedo_ratio;       ///< over the other's
    double mean_ratio;         ///< mean radius over the other's
    double r90_ratio;          ///< radius of 90 % of the light over the other's
    double light_at_distance;  ///< largest difference of their cumulative shares of light, 0..1
};
[[nodiscard]] ProfileError error_of(const Profile& profile, const Profile& by_walks, int channel);

}  // namespace dermis::inline rays
