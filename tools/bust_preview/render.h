#pragma once
// A quick, noisy look: one soft key light, a sky, a rim, wrapped diffuse, and light that comes through thin
// places.

#include "subject.h"

namespace dermis::preview {

/// Square, RGB u8 sRGB.
[[nodiscard]] Image render(const Subject& subject, const View& view, int side);

}  // namespace dermis::preview
