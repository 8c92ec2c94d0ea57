#include "dermis/bake/profile_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "dermis/optics/check_value.h"
#include "dermis/optics/presets.h"

namespace dermis::inline bake {
namespace {

constexpr int kSamples = 160;

// Evenly spaced in r, or in log r.
std::vector<double> radii_mm(double from, double to, PlotScale scale) {
    std::vector<double> radii;
    for (int i = 0; i < kSamples; ++i) {
        const double t = i / double(kSamples - 1);
        radii.push_back(scale == PlotScale::linear ? std::lerp(from, to, t) : from * std::pow(to / from, t));
    }
    return radii;
}

template <class OfRadius>
PlotSeries series(std::string name, std::string_view color, const std::vector<double>& radii,
                  OfRadius of_radius) {
    PlotSeries out{.name = std::move(name), .x = radii, .color = std::string(color)};
    for (const double r : radii) out.y.push_back(of_radius(r));
    return out;
}

double largest_radius_mm(const Profile& profile, double fraction) {
    double largest = 1e-6;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, inverse_cdf_mm(profile, c, fraction));
    return largest;
}

std::string percent(double part) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, 100 * part, std::chars_format::fixed, 2);
    return std::string(buffer, end.ptr) + " %";
}

std::string of_channels(double (*property)(const Profile&, int), const Profile& profile) {
    return value_text({property(profile, 0), property(profile, 1), property(profile, 2)});
}

std::string presets_table() {
    std::string out =
        "| name | model | albedo | mean radius mm | Burley d mm | 90 % radius mm | fit of 6 Gaussians |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const std::string& name : profile_names()) {
        const Profile profile = *find_profile(name);
        const GaussianFit fit = to_gaussian_sum(profile);
        const bool exact = std::holds_alternative<GaussianSum>(profile.model);
        Rgb r90;
        for (int c = 0; c < 3; ++c) r90[size_t(c)] = inverse_cdf_mm(profile, c, 0.9);
        out += "| `" + name + "` | " + model_name(profile) + " | " + of_channels(diffuse_albedo, profile) +
               " | " + of_channels(mean_radius_mm, profile) + " | " +
               value_text(burley_equivalent(profile).d_mm) + " | " + value_text(r90) + " | " +
               (exact ? "exact" : percent(*std::ranges::max_element(fit.max_error))) + " |\n";
    }
    return out;
}

std::string conventions_table() {
    std::string out = "| tool | its length is | boundary | keys, unit | not kept |\n|---|---|---|---|---|\n";
    for (const ToolConvention& tool : tool_conventions()) {
        std::string keys;
        for (const ToolKey& key : tool.keys)
            keys += (keys.empty() ? "`" : "; `") + std::string(key.name) + "`" +
                    (key.unit.empty() ? "" : " (" + std::string(key.unit) + ")");
        out += "| `" + std::string(tool.name) + "` | " + std::string(tool.length) + " | " +
               std::string(tool.boundary) + " | " + keys + " | " + std::string(tool.lost) + " |\n";
    }
    return out;
}

std::string one_skin_in_all_tools(const std::string& name) {
    const BurleyProfile burley = burley_equivalent(*find_profile(name));
    std::string out = "| tool | `" + name + "` |\n|---|---|\n";
    for (const ToolConvention& tool : tool_conventions()) {
        const ToolSettings settings = to_tool(tool.id, burley);
        out += "| `" + std::string(tool.name) + "` | ";
        for (size_t k = 0; k < tool.keys.size(); ++k)
            out += (k == 0 ? "" : "; ") + std::string(tool.keys[k].name) + " " +
                   value_text(settings.values[k], tool.keys[k].count) +
                   (tool.keys[k].unit.empty() ? "" : " " + std::string(tool.keys[k].unit));
        out += " |\n";
    }
    return out;
}

std::string fit_table() {
    const Profile burley = *find_profile("burley:1"), dipole = *find_profile("jensen_skin2");
    std::string out = "| Gaussians a channel | Burley | dipole, skin2 red |\n|---|---|---|\n";
    for (const int terms : {2, 3, 4, 5, 6, 8})
        out += "| " + std::to_string(terms) + " | " + percent(to_gaussian_sum(burley, terms).max_error[0]) +
               " | " + percent(to_gaussian_sum(dipole, terms).max_error[0]) + " |\n";
    return out;
}

}  // namespace

