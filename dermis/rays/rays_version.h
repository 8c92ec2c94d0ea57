#pragma once
/// \file
/// What a cached result of ray casting depends on beside its mesh and settings: the code that makes it.

#include <string_view>

namespace dermis::inline rays {

/// Changes with every change, but of a comment, to base, mesh or rays. Made by the build
/// (cmake/SourceVersion.cmake).
[[nodiscard]] std::string_view rays_version();

}  // namespace dermis::inline rays
