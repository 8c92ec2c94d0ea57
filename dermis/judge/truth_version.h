#pragma once
/// \file
/// What a cached ground truth depends on beside its scene and settings: the code that makes it.

#include <string_view>

namespace dermis::inline judge {

/// Changes with every change, but of a comment, to base, image, mesh, optics, scene, rays, reference or
/// judge/effect_truth.cpp. Made by the build (cmake/SourceVersion.cmake).
[[nodiscard]] std::string_view truth_version();

}  // namespace dermis::inline judge
