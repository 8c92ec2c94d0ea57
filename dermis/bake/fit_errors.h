#pragma once
// Errors of the fits against the integral that they replace, over radius.

#include <span>
#include <string>
#include <vector>

#include "dermis/optics/closed_form.h"
#include "dermis/plot/plot.h"

namespace dermis::inline bake {

/// Largest difference over all N.L, red, green, blue.
struct FitErrors {
    double radius_mm = 0;
    Rgb closed_form = {};   ///< against the sphere
    Rgb curve_sphere = {};  ///< curve_2015 against the sphere
    Rgb curve_ring = {};    ///< curve_2015 against kYeung2015Ring, which it was fitted to
};

/// 257 values of N.L a radius, about 1 ms each. The profile has passed check_preintegrable.
[[nodiscard]] std::vector<FitErrors> measure_fit_errors(const ClosedForm& form, const GaussianSum& profile,
                                                        std::span<const double> radii_mm);

/// A Markdown table, a row a radius, the largest of the channels.
[[nodiscard]] std::string fit_error_table(std::span<const FitErrors> errors);

/// Both fits over radius, logarithmic, with half an 8-bit code as a line.
[[nodiscard]] Plot fit_error_plot(std::span<const FitErrors> errors, const std::string& profile_name);

}  // namespace dermis::inline bake
