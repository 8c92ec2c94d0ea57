#pragma once
// Internal to dermis/shading: the functions of a skin whose coefficients are fitted.

#include <string>

#include "dermis/base/result.h"
#include "dermis/optics/gaussian_lobes.h"
#include "dermis/optics/profile.h"

namespace dermis::shading::export_text {

/// skin_diffuse(n_dot_l, curvature_per_mm), with the error of its fit.
[[nodiscard]] Result<std::string> diffuse_function(const GaussianSum& sum);

/// skin_shadow_edge(visibility) for a penumbra of the renderer's default width.
[[nodiscard]] Result<std::string> shadow_function(const Profile& profile);

/// skin_transmittance(thickness_mm), of the constants kSkinWeight0...
[[nodiscard]] std::string transmission_function(const std::vector<ChannelGaussians>& terms);

}  // namespace dermis::shading::export_text
