#pragma once
// Colours of other tools' files to linear Rec. 709 (white D65), the primaries of everything here.

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// From ACEScg (AP1, white D60), Bradford-adapted.
[[nodiscard]] inline Rgb rec709_from_acescg(const Rgb& c) {
    return {1.70505 * c[0] - 0.62179 * c[1] - 0.08326 * c[2],
            -0.13026 * c[0] + 1.14080 * c[1] - 0.01055 * c[2],
            -0.02400 * c[0] - 0.12897 * c[1] + 1.15297 * c[2]};
}

}  // namespace dermis::inline optics
