#pragma once
// The picture behind an ImageSource, wherever it is: a file, embedded bytes, or pixels made by code.

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/image/io.h"
#include "dermis/mesh/material.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline scene {

/// Pixels made by code are sRGB-encoded when used as a colour. Errors as read_image and decode_image.
[[nodiscard]] Result<Image> load_image_source(const ImageSource& source, ImageUse use);

/// The alpha that cuts a material out: one channel, 1 where its maps have no alpha.
[[nodiscard]] Result<Image> load_alpha(const Material& material);

// Which texels of an atlas a mesh uses.

/// One channel, u8: 255 where a texel's centre lies in a triangle, 0 elsewhere. UVs outside 0..1 are left
/// out.
[[nodiscard]] Image atlas_mask(const Mesh& mesh, int width, int height);

}  // namespace dermis::inline scene