std::string number_text(double value) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4);
    return std::string(buffer, end.ptr);
}

std::string value_text(const Rgb& value, int count) {
    if (count == 1) return number_text(value[0]);
    return number_text(value[0]) + ", " + number_text(value[1]) + ", " + number_text(value[2]);
}

Plot profile_plot(const Profile& profile, const GaussianFit& fit) {
    const Profile fitted{"fit", "", fit.sum};
    const bool exact = std::holds_alternative<GaussianSum>(profile.model);
    const double far = largest_radius_mm(profile, 0.99);
    const std::vector<double> linear = radii_mm(far / 400, far, PlotScale::linear);
    const std::vector<double> logarithmic = radii_mm(far / 2000, 2 * far, PlotScale::logarithmic);
    const std::string terms = std::to_string(fit.sum.terms.size()) + " Gaussians";

    Plot plot{.title = profile.name, .caption = profile.source};
    plot.panels = {{.title = "Reflectance" + std::string(exact ? "" : ", and its fit of " + terms),
                    .x = {.label = "r (mm)"},
                    .y = {.label = "R (1/mm²)", .scale = PlotScale::logarithmic}},
                   {.title = "Light that leaves within r",
                    .x = {.label = "r (mm)", .scale = PlotScale::logarithmic},
                    .y = {.label = "part of the light", .min = 0, .max = 1}}};
    if (!exact)
        plot.panels.push_back({.title = "Error of the fit",
                               .x = {.label = "r (mm)", .scale = PlotScale::logarithmic},
                               .y = {.label = "fit − profile, part of the light"}});
    for (int c = 0; c < 3; ++c) {
        if (diffuse_albedo(profile, c) <= 0) continue;
        const auto reflectance = [&](double r) { return reflectance_per_mm2(profile, c, r); };
        const auto within = [&](double r) { return cdf(profile, c, r); };
        const std::string_view color = kPlotChannel[c];
        plot.panels[0].series.push_back(series(channel_name(c), color, linear, reflectance));
        plot.panels[1].series.push_back(series(channel_name(c), color, logarithmic, within));
        if (exact) continue;
        const auto fitted_reflectance = [&](double r) { return reflectance_per_mm2(fitted, c, r); };
        const auto missed = [&](double r) { return cdf(fitted, c, r) - cdf(profile, c, r); };
        PlotSeries dashed = series("", color, linear, fitted_reflectance);
        dashed.stroke = PlotStroke::dashed;
        plot.panels[0].series.push_back(std::move(dashed));
        plot.panels[2].series.push_back(series(channel_name(c), color, logarithmic, missed));
    }
    plot.columns = int(plot.panels.size());
    plot.panel_width_px = 400;
    return plot;
}

Plot comparison_plot(const std::vector<Profile>& profiles) {
    // Skins of one published series share a dash pattern and run from light to dark; others take the palette.
    constexpr std::string_view kSkinTones[] = {"#e0a875", "#cf8f5a", "#b87443",
                                               "#965a30", "#6f4022", "#452512"};
    Plot plot{.title = "Published skins: the light that leaves within r", .columns = 3};
    for (int c = 0; c < 3; ++c) {
        PlotPanel panel{.title = channel_name(c),
                        .x = {.label = "r (mm)", .scale = PlotScale::logarithmic},
                        .y = {.label = "part of the light", .min = 0, .max = 1}};
        size_t tone = 0;
        for (const Profile& profile : profiles) {
            const auto within = [&](double r) { return cdf(profile, c, r); };
            PlotSeries curve = series(profile.name, {}, radii_mm(0.01, 20, PlotScale::logarithmic), within);
            if (profile.name.starts_with("openpbr_")) {
                curve.color = kSkinTones[tone++ % std::size(kSkinTones)];
                curve.stroke = PlotStroke::dashed;
            }
            panel.series.push_back(std::move(curve));
        }
        plot.panels.push_back(std::move(panel));
    }
    plot.panel_width_px = 400;
    plot.panel_height_px = 440;
    return plot;
}

std::string profile_tables_markdown() {
    return "### Presets\n\n" + presets_table() + "\n### What each tool means\n\n" + conventions_table() +
           "\n### One skin in every tool\n\n" + one_skin_in_all_tools("jensen_skin1") +
           "\n### How well Gaussians fit\n\n" + "Largest part of the light at a wrong distance.\n\n" +
           fit_table();
}

}  // namespace dermis::inline bake
