#pragma once
// The skin model as a table over melanin and blood, and its inverse: from a colour to pigments.
//
//     const PigmentTable table({});                       // the model's defaults for the other numbers
//     Pigments pigments = table.nearest({0.5, 0.3, 0.2});
//     Rgb colour = table.albedo(pigments);                 // the nearest colour that the two pigments can
//     make

#include <algorithm>
#include <cmath>
#include <vector>

#include "dermis/optics/tissue/skin_model.h"

namespace dermis::inline optics {

struct Pigments {
    double melanin = 0, blood = 0;  ///< volume fractions, as in SkinModel
};

/// Ends of the table. They cover all skins; blood of .2 is a bruise.
inline constexpr double kMostMelanin = 0.5, kMostBlood = 0.2;

/// A fraction as the texel of a map, 0..1, and back. Roots leave 8 bits enough for light skin.
[[nodiscard]] inline double pigment_texel(double fraction, double most) {
    return std::sqrt(std::clamp(fraction / most, 0.0, 1.0));
}
[[nodiscard]] constexpr double pigment_fraction(double texel, double most) {
    return most * texel * texel;
}

/// A check()ed model. Half a second of one core to make; then pure.
class PigmentTable {
  public:
    explicit PigmentTable(const SkinModel& model);

    /// Pigments beyond the table are moved to its ends. Within 0.002 of skin_albedo() (tested).
    [[nodiscard]] Rgb albedo(const Pigments& pigments) const;
    /// The same of texels of maps, moved to 0..1.
    [[nodiscard]] Rgb albedo_of_texels(double melanin, double blood) const;
    /// Least squares of the logarithms, blue by half: shade scales a colour and hardly changes the pigments.
    /// albedo_linear may be 0. Half a microsecond.
    [[nodiscard]] Pigments nearest(const Rgb& albedo_linear) const;

  private:
    struct Root {
        double u, v;  ///< square roots of the fractions over their ends
    };
    [[nodiscard]] Rgb log_albedo(double u, double v) const;
    [[nodiscard]] Root nearest_node(const Rgb& wanted) const;
    [[nodiscard]] Root step_from(const Root& root, const Rgb& wanted) const;

    std::vector<Rgb> logs_;  // rows of blood, both axes even in the square root of the fraction
};

}  // namespace dermis::inline optics
