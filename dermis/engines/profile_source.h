#pragma once
// A skin's coefficients, and the shading functions for which they are, as source text.

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"
#include "dermis/shading/shading.h"

namespace dermis::inline engines {

/// In the subset of GLSL that dermis/shading reads; it includes files of shaders/include/skin. Comments name
/// the profile and the error of each fit. Errors: a profile that cannot be pre-integrated.
[[nodiscard]] Result<shading::Source> profile_source(const Profile& profile);

/// `functions` (the files of shaders/include/skin) and the profile's, in one language, with a heading that
/// says units and conventions. The same input gives the same bytes.
[[nodiscard]] Result<std::string> skin_text(const Profile& profile,
                                            std::span<const shading::Source> functions,
                                            shading::Language language);

}  // namespace dermis::inline engines
