#pragma once
// Reports on profiles: plots, and the tables of docs/profiles.md.

#include <string>
#include <vector>

#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/profile.h"
#include "dermis/plot/plot.h"

namespace dermis::inline bake {

/// The fractions of light whose radii are reported.
inline constexpr double kReportedFractions[] = {0.5, 0.9, 0.99, 0.997};

/// R(r), the light that leaves within r, and the error of the fit; one curve a channel, the fit dashed.
[[nodiscard]] Plot profile_plot(const Profile& profile, const GaussianFit& fit);

/// The light that leaves within r, one panel a channel, one curve a profile.
[[nodiscard]] Plot comparison_plot(const std::vector<Profile>& profiles);

/// "2.675" and "0.36, 0.072, 0.036": four significant digits, one number or three.
[[nodiscard]] std::string number_text(double value);
[[nodiscard]] std::string value_text(const Rgb& value, int count = 3);

/// The tables of `dermis profile table`: presets, tool conventions, one skin in all tools, fit errors.
/// Takes about a second.
[[nodiscard]] std::string profile_tables_markdown();

}  // namespace dermis::inline bake
