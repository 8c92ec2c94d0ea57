#pragma once
/// \file
/// Version of the ray casting code; part of the key of a cached result.

#include <string_view>

namespace dermis::inline rays {

/// Changes with every change, but of a comment, to base, mesh or rays. Made by the build
/// (cmake/SourceVersion.cmake).
[[nodiscard]] std::string_view rays_version();

}  // namespace dermis::inline rays
