#pragma once
// Light in the penumbra over what the shadow's filter sees there (Penner 2011, shadow scattering), for a
// filter over a round disk whose width in mm is known.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

/// The light's own edge: the default of DrawSettings::penumbra_mm.
inline constexpr double kLightEdgeMm = 2;

/// The filter's width that the renderer has by default and that exported shaders are for.
inline constexpr float kShadowWidthMm = 3;

/// Light for visibilities 0 to 1 in even steps, both ends included, under a filter of `width_mm`. An edge in
/// the light of a disk of kLightEdgeMm, blurred by the profile; what has not arrived at the ends of the
/// filter, where it sees nothing more, is left out by scaling them to 0 and 1. Without that all lit skin
/// would be darker by it (red: 15 % at 2 mm, 8 % at 3 mm, 0.1 % at 16).
[[nodiscard]] Result<std::vector<Rgb>> shadow_ramp(const Profile& profile, double width_mm, int count);

}  // namespace dermis::inline bake
