// Figures of Yeung 2015.

#include <algorithm>
#include <cmath>

#include "dermis/optics/curve_2015.h"
#include "dermis/technique/technique.h"
#include "techniques/preintegrated/figures.h"

namespace dermis::preintegrated {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kClose = "distance_mm=600";
constexpr const char* kNear = "target_mm=14,36,80 distance_mm=400 fov_deg=14";
constexpr const char* kYeungSource = "after Yeung 2015, Pre-Integrated Skin Shading";

// What every table and curve can have, so that a difference is theirs.
const std::pair<std::string, std::string> kNormals = {"normals", "blended"};

// One way to shade, named as its row or column is.
struct Variant {
    const char* id;
    const char* name;
    Settings settings;
    const char* compare_to;  // id of the variant that it is compared with
};

Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

// r from 2 to 16 mm downwards, N.L from -1 to 1.
template <class Function>
Result<FigurePicture> over_radius(int width, int height, Function diffuse) {
    FigurePicture picture = {width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgb d = diffuse(-1 + 2 * (x + 0.5) / width, 2 + 14 * (y + 0.5) / height);
            for (const double channel : d) picture.rgb_linear.push_back(float(channel));
        }
    return picture;
}

Figure curves_figure() {
    FigureCell ring = {.label = "ring, exact",
                       .id = "ring",
                       .kind = CellKind::computed,
                       .compute = [](const SkinContext& skin, int width, int height) {
                           return over_radius(width, height, [&](double t, double r) {
                               return preintegrated_diffuse(skin.gaussians, t, r, kYeung2015Ring);
                           });
                       }};
    FigureCell curves = {.label = "curves of 2015",
                         .id = "curves",
                         .kind = CellKind::computed,
                         .compute =
                             [](const SkinContext&, int width, int height) {
                                 return over_radius(width, height, [](double t, double r) {
                                     return curve_2015_direct(t, 1 / r);
                                 });
                             },
                         .compare_to = "ring"};
    FigureCell difference = {.label = "difference times 8",
                             .kind = CellKind::difference,
                             .subject = "curves",
                             .compare_to = "ring"};
    return {
        .id = "curves",
        .title =
            "The curves and the ring that they were fitted to: N·L to the right, r from 2 to 16 mm downwards",
        .source = std::string(kYeungSource) + ": shapes of the diffusion curves",
        .scene = "builtin:spheres",
        .rows = {{"", {ring, curves, difference}}}};
}

// Which curves the red channel is put together from, over N.L: the construction plots of the article.
struct Line {
    Rgb color = {};
    std::function<double(double)> value;  // over N.L
};

constexpr Rgb kDarkBlue = {0.01, 0.05, 0.45}, kLightBlue = {0.15, 0.55, 0.95}, kGrey = {0.35, 0.35, 0.35},
              kOrange = {0.9, 0.35, 0.02}, kGreen = {0.05, 0.45, 0.1};

// N.L from -1 to 1 to the right, light from -0.05 to 1.05 upwards.
FigurePicture plotted(int width, int height, const std::vector<Line>& lines) {
    FigurePicture picture = {width, height, std::vector<float>(size_t(width) * size_t(height) * 3, 0.9f)};
    const double half_width_px = std::max(0.8, width / 220.0);
    for (const Line& line : lines)
        for (int x = 0; x < width; ++x) {
            const double t = -1 + 2 * (x + 0.5) / width, step = 2.0 / width;
            const auto row = [&](double at) { return (1.05 - line.value(at)) / 1.1 * height; };
            const double slope = (row(t + step) - row(t - step)) / 2, middle = row(t);
            for (int y = 0; y < height; ++y) {
                const double distance_px = std::abs(y + 0.5 - middle) / std::sqrt(1 + slope * slope);
                const double cover = std::clamp(half_width_px + 0.5 - distance_px, 0.0, 1.0);
                for (size_t c = 0; c < 3; ++c) {
                    float& value = picture.rgb_linear[(size_t(y) * size_t(width) + size_t(x)) * 3 + c];
                    value = std::lerp(value, float(line.color[c]), float(cover));
                }
            }
        }
    return picture;
}

Line exact(const SkinContext& skin, double radius_mm) {
    return {kGrey, [&skin, radius_mm](double t) {
                return preintegrated_diffuse(skin.gaussians, std::clamp(t, -1.0, 1.0), radius_mm,
                                             kYeung2015Ring)[0];
            }};
}

Line curve(const Rgb& color, double radius_mm) {
    return {color, [radius_mm](double t) { return curve_2015_direct(t, 1 / radius_mm)[0]; }};
}

FigureCell plot_cell(std::string label, std::function<std::vector<Line>(const SkinContext&)> lines) {
    return {.label = std::move(label),
            .kind = CellKind::computed,
            .compute = [lines = std::move(lines)](const SkinContext& skin, int width, int height)
                -> Result<FigurePicture> { return plotted(width, height, lines(skin)); }};
}

Figure construction_figure() {
    const auto ends = [](const SkinContext& skin) {
        return std::vector<Line>{exact(skin, 2), exact(skin, 16), curve(kDarkBlue, 2), curve(kLightBlue, 16)};
    };
    const auto pieces = [](const SkinContext&) {
        return std::vector<Line>{{kOrange, [](double t) { return curve_2015_tight_pieces(0, t).dark; }},
                                 {kGreen, [](double t) { return curve_2015_tight_pieces(0, t).light; }},
                                 curve(kDarkBlue, 2)};
    };
    const auto between = [](const SkinContext& skin) {
        return std::vector<Line>{exact(skin, 4),    exact(skin, 8),   curve(kDarkBlue, 2),
                                 curve(kOrange, 4), curve(kGreen, 8), curve(kLightBlue, 16)};
    };
    return {.id = "construction",
            .title = "How the red curve is put together: N·L from -1 to 1 to the right, light upwards",
            .source = "after Yeung 2015, Pre-Integrated Skin Shading: the light and the dark blue line",
            .note = "Grey: the ring that the curves were fitted to. Dark blue: r = 2 mm, light blue: 16 mm.",
            .scene = "builtin:spheres",
            .rows = {{"",
                      {plot_cell("the curves of both ends", ends),
                       plot_cell("dark blue: a parabola and a line", pieces),
                       plot_cell("between: 4 mm orange, 8 mm green", between)}}}};
}

const std::vector<Variant>& sphere_variants() {
    static const std::vector<Variant> kVariants = {
        {"ring", "table of the ring", {{"diffuse", "full_ring"}}, ""},
        {"curve", "curves of 2015", {{"diffuse", "curve_2015"}, {"ambient", "curve_2015"}}, "ring"},
        {"sphere", "table of the sphere", {}, "ring"},
        {"closed", "closed form", {{"diffuse", "closed_form"}, {"ambient", "exact"}}, "sphere"}};
    return kVariants;
}

Figure spheres_figure(std::string id, std::string title, std::string environment) {
    Figure figure = {.id = std::move(id), .title = std::move(title), .scene = "builtin:spheres"};
    figure.source =
        std::string(kYeungSource) + ": spheres of radius 2, 4, 8, 16 mm, table above, curves below";
    figure.note = "All spheres are drawn at the same size.";
    for (const Variant& variant : sphere_variants()) {
        FigureRow row = {.label = variant.name};
        for (const char* radius : {"2", "4", "8", "16"})
            row.cells.push_back(
                {.label = std::string("r = ") + radius + " mm",
                 .id = std::string(variant.id) + radius,
                 .settings = with(variant.settings, {{"shadow", "plain"}, kNormals}),
                 .view = "diffuse",
                 .object = std::string("sphere_") + radius + "mm",
                 .environment = environment,
                 .albedo = CellAlbedo::white,
                 .compare_to = *variant.compare_to ? variant.compare_to + std::string(radius) : ""});
        figure.rows.push_back(std::move(row));
    }
    return figure;
}

// Columns table, curves, Lambert; with albedo above, light alone below.
Figure heads_figure(std::string id, std::string title, const FigureCell& common) {
    Figure figure = {.id = std::move(id), .title = std::move(title)};
    figure.source = std::string(kYeungSource) + ": head with table, curves and Lambert";
    for (const CellAlbedo albedo : {CellAlbedo::mapped, CellAlbedo::white}) {
        const std::string suffix = albedo == CellAlbedo::white ? "_light" : "";
        FigureRow row = {.label = albedo == CellAlbedo::white ? "Without albedo" : "With albedo"};
        const auto add = [&](const std::string& label, const std::string& name, Settings settings) {
            FigureCell cell = common;
            cell.label = label;
            cell.id = name + suffix;
            cell.settings = std::move(settings);
            cell.albedo = albedo;
            cell.camera = albedo == CellAlbedo::white ? kNear : kClose;
            if (name == "lambert") cell.technique = "lambert";
            if (name != "table") cell.compare_to = "table" + suffix;
            row.cells.push_back(std::move(cell));
        };
        add("table", "table", {kNormals});
        add("curves of 2015", "curve", {{"diffuse", "curve_2015"}, {"ambient", "curve_2015"}, kNormals});
        add("Lambert", "lambert", {});
        figure.rows.push_back(std::move(row));
    }
    FigureRow differences = {.label = "Without albedo, difference to the table, times 8"};
    for (const char* of : {"curve", "lambert"})
        differences.cells.push_back({.label = of == std::string("curve") ? "curves of 2015" : "Lambert",
                                     .kind = CellKind::difference,
                                     .subject = std::string(of) + "_light",
                                     .compare_to = "table_light"});
    figure.rows.push_back(std::move(differences));
    return figure;
}

Figure together_figure() {
    const auto cell = [](std::string label, std::string environment, float yaw_deg, std::string view) {
        return FigureCell{.label = std::move(label),
                          .settings = {{"specular", "ggx"}},
                          .view = std::move(view),
                          .environment = std::move(environment),
                          .environment_yaw_deg = yaw_deg,
                          .environment_visible = true};
    };
    return {.id = "environments",
            .title = "Direct and indirect light with GGX and a prefiltered environment",
            .source = std::string(kYeungSource) + ": everything together, and another environment",
            .rows = {
                {"",
                 {cell("studio", "studio", 0, "final"), cell("sunset", "assets:hdri/sunset.hdr", 60, "final"),
                  cell("courtyard", "assets:hdri/courtyard.exr", 0, "final")}}}};
}

Figure baselines_figure() {
    const auto baseline = [](std::string id, std::string label) {
        return FigureCell{
            .label = std::move(label), .id = id, .technique = id, .view = "diffuse", .camera = kClose};
    };
    const auto variant = [](std::string label, Settings settings) {
        return FigureCell{.label = std::move(label),
                          .settings = with(std::move(settings), {kNormals}),
                          .view = "diffuse",
                          .camera = kClose,
                          .compare_to = "sphere"};
    };
    FigureRow variants = {
        "Pre-integrated",
        {variant("table, sphere", {}), variant("closed form", {{"diffuse", "closed_form"}}),
         variant("table, ring", {{"diffuse", "full_ring"}}),
         variant("curves of 2015", {{"diffuse", "curve_2015"}, {"ambient", "curve_2015"}})}};
    variants.cells[0].id = "sphere";
    variants.cells[0].compare_to = "";
    FigureRow baselines = {
        "Baselines",
        {baseline("lambert", "Lambert"), baseline("oren_nayar", "Oren-Nayar"), baseline("wrap", "wrap")}};
    for (FigureCell& cell : baselines.cells) cell.compare_to = "sphere";
    return {.id = "baselines",
            .title = "Baselines and every table variant",
            .source = std::string(kYeungSource) + ": Oren-Nayar on the left, pre-integrated on the right",
            .rows = {variants, baselines}};
}

}  // namespace

std::vector<Figure> curve_figures() {
    return {curves_figure(),
            construction_figure(),
            spheres_figure("spheres_direct", "Spheres under one light", "none"),
            spheres_figure("spheres_with_sh", "Spheres under one light and an environment", "studio"),
            heads_figure("head_direct", "Under one light", {.view = "diffuse", .environment = "none"}),
            heads_figure("head_with_sh", "Under one light and an environment", {.view = "diffuse"}),
            together_figure(),
            baselines_figure()};
}

}  // namespace dermis::preintegrated
