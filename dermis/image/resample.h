#pragma once
// Smaller, larger and sampled images. All arithmetic is on linear values: sRGB is decoded before and encoded
// after.

#include <vector>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline image {

/// Kind of the first three channels: numbers to average, or unit vectors to average and normalise.
/// Vectors are n * 0.5 + 0.5 in integer formats and n itself in f16 and f32; a fourth channel is a number.
enum class Texels { values, unit_vectors };

/// To any size, each axis by itself: a box filter where the image shrinks (exact for ratios that are not
/// integers), linear interpolation between texel centres where it grows. Format and encoding stay. Channels
/// are independent: colour is not weighted by alpha. 2048x2048 RGB u8 to half takes about 120 ms.
[[nodiscard]] Image resize(const Image& image, int width, int height, Texels texels = Texels::values);

/// The image and its halves, quarters ... down to 1x1; sides halve rounding down, as Vulkan's levels do. Each
/// level is filtered from the unrounded one before it.
[[nodiscard]] std::vector<Image> mip_chain(const Image& image, Texels texels = Texels::values);

/// Linear interpolation between the four nearest texel centres of an f32 linear image. (0,0) is the upper
/// left corner of the upper left texel, v points down. One channel is returned as grey; missing green and
/// blue are 0, missing alpha is 1. uv may be any finite number; outside 0..1 the border's texels are
/// repeated.
[[nodiscard]] Vec4 sample_bilinear(const Image& image, Vec2 uv);

}  // namespace dermis::inline image
