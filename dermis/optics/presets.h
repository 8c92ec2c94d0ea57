#pragma once
// Published skins by name.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis {

/// In the order of the tables in docs/profiles.md.
[[nodiscard]] std::vector<std::string> profile_names();

/// A preset's name, the path of a profile CSV (profile_file.h), or "burley:R,G,B" with three lengths d in mm
/// (one number for all three) and albedo 1. Errors: an unknown name proposes the closest; files as
/// read_profile_csv.
[[nodiscard]] Result<Profile> find_profile(std::string_view name);

}  // namespace dermis
