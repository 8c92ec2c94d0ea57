#pragma once
// The shading functions of one skin as source text: shaders/include/skin with the skin's coefficients.

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"
#include "dermis/shading/shading.h"

namespace dermis::shading {

/// The files of shaders/include/skin, by path.
[[nodiscard]] std::span<const Source> skin_sources();

/// The coefficients and the functions that need them, in the subset of GLSL that read_sources() takes; they
/// include files of skin_sources(). Comments name the profile and the error of each fit.
/// Errors: a profile that cannot be pre-integrated.
[[nodiscard]] Result<Source> profile_source(const Profile& profile);

/// `functions` and profile_source() in one language, every name with the prefix skin_ or kSkin; the heading
/// states units and conventions and has a call of the main functions. With `names` ("skin_diffuse") the text
/// has these and what they need, and the heading a call of each. The same input gives the same bytes.
/// Errors: those of profile_source(), an unknown name.
[[nodiscard]] Result<std::string> skin_text(const Profile& profile, std::span<const Source> functions,
                                            Language language, std::span<const std::string> names = {});

}  // namespace dermis::shading
