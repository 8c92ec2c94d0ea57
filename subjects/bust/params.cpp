#include "subjects/bust/params.h"

#include <limits>

namespace dermis {

const ParameterTable& bust_parameters() {
    using P = BustParams;
    static const ParameterTable table =
        ParameterTableBuilder<P>()
            .number(&P::head_width_mm, "head_width_mm", "mm", 140, 172, "greatest breadth above the ears")
            .number(&P::jaw_width_mm, "jaw_width_mm", "mm", 98, 128, "breadth between the jaw's angles")
            .number(&P::nose_length_mm, "nose_length_mm", "mm", 43, 58, "nasion to the base of the nose")
            .number(&P::nose_width_mm, "nose_width_mm", "mm", 30, 46, "breadth across the wings of the nose")
            .number(&P::lip_fullness, "lip_fullness", "", 0.4, 1.6, "scales the forward swell of the lips")
            .number(&P::ear_length_mm, "ear_length_mm", "mm", 52, 74, "top of the helix to the lobe")
            .number(&P::ear_protrusion_deg, "ear_protrusion_deg", "degrees", 18, 40,
                    "angle between the ear and the side of the head")
            .number(&P::tone, "tone", "", 1, 6, "skin I (very fair) to VI (dark), or between two")
            .number(&P::freckles, "freckles", "", 0, 1, "how many freckles")
            .number(&P::stubble, "stubble", "", 0, 1, "darkness of the shaved beard and hair")
            .number(&P::asymmetry, "asymmetry", "", 0, 2,
                    "0 symmetric; 1 natural, left and right differ by 1 to 2 mm")
            .integer(&P::seed, "seed", "", 0, std::numeric_limits<int32_t>::max(),
                     "changes the pattern of pores, freckles, hairs and the asymmetry")
            .build();
    return table;
}

Result<void> check_bust_params(const BustParams& params) {
    ParameterValues values(bust_parameters());
    values.put_all(params);
    const Result<void> checked = values.check();
    return checked ? checked : Error{"bust: " + checked.error().message};
}

}  // namespace dermis
