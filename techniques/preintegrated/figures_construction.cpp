// The construction plots of Yeung 2015: which curves the red channel is put together from, over N.L.

#include <algorithm>
#include <cmath>

#include "dermis/optics/curve_2015.h"
#include "dermis/technique/technique.h"
#include "techniques/preintegrated/figures.h"

namespace dermis::preintegrated {
namespace {

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
                                             {.construction = Construction::half_ring})[0];
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

}  // namespace

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

}  // namespace dermis::preintegrated
