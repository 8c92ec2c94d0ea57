#pragma once
// The profile that an engine's own skin takes, fitted to a skin, as an asset or a script that makes one, and
// a page with the numbers. Most engines blur by Burley's profile and take the skin's in their parameters
// (dermis/optics/conversions.h). Godot has a kernel of its own, whose width is fitted
// (dermis/optics/artistic_kernel.h).
//
// Texts are engines/native/<engine>; a word @key@ in them is a parameter of the engine.

#include "dermis/engines/package.h"

namespace dermis::inline engines {

/// "unity_hdrp", ...
[[nodiscard]] std::vector<std::string> native_engine_names();
/// Error: an engine without, with those that have one.
[[nodiscard]] Result<void> check_native_engine(std::string_view engine);

/// The files by their paths in a folder; the same input gives the same bytes. Errors: an engine without; a
/// profile that is too narrow for the engine's blur.
[[nodiscard]] Result<std::vector<PackageFile>> make_native_profile(
    std::string_view engine, const Profile& profile, std::span<const PackageTemplate> templates);

}  // namespace dermis::inline engines
