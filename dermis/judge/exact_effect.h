#pragma once
// The effect of scattering as a picture where a subject knows it exactly: what reference and techniques are
// both held against.

#include "dermis/image/image.h"
#include "dermis/scene/subject.h"

namespace dermis::inline judge {

/// RGB, the effect of the key light alone: other lights must not be there. Averaged over the same grid x grid
/// points of a pixel as reference and techniques; 0 where no skin is seen. Errors: maps, profile, the ray
/// library.
[[nodiscard]] Result<Image> exact_effect(const Scene& scene, const ExactExitance& exact, int width,
                                         int height, int grid, float penumbra_mm);

}  // namespace dermis::inline judge
