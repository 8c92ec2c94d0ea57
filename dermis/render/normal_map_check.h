#pragma once
// Whether an image can be the normal map that it is given as.

#include <optional>
#include <string>

#include "dermis/image/image.h"
#include "dermis/mesh/material.h"

namespace dermis::inline render {

/// A probable mistake and its fix, in one line without the file's name: an object-space map given as a
/// tangent-space one, a tangent-space map given as an object-space one, or an image that is not a normal map.
/// A normal map holds unit vectors; those of a tangent-space map point out of the surface, those of a head in
/// object space in all directions. Texels of black or white between the charts do not count.
[[nodiscard]] std::optional<std::string> doubt_of_normal_map(const Image& image, NormalSpace space);

}  // namespace dermis::inline render
