#pragma once
/// \file
/// Version of the code that makes a ground truth; part of the key of a cached one.

#include <string_view>

namespace dermis::inline judge {

/// Changes with every change, but of a comment, to base, image, mesh, optics, scene, rays, reference or
/// judge/effect_truth.cpp. Made by the build (cmake/SourceVersion.cmake).
[[nodiscard]] std::string_view truth_version();

}  // namespace dermis::inline judge
