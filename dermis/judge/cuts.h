#pragma once
// Where a mesh is cut, as at a neck, the flesh behind the cut is not in the file. Walks are reflected by the
// cap, so that they find a wedge of flesh there, which returns far more light than a face. Such pixels say
// nothing about a technique and do not count.

#include "dermis/image/image.h"
#include "dermis/scene/scene.h"

namespace dermis::inline judge {

/// How far from a cut skin does not count: several times the way of light in skin.
inline constexpr float kCutMm = 20;

/// One channel: 0 where the pixel's middle shows a point within kCutMm of a cut, else 1. Empty: the scene has
/// no cut, or shows nothing that is farther from one. The borders of a sheet (flesh.h) are none: its body
/// continues by definition. Errors: the ray library fails.
[[nodiscard]] Result<Image> away_from_cuts(const Scene& scene, int width, int height);

}  // namespace dermis::inline judge
