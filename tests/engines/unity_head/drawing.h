#pragma once
// A head of an exported Unity package, drawn by the package's own shaders with the declarations of
// tests/engines/urp in place of URP's.

#include "engines/drawn_head/drawing.h"

namespace dermis::unity_head {

/// Linear radiance. Errors: a package without a head, a mistake or a clip that is not known, a light that is
/// not modelled.
[[nodiscard]] Result<Image> draw_head(const drawn_head::Settings& settings);

}  // namespace dermis::unity_head
