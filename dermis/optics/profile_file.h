#pragma once
// Profiles as CSV: commas, one header line, '#' begins a comment line, numbers with a point.
//
//   r_mm,r,g,b           a table: R(r) in 1/mm^2 at increasing radii (tabulated_profile.h)
//   variance_mm2,r,g,b   a sum of Gaussians: weights whose sum per channel is the albedo

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// `place` names the text in errors: "skin.csv:3: ...". The profile's name is the file's stem.
[[nodiscard]] Result<Profile> parse_profile_csv(std::string_view text, std::string_view place);
[[nodiscard]] Result<Profile> read_profile_csv(const std::filesystem::path& path);

/// The same format; sums of Gaussians as such, every other model as a table over `radii_mm`.
[[nodiscard]] std::string profile_csv(const Profile& profile, std::span<const double> radii_mm);

}  // namespace dermis::inline optics
