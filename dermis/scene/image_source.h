#pragma once
// The picture behind an ImageSource, wherever it is: a file, embedded bytes, or pixels made by code.

#include "dermis/base/result.h"
#include "dermis/image/io.h"
#include "dermis/mesh/material.h"

namespace dermis::inline scene {

/// Pixels made by code are sRGB-encoded when used as a colour. Errors as read_image and decode_image.
[[nodiscard]] Result<Image> load_image_source(const ImageSource& source, ImageUse use);

/// The alpha that cuts a material out: one channel, 1 where its maps have no alpha.
[[nodiscard]] Result<Image> load_alpha(const Material& material);

}  // namespace dermis::inline scene
