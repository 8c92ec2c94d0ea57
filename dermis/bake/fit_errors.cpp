#include "dermis/bake/fit_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dermis/base/text.h"
#include "dermis/optics/curve_2015.h"

namespace dermis::inline bake {
namespace {

constexpr int kCosines = 257;

double cosine(int i) {
    return -1 + 2.0 * i / (kCosines - 1);
}

double largest(const Rgb& error) {
    return std::max({error[0], error[1], error[2]});
}

template <class Fitted>
Rgb largest_difference(std::span<const double> exact_rgb, Fitted fitted) {
    Rgb worst = {};
    for (int i = 0; i < kCosines; ++i) {
        const Rgb value = fitted(cosine(i));
        for (size_t c = 0; c < 3; ++c)
            worst[c] = std::max(worst[c], std::abs(value[c] - exact_rgb[3 * size_t(i) + c]));
    }
    return worst;
}

}  // namespace

std::vector<FitErrors> measure_fit_errors(const ClosedForm& form, const GaussianSum& profile,
                                          std::span<const double> radii_mm) {
    std::vector<double> cosines(kCosines), sphere(3 * kCosines), ring(3 * kCosines);
    for (int i = 0; i < kCosines; ++i) cosines[size_t(i)] = cosine(i);
    DiffuseRows sphere_rows(cosines, {}), ring_rows(cosines, kYeung2015Ring);
    std::vector<FitErrors> errors;
    for (const double radius_mm : radii_mm) {
        sphere_rows.evaluate(profile, radius_mm, sphere);
        ring_rows.evaluate(profile, radius_mm, ring);
        const auto closed = [&](double t) { return evaluate(form, t, 1 / radius_mm); };
        const auto curve = [&](double t) { return curve_2015_direct(t, 1 / radius_mm); };
        errors.push_back({.radius_mm = radius_mm,
                          .closed_form = largest_difference(sphere, closed),
                          .curve_sphere = largest_difference(sphere, curve),
                          .curve_ring = largest_difference(ring, curve)});
    }
    return errors;
}

std::string fit_error_table(std::span<const FitErrors> errors) {
    std::string text =
        "| r, mm | closed form | curve_2015 | curve_2015 against its ring |\n|---|---|---|---|\n";
    for (const FitErrors& e : errors) {
        char line[128];
        std::snprintf(line, sizeof line, "| %s | %.5f | %.4f | %.4f |\n", to_text(e.radius_mm).c_str(),
                      largest(e.closed_form), largest(e.curve_sphere), largest(e.curve_ring));
        text += line;
    }
    return text;
}

Plot fit_error_plot(std::span<const FitErrors> errors, const std::string& profile_name) {
    Plot plot{.title = "Largest error over N.L of two fits, " + profile_name,
              .caption = "against the sphere; dotted: against the full ring; grey: half an 8-bit code",
              .panel_width_px = 560};
    PlotPanel panel{.x = {.label = "r (mm)", .scale = PlotScale::logarithmic},
                    .y = {.label = "largest error", .scale = PlotScale::logarithmic}};
    constexpr const char* kChannels[3] = {"red", "green", "blue"};
    std::vector<double> radii, half_code(errors.size(), 0.5 / 255);
    for (const FitErrors& e : errors) radii.push_back(e.radius_mm);
    const auto add = [&](const std::string& name, const Rgb FitErrors::*member, size_t c, PlotStroke stroke) {
        std::vector<double> values;
        for (const FitErrors& e : errors) values.push_back((e.*member)[c]);
        panel.series.push_back(
            {.name = name, .x = radii, .y = values, .color = std::string(kPlotChannel[c]), .stroke = stroke});
    };
    for (size_t c = 0; c < 3; ++c)
        add(std::string("closed form, ") + kChannels[c], &FitErrors::closed_form, c, PlotStroke::solid);
    for (size_t c = 0; c < 3; ++c)
        add(std::string("curve_2015, ") + kChannels[c], &FitErrors::curve_sphere, c, PlotStroke::dashed);
    for (size_t c = 0; c < 3; ++c) add("", &FitErrors::curve_ring, c, PlotStroke::dotted);
    panel.series.push_back({.name = "", .x = radii, .y = half_code, .color = "#868e96", .width_px = 1});
    plot.panels.push_back(std::move(panel));
    return plot;
}

}  // namespace dermis::inline bake
