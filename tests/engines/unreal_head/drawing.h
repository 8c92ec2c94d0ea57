#pragma once
// A head of an exported Unreal package, as the plugin's script builds it with unreal.py in place of the
// editor: drawn by the text of the Custom node and the plugin's shader files.

#include "engines/drawn_head/drawing.h"

namespace dermis::unreal_head {

/// Linear radiance. Errors: a package without a head, a script that fails, a mistake that is not known, an
/// import setting or a node that is not modelled.
[[nodiscard]] Result<Image> draw_head(const drawn_head::Settings& settings);

}  // namespace dermis::unreal_head
