#pragma once
// Published skins by name.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// In alphabetical order.
[[nodiscard]] std::vector<std::string> profile_names();

/// A preset's name, the path of a profile CSV (profile_file.h), a MaterialX document (mtlx.h) or a glTF file
/// with skin (gltf_profile.h), "burley:R,G,B" with one or three lengths d in mm and albedo 1, or
/// "skin:melanin=0.02,blood=0.015" (tissue/skin_model.h). Errors: an unknown name; the message has the
/// closest known one; files as the functions that read them.
[[nodiscard]] Result<Profile> find_profile(std::string_view name);

/// Keeps a profile as long as the process runs. Returns the name by which find_profile finds it, one for each
/// content: "object:" with the profile's name, as far as it is plain, and a hash. Safe from any thread.
[[nodiscard]] std::string keep_profile(const Profile& profile);

/// Whether find_profile takes the name for a file's path.
[[nodiscard]] bool is_profile_file(std::string_view name);

}  // namespace dermis::inline optics
