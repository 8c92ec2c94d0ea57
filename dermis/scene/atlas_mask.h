#pragma once
// Which texels of an atlas a mesh uses.

#include "dermis/image/image.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline scene {

/// One channel, u8: 255 where a texel's centre lies in a triangle, 0 elsewhere. UVs outside 0..1 are left
/// out.
[[nodiscard]] Image atlas_mask(const Mesh& mesh, int width, int height);

}  // namespace dermis::inline scene
