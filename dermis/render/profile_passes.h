#pragma once
// Skin with several diffusion profiles. Each profile has the technique's passes with tables and images of its
// own. All blur the light of all skin; what they write to the picture is the skin of their profile. So a
// point of skin scatters by its own profile, as in the reference, and the cost of the technique's blurs grows
// with the profiles.

#include <span>
#include <string>
#include <vector>

#include "dermis/technique/pass_list.h"

namespace dermis::inline render {

/// One list from those of each profile, which are of the same technique and settings. Images, tables and
/// baked normals of profile p are named by profile_name(). One list is returned as it is.
[[nodiscard]] PassList join_profiles(std::span<const PassList> lists, std::span<const std::string> tables);

}  // namespace dermis::inline render
