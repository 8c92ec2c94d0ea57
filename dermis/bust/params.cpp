#include "dermis/bust/params.h"

#include <array>

#include "dermis/base/text.h"

namespace dermis {
namespace {

constexpr std::array kTable = {
    BustParamInfo{"head_width_mm", &BustParams::head_width_mm, "mm", 140, 172,
                  "greatest breadth above the ears"},
    BustParamInfo{"jaw_width_mm", &BustParams::jaw_width_mm, "mm", 98, 128,
                  "breadth between the jaw's angles"},
    BustParamInfo{"nose_length_mm", &BustParams::nose_length_mm, "mm", 43, 58,
                  "nasion to the base of the nose"},
    BustParamInfo{"nose_width_mm", &BustParams::nose_width_mm, "mm", 30, 46,
                  "breadth across the wings of the nose"},
    BustParamInfo{"lip_fullness", &BustParams::lip_fullness, "", 0.4, 1.6,
                  "scales the forward swell of the lips"},
    BustParamInfo{"ear_length_mm", &BustParams::ear_length_mm, "mm", 52, 74, "top of the helix to the lobe"},
    BustParamInfo{"ear_protrusion_deg", &BustParams::ear_protrusion_deg, "degrees", 18, 40,
                  "angle between the ear and the side of the head"},
    BustParamInfo{"tone", &BustParams::tone, "", 1, 6, "skin I (very fair) to VI (dark), or between two"},
    BustParamInfo{"freckles", &BustParams::freckles, "", 0, 1, "how many freckles"},
    BustParamInfo{"stubble", &BustParams::stubble, "", 0, 1, "shade of a shaved beard"},
    BustParamInfo{"asymmetry", &BustParams::asymmetry, "", 0, 2, "1 is natural, about a millimetre"},
};

}  // namespace

std::span<const BustParamInfo> bust_param_table() {
    return kTable;
}

Result<void> check_bust_params(const BustParams& params) {
    for (const BustParamInfo& row : kTable) {
        const double value = params.*row.member;
        if (value >= row.least && value <= row.most) continue;
        std::string message = "bust: " + std::string(row.name) + " is " + to_text(value) +
                              "; it must be between " + to_text(row.least) + " and " + to_text(row.most);
        if (!row.unit.empty()) message += " " + std::string(row.unit);
        return Error{message};
    }
    return {};
}

}  // namespace dermis
