#pragma once
// What may be varied about the built-in bust, with ranges.

#include <cstdint>

#include "dermis/base/parameter.h"

namespace dermis {

/// Lengths in mm on the finished head; the defaults are an average adult.
struct BustParams {
    double head_width_mm = 155;  ///< greatest breadth above the ears
    double jaw_width_mm = 112;   ///< between the jaw's angles
    double nose_length_mm = 50;  ///< nasion to the base of the nose
    double nose_width_mm = 36;   ///< across the wings
    double lip_fullness = 1;     ///< scales the lips' forward swell
    double ear_length_mm = 63;
    double ear_protrusion_deg = 25;  ///< angle between the ear and the side of the head
    double tone = 2;                 ///< 1 to 6: skin I to VI, and between (image/colour.h)
    double freckles = 0.35;          ///< 0 none, 1 dense
    double stubble = 0.6;            ///< shade of a shaved beard
    double asymmetry = 1;            ///< 0 symmetric, 1 natural (within 2 mm)
    int32_t seed = 1;                ///< pores, freckles, brow hairs, which way the asymmetry goes

    friend bool operator==(const BustParams&, const BustParams&) = default;
};

/// Every member above, with its range.
[[nodiscard]] const ParameterTable& bust_parameters();

/// Error: "bust: parameter 'NAME': 'VALUE' is not in its range, MIN to MAX UNIT" (also for NaN).
[[nodiscard]] Result<void> check_bust_params(const BustParams& params);

}  // namespace dermis
