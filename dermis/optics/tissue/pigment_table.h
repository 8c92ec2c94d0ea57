#pragma once
// The skin model as a table over melanin and blood, and its inverse: from a colour to pigments.
//
//     const PigmentTable table({});                       // the model's defaults for the other numbers
//     Pigments pigments = table.nearest({0.5, 0.3, 0.2});
//     Rgb colour = table.albedo(pigments);                 // the nearest colour that the two pigments can
//     make

#include <vector>

#include "dermis/optics/tissue/skin_model.h"

namespace dermis::inline optics {

struct Pigments {
    double melanin = 0, blood = 0;  ///< volume fractions, as in SkinModel
};

/// Ends of the table. They cover all skins; blood of .2 is a bruise.
inline constexpr double kMostMelanin = 0.5, kMostBlood = 0.2;

/// A check()ed model. A second of one core to make; then pure.
class PigmentTable {
  public:
    explicit PigmentTable(const SkinModel& model);

    /// Pigments beyond the table are moved to its ends. Within 0.002 of skin_albedo() (tested).
    [[nodiscard]] Rgb albedo(const Pigments& pigments) const;
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
