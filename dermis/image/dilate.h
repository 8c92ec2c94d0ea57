#pragma once
// Grows the islands of a UV atlas into the gutter between them, so that filters at a seam read no
// background.

#include "dermis/image/image.h"

namespace dermis::inline image {

/// Every texel outside the mask and at most `texels` away from it (Euclidean, between centres) becomes a copy
/// of the nearest one inside; ties go to the upper, then the left one. All others stay. `mask` has one
/// channel and the image's size; 0 is outside. Works for every format. 2048x2048 with an eighth of gutter
/// takes about 30 ms.
void dilate(Image& image, const Image& mask, int texels);

}  // namespace dermis::inline image
