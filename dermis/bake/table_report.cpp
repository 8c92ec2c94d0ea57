#include "dermis/bake/table_report.h"

#include <algorithm>
#include <cmath>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/rows.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/text.h"
#include "dermis/optics/gaussian_fit.h"

namespace dermis::inline bake {
namespace {

Result<std::vector<Rgb>> exact_diffuse(const Convention& convention, const Profile& profile,
                                       std::span<const double> n_dot_l, double v) {
    const double radius_mm = radius_of(convention.axes[1], v);
    DERMIS_TRY_ASSIGN(const std::vector<float> row,
                      integrate_rows(profile, n_dot_l, std::span(&radius_mm, 1), convention.how));
    std::vector<Rgb> values;
    for (size_t i = 0; i < n_dot_l.size(); ++i)
        values.push_back({row[3 * i], row[3 * i + 1], row[3 * i + 2]});
    return values;
}

std::vector<Rgb> exact_zonal(const Convention& convention, const Profile& profile, std::span<const double> u,
                             double order) {
    std::vector<Rgb> values;
    const size_t l = size_t(std::clamp(std::lround(order), 0l, 2l));
    for (double value : u)
        values.push_back(
            zonal_harmonics_at(profile, radius_of(convention.axes[0], value), convention.how)[l]);
    return values;
}

std::vector<Rgb> exact_shadow(const Convention& convention, const GaussianSum& sum, std::span<const double> u,
                              double width_mm) {
    const Rgb total = total_weight(sum.terms);
    std::vector<Rgb> values(u.size());
    for (size_t i = 0; i < u.size(); ++i)
        for (const GaussianTerm& term : sum.terms) {
            const double sigma = std::sqrt(term.variance_mm2) / width_mm;
            const double lit = blurred_smoothstep(u[i], sigma, convention.shadow_sharpening);
            for (size_t c = 0; c < 3; ++c) values[i][c] += term.weight[c] / total[c] * lit;
        }
    return values;
}

struct Section {
    double v;
    std::string name;
};

// The rows that are drawn, as far as the axis reaches them.
std::vector<Section> sections_of(const Table& table) {
    const TableAxis& axis = table.convention.axes[1];
    std::vector<Section> all;
    const auto add = [&](double v, std::string name) {
        if (v >= std::min(axis.min, axis.max) && v <= std::max(axis.min, axis.max))
            all.push_back({v, std::move(name)});
    };
    switch (table.convention.kind) {
        case TableKind::diffuse:
            for (double r : {2.0, 4.0, 8.0, 16.0})
                add(axis.name == "radius_mm" ? r : 1 / r, "r = " + to_text(r) + " mm");
            break;
        case TableKind::shadow:
            for (double w : {2.0, 4.0, 8.0, 16.0}) add(w, "w = " + to_text(w) + " mm");
            break;
        case TableKind::beckmann:
            for (double m : {0.1, 0.2, 0.3, 0.6}) add(m, "m = " + to_text(m));
            break;
        case TableKind::zonal_harmonics:
            for (int l = 0; l < table.height; ++l) add(l, "order " + std::to_string(l));
            break;
    }
    if (all.empty())  // an axis that reaches none of them
        for (double s : {0.25, 0.75})
            all.push_back({axis.min + s * (axis.max - axis.min), "v = " + to_text(s)});
    return all;
}

std::vector<double> samples(const TableAxis& axis, int count, int samples) {
    TableAxis centred = axis;
    centred.sampling = TexelSampling::centre;
    std::vector<double> values;
    for (int i = 0; i < samples; ++i)
        values.push_back(centred.value(double(i) * (count - 1) / (samples - 1), count));
    return values;
}

// One colour per section; the sphere's curve of the same section is dashed.
constexpr std::string_view kSectionColor[] = {"#1864ab", "#e8590c", "#2b8a3e", "#862e9c"};

struct Curves {
    Section section;
    std::vector<Rgb> exact, looked_up, sphere;
};

Plot assemble(const Table& table, const std::vector<double>& u, const std::vector<Curves>& all) {
    constexpr const char* kChannel[] = {"red", "green", "blue"};
    const std::string label = table.convention.axes[0].name;
    Plot plot{.title = describe(table), .caption = table.convention.tool};
    const size_t channels = size_t(table.channels);
    for (size_t c = 0; c < channels; ++c) {
        PlotPanel panel{
            .title = channels == 3 ? kChannel[c] : "value", .x = {.label = label}, .y = {.label = "value"}};
        for (const Curves& curves : all) {
            const std::string color(kSectionColor[size_t(&curves - all.data()) % 4]);
            PlotSeries exact{.name = curves.section.name, .x = u, .color = color};
            PlotSeries sphere{.x = u, .color = color, .stroke = PlotStroke::dashed};
            for (const Rgb& value : curves.exact) exact.y.push_back(value[c]);
            for (const Rgb& value : curves.sphere) sphere.y.push_back(value[c]);
            panel.series.push_back(std::move(exact));
            if (!sphere.y.empty()) panel.series.push_back(std::move(sphere));
        }
        if (table.convention.kind == TableKind::beckmann) panel.y.scale = PlotScale::logarithmic;
        plot.panels.push_back(std::move(panel));
    }
    PlotPanel error{.title = "error of a lookup in the file",
                    .x = {.label = label},
                    .y = {.label = "largest of the channels", .scale = PlotScale::logarithmic}};
    for (const Curves& curves : all) {
        const std::string color(kSectionColor[size_t(&curves - all.data()) % 4]);
        PlotSeries series{.name = curves.section.name, .x = u, .color = color};
        for (size_t i = 0; i < u.size(); ++i) {
            double worst = 0;
            for (size_t c = 0; c < channels; ++c)
                worst = std::max(worst, std::abs(curves.looked_up[i][c] - curves.exact[i][c]));
            series.y.push_back(std::max(worst, 1e-8));
        }
        error.series.push_back(std::move(series));
    }
    plot.panels.push_back(std::move(error));
    return plot;
}

}  // namespace

ExactFunction exact_function(const Table& table, const Profile& profile) {
    const Convention& convention = table.convention;
    switch (convention.kind) {
        case TableKind::diffuse:
            return [convention, &profile](std::span<const double> u, double v) {
                return exact_diffuse(convention, profile, u, v);
            };
        case TableKind::zonal_harmonics:
            return [convention, &profile](std::span<const double> u, double v) -> Result<std::vector<Rgb>> {
                return exact_zonal(convention, profile, u, v);
            };
        case TableKind::shadow:
            return [convention, sum = to_gaussian_sum(profile, kShadowGaussians).sum](
                       std::span<const double> u, double v) -> Result<std::vector<Rgb>> {
                return exact_shadow(convention, sum, u, v);
            };
        case TableKind::beckmann:
            break;
    }
    return [](std::span<const double> u, double v) -> Result<std::vector<Rgb>> {
        std::vector<Rgb> values;
        for (double n_dot_h : u)
            values.push_back({beckmann(n_dot_h, v), beckmann(n_dot_h, v), beckmann(n_dot_h, v)});
        return values;
    };
}

Result<LookupError> lookup_error(const Table& table, const ExactFunction& exact) {
    const bool by_order = table.convention.kind == TableKind::zonal_harmonics;
    const std::vector<double> u = samples(table.convention.axes[0], table.width, 257);
    const std::vector<double> v =
        samples(table.convention.axes[1], table.height, by_order ? table.height : 65);
    LookupError error;
    double squares = 0;
    for (double row : v) {
        DERMIS_TRY_ASSIGN(const std::vector<Rgb> values, exact(u, row));
        for (size_t i = 0; i < u.size(); ++i) {
            const Rgb looked_up = lookup(table, u[i], row);
            for (size_t c = 0; c < size_t(table.channels); ++c) {
                const double difference = std::abs(looked_up[c] - values[i][c]);
                squares += difference * difference;
                if (difference > error.max) error = {.max = difference, .u = u[i], .v = row};
            }
        }
    }
    error.rms = std::sqrt(squares / double(u.size() * v.size() * size_t(table.channels)));
    return error;
}

Result<Plot> table_plot(const Table& table, const Profile& profile, TableStorage storage) {
    const Table stored = quantised(table, storage);
    const ExactFunction exact = exact_function(table, profile);
    Table on_sphere{.convention = table.convention};
    on_sphere.convention.how = {};
    const bool differs = table.convention.kind == TableKind::diffuse &&
                         (table.convention.how.construction != Construction::sphere ||
                          table.convention.how.variance_scale != 1);
    const ExactFunction sphere = exact_function(on_sphere, profile);
    const std::vector<double> u = samples(table.convention.axes[0], table.width, 129);
    std::vector<Curves> all;
    for (const Section& section : sections_of(table)) {
        Curves curves{.section = section};
        DERMIS_TRY_ASSIGN(std::vector<Rgb> values, exact(u, section.v));
        curves.exact = std::move(values);
        if (differs) {
            DERMIS_TRY_ASSIGN(std::vector<Rgb> right, sphere(u, section.v));
            curves.sphere = std::move(right);
        }
        for (double x : u) curves.looked_up.push_back(lookup(stored, x, section.v));
        all.push_back(std::move(curves));
    }
    return assemble(table, u, all);
}

std::string describe(const Table& table) {
    const Convention& convention = table.convention;
    std::string text = std::to_string(table.width) + " x " + std::to_string(table.height) + " " +
                       std::string(name_of(convention.kind));
    if (convention.kind == TableKind::diffuse || convention.kind == TableKind::zonal_harmonics)
        text += ", " + std::string(name_of(convention.how.construction));
    if (!convention.profile.empty()) text += ", " + convention.profile;
    for (const TableAxis& axis : convention.axes)
        text += ", " + axis.name + " " + to_text(axis.min) + ".." + to_text(axis.max);
    return text + ", " + std::string(name_of(convention.encoding));
}

}  // namespace dermis::inline bake
