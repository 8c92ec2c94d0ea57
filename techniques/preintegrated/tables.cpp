#include "techniques/preintegrated/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/shadow_ramp.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_lobes.h"
#include "dermis/rays/ball_exitance.h"
#include "dermis/rays/curvature_gain.h"
#include "shaders/include/constants.h"
#include "techniques/preintegrated/weights.h"

namespace dermis::preintegrated {
namespace {

constexpr int kLutWidth = 512, kLutHeight = 256;
constexpr int kBeckmannWidth = 256, kBeckmannHeight = 256;

using Texel = std::array<float, 4>;
using Rows = std::vector<Texel>;  // rows of kRowTexels, one after the other

Texel texel(const Rgb& value, double alpha) {
    return {float(value[0]), float(value[1]), float(value[2]), float(alpha)};
}

// A table from a file, resampled at this technique's texels. Size, range, warp and encoding may differ; kind,
// construction, axes and profile must be those of this use.
Result<Table> own_table(const std::string& file, TableUse use, const TableSettings& settings,
                        const SkinContext& skin) {
    use.construction = settings.how.construction;
    use.profile = skin.profile.name;
    Result<Table> table = read_table(file, use);
    if (!table) return table.error();
    for (const TableAxis& axis : table->convention.axes)
        if (axis.name == "curvature_per_mm" && axis.unit != "1/mm")
            return Error{file + ": curvature is in " + axis.unit + ", this use needs 1/mm"};
    return table;
}

TableImage resampled(const Table& table) {
    std::vector<float> rgba;
    for (int y = 0; y < kLutHeight; ++y)
        for (int x = 0; x < kLutWidth; ++x) {
            const Rgb d =
                lookup(table, -1 + 2 * (x + 0.5) / kLutWidth, kMaxCurvaturePerMm * (y + 0.5) / kLutHeight);
            rgba.insert(rgba.end(), {float(d[0]), float(d[1]), float(d[2]), 1.0f});
        }
    return table_image("skin_lut", kLutHeight, rgba);
}

Result<TableImage> diffuse_table(const TableSettings& settings, const SkinContext& skin) {
    Result<LutOptions> options = lut_options("dermis");
    if (!options) return options.error();
    options->convention.how = settings.how;
    options->profile = {.name = skin.profile.name, .source = skin.profile.source, .model = skin.gaussians};
    options->convention.axes[1] = curvature_axis(0, kMaxCurvaturePerMm);
    options->width = kLutWidth;
    options->height = kLutHeight;
    const Result<Table> table = bake_lut(*options);
    if (!table) return table.error();
    std::vector<float> rgba;
    for (int y = 0; y < kLutHeight; ++y)
        for (int x = 0; x < kLutWidth; ++x) {
            for (int c = 0; c < 3; ++c) rgba.push_back(table->at(x, y, c));
            rgba.push_back(1);
        }
    return table_image("skin_lut", kLutHeight, rgba);
}

// Light over N.L on balls of the table's curvatures, over the form of their gain, which the shader multiplies
// by. Linear between the balls that are walked; flat skin is Lambert's.
TableImage walked_table(const SkinContext& skin) {
    constexpr int kWalks = 1 << 18;
    const std::vector<double> curvatures = {1.0 / 64, 1.0 / 32, 1.0 / 16, 3.0 / 32, 1.0 / 8, 3.0 / 16,
                                            1.0 / 4,  3.0 / 8,  1.0 / 2,  3.0 / 4,  1.0};
    const ScatteringMedium medium = walk_medium_of(skin.profile);
    const GainForm form = walked_gain_form(medium);
    std::vector<std::vector<Rgb>> rows(1);
    for (int x = 0; x < kLutWidth; ++x) {
        const double lit = std::max(-1 + 2 * (x + 0.5) / kLutWidth, 0.0);
        rows[0].push_back({lit, lit, lit});
    }
    for (const BallExitance& ball : walk_balls(medium, curvatures, kWalks)) {
        rows.emplace_back();
        for (int x = 0; x < kLutWidth; ++x) {
            Rgb light = light_on_ball(ball, -1 + 2 * (x + 0.5) / kLutWidth);
            for (int c = 0; c < 3; ++c) light[size_t(c)] /= gain(form, c, ball.curvature_per_mm);
            rows.back().push_back(light);
        }
    }
    std::vector<float> rgba;
    for (int y = 0; y < kLutHeight; ++y) {
        const double curvature = kMaxCurvaturePerMm * (y + 0.5) / kLutHeight;
        size_t i = 0;
        while (i + 1 < curvatures.size() && curvatures[i] < curvature) ++i;
        const double before = i == 0 ? 0 : curvatures[i - 1];
        const double part = (curvature - before) / (curvatures[i] - before);
        for (size_t x = 0; x < size_t(kLutWidth); ++x) {
            for (size_t c = 0; c < 3; ++c)
                rgba.push_back(float(std::lerp(rows[i][x][c], rows[i + 1][x][c], part)));
            rgba.push_back(1);
        }
    }
    return table_image("skin_lut", kLutHeight, rgba);
}

// At even steps of curvature, both ends included. A file replaces the orders that it has; a remapped file
// lacks the second, which scattering changes least.
Result<Rows> zonal_rows(const TableSettings& settings, const SkinContext& skin) {
    Table own;
    if (!skin.zonal_table.empty()) {
        Result<Table> table =
            own_table(skin.zonal_table,
                      {.kind = TableKind::zonal_harmonics, .u_axis = "curvature_per_mm", .v_axis = "order"},
                      settings, skin);
        if (!table) return table.error();
        own = std::move(*table);
        if (own.convention.how.variance_scale != settings.how.variance_scale)
            return Error{skin.zonal_table + ": its variances are x " +
                         to_text(own.convention.how.variance_scale) + ", those of the diffuse table x " +
                         to_text(settings.how.variance_scale) + "; bake it with --variance-scale " +
                         to_text(settings.how.variance_scale)};
    }
    Rows rows(size_t(kRowTexels) * 3);
    for (int i = 0; i < kRowTexels; ++i) {
        const double curvature = std::max(double(kMaxCurvaturePerMm) * i / (kRowTexels - 1), 1e-6);
        auto zh = preintegrated_zonal_harmonics(skin.gaussians, 1 / curvature, settings.how);
        for (size_t l = 0; l < size_t(own.height); ++l) zh[l] = lookup(own, curvature, double(l));
        for (size_t l = 0; l < 3; ++l) rows[l * kRowTexels + size_t(i)] = texel(zh[l], 1);
    }
    return rows;
}

// At even steps of visibility, both ends included.
Result<Rows> shadow_row(const TableSettings& settings, const SkinContext& skin) {
    const auto ramp = shadow_ramp(skin.profile, settings.shadow_width_mm, kRowTexels);
    if (!ramp) return ramp.error();
    Rows row;
    for (const Rgb& light : *ramp) row.push_back(texel(light, 1));
    return row;
}

// Weights of the smoother normal, and in alpha its mip level above the sharp one's, over the logarithm of a
// texel's size in mm; then the same with the published levels.
Result<Rows> normals_rows(const TableSettings&, const SkinContext& skin) {
    Rows rows;
    for (const auto blend_at : {normal_blend, published_normal_blend})
        for (int i = 0; i < kRowTexels; ++i) {
            const double log_mm = kMinLogMm + double(kMaxLogMm - kMinLogMm) * i / (kRowTexels - 1);
            const NormalBlend blend = blend_at(skin.gaussians, std::exp2(log_mm));
            rows.push_back(texel(blend.weight, blend.lod_bias));
        }
    return rows;
}

// Red's curvature over kMaxCurvaturePerMm and mean of the second Legendre polynomial, over sqrt(1 - A). A is
// the mean cosine of the profile on its sphere, which falls with curvature. Values beyond the largest
// curvature repeat its texel.
Result<Rows> row_of_mean(const TableSettings& settings, const SkinContext& skin) {
    constexpr int kSteps = 4 * kRowTexels;
    constexpr double kSecondBand = 0.495415912;  // of a plane, sqrt(5 pi) / 8
    std::vector<double> place, second;           // place: sqrt(1 - A) at even steps of curvature
    for (int i = 0; i <= kSteps; ++i) {
        const double curvature = std::max(double(kMaxCurvaturePerMm) * i / kSteps, 1e-6);
        const double a = preintegrated_mean_cosine(skin.gaussians, 1 / curvature, settings.how)[0];
        place.push_back(std::sqrt(std::max(1 - a, 0.0)));
        second.push_back(preintegrated_zonal_harmonics(skin.gaussians, 1 / curvature, settings.how)[2][0] /
                         kSecondBand);
    }
    Rows row;
    for (int i = 0; i < kRowTexels; ++i) {
        const double x = double(i) / (kRowTexels - 1);
        size_t k = 0;
        while (k < size_t(kSteps) - 1 && place[k + 1] <= x) ++k;
        const double part = std::clamp((x - place[k]) / (place[k + 1] - place[k]), 0.0, 1.0);
        row.push_back(texel({(double(k) + part) / kSteps, std::lerp(second[k], second[k + 1], part), 0}, 1));
    }
    return row;
}

// A row of weights, the penumbra's in alpha, and a row of places with their lift. Each place is turned by the
// golden angle from the one before.
Result<Rows> tap_rows(const TableSettings&, const SkinContext& skin) {
    Rows rows(size_t(kRowTexels) * 2);
    const std::vector<ShadowTap> taps = shadow_taps(skin.gaussians);
    for (size_t i = 0; i < taps.size(); ++i) {
        const size_t at = (i + kShadowFirstTaps) % kShadowGatherTaps;  // the farthest ones first
        rows[at] = texel(taps[i].weight, taps[i].penumbra_weight);
        const double r = taps[i].radius_mm, angle = double(i) * kGoldenAngle;
        rows[kRowTexels + at] =
            texel({r * std::cos(angle), r * std::sin(angle), double(kGatherLiftSlope) * r}, 1);
    }
    return rows;
}

// The order is that of kRowZonal, kRowShadow, kRowNormals, kRowPublishedNormals, kRowOfMean, kRowTapWeights.
Result<TableImage> rows_table(const TableSettings& settings, const SkinContext& skin) {
    Rows all;
    for (const auto make : {zonal_rows, shadow_row, normals_rows, row_of_mean, tap_rows}) {
        const Result<Rows> rows = make(settings, skin);
        if (!rows) return rows.error();
        all.insert(all.end(), rows->begin(), rows->end());
    }
    return table_image("skin_rows", kRowCount, all);
}

// The tenth root of Beckmann's distribution over u = sqrt(1 - N.H) and v = sqrt(alpha), which is smooth
// enough to be interpolated; a table over N.H and alpha, as published, loses 8 % of a highlight's peak at
// roughness 0.45.
Result<TableImage> beckmann_table(const TableSettings& settings, const SkinContext& skin) {
    if (!settings.needs_beckmann)
        return table_image("skin_beckmann", 1, std::vector{0.0f}, ImageFormat::r32f);
    Table own;
    if (!skin.beckmann_table.empty()) {
        DERMIS_TRY_ASSIGN(
            own, read_table(skin.beckmann_table,
                            {.kind = TableKind::beckmann, .u_axis = "n_dot_h", .v_axis = "roughness"}));
    }
    std::vector<float> roots;
    for (int y = 0; y < kBeckmannHeight; ++y)
        for (int x = 0; x < kBeckmannWidth; ++x) {
            const double u = (x + 0.5) / kBeckmannWidth, v = (y + 0.5) / kBeckmannHeight;
            const double cosine = 1 - u * u, roughness = v * v;
            const double d = own.width ? lookup(own, cosine, roughness)[0] : beckmann(cosine, roughness);
            roots.push_back(float(std::pow(d / std::numbers::pi, 0.1)));
        }
    return table_image("skin_beckmann", kBeckmannHeight, roots, ImageFormat::r32f);
}

}  // namespace

Result<std::vector<TableImage>> bake_tables(const TableSettings& settings, const SkinContext& skin) {
    std::vector<TableImage> images;
    TableSettings used = settings;
    if (!skin.diffuse_table.empty()) {
        DERMIS_TRY_ASSIGN(
            const Table own,
            own_table(skin.diffuse_table,
                      {.kind = TableKind::diffuse, .u_axis = "n_dot_l", .v_axis = "curvature_per_mm"},
                      settings, skin));
        used.how = own.convention.how;
        images.push_back(resampled(own));
    } else if (settings.by_walks) {
        images.push_back(walked_table(skin));
    } else {
        DERMIS_TRY_ASSIGN(TableImage lut, diffuse_table(used, skin));
        images.push_back(std::move(lut));
    }
    for (const auto make : {rows_table, beckmann_table}) {
        Result<TableImage> image = make(used, skin);
        if (!image) return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

}  // namespace dermis::preintegrated
