#pragma once
// The profile that an engine's own skin takes, fitted to a skin: its Burley profile in the engine's
// parameters (dermis/optics/conversions.h) as an asset or a script that makes one, and a page with the
// numbers.
//
// Texts are engines/native/<engine>; a word @key@ in them is a parameter of the tool.

#include "dermis/engines/package.h"

namespace dermis::inline engines {

/// "unity_hdrp", "unreal".
[[nodiscard]] std::vector<std::string> native_engine_names();
/// Error: an engine without, with those that have one.
[[nodiscard]] Result<void> check_native_engine(std::string_view engine);

[[nodiscard]] Result<std::vector<PackageFile>> make_native_profile(
    std::string_view engine, const Profile& profile, std::span<const PackageTemplate> templates);

}  // namespace dermis::inline engines
