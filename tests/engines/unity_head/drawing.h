#pragma once
// A head of an exported Unity package, drawn by the package's own shaders with the declarations of
// tests/engines/urp in place of URP's.

#include <filesystem>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "engines/unity_head/pose.h"

namespace dermis::unity_head {

struct DrawingSettings {
    std::filesystem::path package;
    int side = 96, points = 4;  ///< pixels; points along a side of a pixel
    bool gain = false, lambert = false;
    Moment moment;
    /// "normals": baked normals are not bound; "curvature": in 1/m; "srgb": directions imported as colours;
    /// "frames": the bakes do not turn with the surface.
    std::string mistake;
};

/// Linear radiance. Errors: a package without a head, a mistake or a clip that is not known, a light that is
/// not modelled.
[[nodiscard]] Result<Image> draw_head(const DrawingSettings& settings);

}  // namespace dermis::unity_head
