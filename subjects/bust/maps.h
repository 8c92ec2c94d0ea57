#pragma once
// The skin painted into the atlas.

#include "dermis/image/image.h"
#include "subjects/bust/atlas.h"
#include "subjects/bust/params.h"

namespace dermis::bust {

struct SkinMaps {
    Image albedo;          ///< RGB u8, sRGB
    Image normal;          ///< RGB u8, tangent space: x along +u, y up the image, z out
    Image roughness;       ///< one channel u8, perceptual
    Image specular;        ///< one channel u8, factor on F0
    Image kernel_size;     ///< one channel u8: 0 on thick skin, more where it is thin
    Image melanin, blood;  ///< one channel u8, as `dermis bake pigments` has them
};

/// Square maps of `side` texels; every chart is continued kGutter texels (at 2048) past its edge. About 4 s
/// of one core at 2048.
[[nodiscard]] SkinMaps paint_maps(const Atlas& atlas, const BustField& field, const BustParams& params,
                                  int side);

/// The triangle whose flat image covers the middle of each texel, row by row; -1 outside every chart. Texels
/// within `gutter` of a chart get the triangle nearest by steps.
[[nodiscard]] std::vector<int> rasterize(const Atlas& atlas, int side, int gutter);

}  // namespace dermis::bust
