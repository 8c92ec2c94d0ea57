#pragma once
// Relief of the skin that is too fine for the mesh: pores, furrows, folds.

#include <cstdint>

#include "subjects/bust/point.h"
#include "subjects/bust/skin.h"

namespace dermis::bust {

struct Relief {
    float height_mm = 0;  ///< negative in pores and folds
    float pore = 0;       ///< 0 none to about 1.2 in the middle of a deep one
    float cavity = 0;     ///< 0 to 1 where folds and furrows run
};

/// `vermilion`: 0 skin, 1 the red of the lips. About 0.3 microseconds.
[[nodiscard]] Relief relief_at(Point p_standard, const SkinZones& zones, float vermilion, uint32_t seed);

}  // namespace dermis::bust
