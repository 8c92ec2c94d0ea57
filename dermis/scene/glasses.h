#pragma once
// A pair of glasses made by code: an opaque frame and tinted lenses, to cast coloured shadows.

#include "dermis/scene/scene.h"

namespace dermis {

/// Fitted to builtin:bust (mm, origin between the ears); other heads move it by the scene's keys. Materials:
/// "frame" (class other) and "lens" (class translucent), whose opacity map grades from dark violet above to
/// clear below. Each lens is a single sheet, so that light is tinted once; its UVs run over 0..1.
[[nodiscard]] SceneObject make_glasses();

}  // namespace dermis
