#pragma once
/// \file
/// Version of the code that makes a reference; part of the key of a cached one.

#include <string_view>

namespace dermis::inline judge {

/// Changes with every change, but of a comment, to base, image, mesh, optics, scene, rays, reference or
/// judge/effect_reference.cpp. Made by the build (cmake/SourceVersion.cmake).
[[nodiscard]] std::string_view reference_version();

}  // namespace dermis::inline judge
