#pragma once
// A profile of any model as JSON, to the last bit: what a glTF material keeps beside the volume, which is
// Burley's (gltf_profile.h).

#include <string>
#include <string_view>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// "model" is gaussians, burley, dipole or table; lengths in mm, as the members of the models are named.
[[nodiscard]] std::string exact_profile_json(const Profile& profile);
/// Errors: no JSON, an unknown model, a member that is missing or of another type, what check() refuses.
[[nodiscard]] Result<Profile> parse_exact_profile(std::string_view json);

}  // namespace dermis::inline optics
