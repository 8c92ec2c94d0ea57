#include "techniques/preintegrated/tables.h"

#include <cmath>
#include <numbers>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/optics/gaussian_channels.h"
#include "techniques/preintegrated/normal_blend.h"
#include "techniques/preintegrated/shadow_ramp.h"

namespace dermis::preintegrated {
namespace {

constexpr int kLutWidth = 512, kLutHeight = 256, kRows = 257;
constexpr int kBeckmannWidth = 256, kBeckmannHeight = 256;
constexpr int kBlendTexels = 97;

// A table from a file, resampled at this technique's texels: its size, range and warp are those of its
// convention. Kind, construction, axes and profile must be the same.
Result<TableImage> own_diffuse_table(const TableSettings& settings, const SkinContext& skin) {
    const Result<Table> table = read_table(skin.diffuse_table, {.kind = TableKind::diffuse,
                                                                .construction = settings.construction,
                                                                .u_axis = "n_dot_l",
                                                                .v_axis = "curvature_per_mm",
                                                                .profile = skin.profile.name});
    if (!table) return table.error();
    const TableAxis& curvature = table->convention.axes[1];
    if (curvature.unit != "1/mm")
        return Error{skin.diffuse_table + ": curvature is in " + curvature.unit + ", this use needs 1/mm"};
    std::vector<float> rgba;
    for (int y = 0; y < kLutHeight; ++y)
        for (int x = 0; x < kLutWidth; ++x) {
            const Rgb d =
                lookup(*table, -1 + 2 * (x + 0.5) / kLutWidth, kMaxCurvaturePerMm * (y + 0.5) / kLutHeight);
            rgba.insert(rgba.end(), {float(d[0]), float(d[1]), float(d[2]), 1.0f});
        }
    return table_image("skin_lut", kLutHeight, rgba);
}

Result<TableImage> diffuse_table(const TableSettings& settings, const SkinContext& skin) {
    if (!skin.diffuse_table.empty()) return own_diffuse_table(settings, skin);
    Result<LutOptions> options =
        lut_options(settings.construction == Construction::half_ring ? "penner" : "dermis");
    if (!options) return options.error();
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

// Rows at even steps of curvature, both ends included.
Result<TableImage> zonal_table(const TableSettings& settings, const SkinContext& skin) {
    std::vector<float> rgba(size_t(kRows) * 3 * 4, 1.0f);
    for (int i = 0; i < kRows; ++i) {
        const double curvature = std::max(double(kMaxCurvaturePerMm) * i / (kRows - 1), 1e-6);
        const auto zh = preintegrated_zonal_harmonics(skin.gaussians, 1 / curvature,
                                                      {.construction = settings.construction});
        for (size_t l = 0; l < 3; ++l)
            for (size_t c = 0; c < 3; ++c) rgba[(l * kRows + size_t(i)) * 4 + c] = float(zh[l][c]);
    }
    return table_image("skin_zonal", 3, rgba);
}

// Half of a, s, k0 and k1, as the shader needs them; q in the fourth channels of the first three rows.
Result<TableImage> closed_form_table(const TableSettings& settings, const SkinContext& skin) {
    const Result<ClosedForm> form =
        fit_closed_form(skin.gaussians, kMaxCurvaturePerMm, kRows, {.construction = settings.construction});
    if (!form) return form.error();
    std::vector<float> rgba(size_t(kRows) * 4 * 4);
    for (size_t i = 0; i < form->rows.size(); ++i) {
        const ClosedFormCoefficients& row = form->rows[i];
        const Rgb* colors[4] = {&row.a, &row.s, &row.k0, &row.k1};
        for (size_t k = 0; k < 4; ++k) {
            float* texel = &rgba[(k * kRows + i) * 4];
            for (size_t c = 0; c < 3; ++c) texel[c] = float((*colors[k])[c] / 2);
            if (k < 3) texel[3] = float(row.q[k]);
        }
    }
    return table_image("skin_closed_form", 4, rgba);
}

// Rows at even steps of visibility, both ends included.
Result<TableImage> shadow_table(const TableSettings& settings, const SkinContext& skin) {
    const auto ramp = shadow_ramp(skin.profile, settings.shadow_width_mm, kRows);
    if (!ramp) return ramp.error();
    std::vector<float> rgba;
    for (const Rgb& light : *ramp)
        rgba.insert(rgba.end(), {float(light[0]), float(light[1]), float(light[2]), 1.0f});
    return table_image("skin_shadow", 1, rgba);
}

// The profile itself: a row of weights and one of variances in mm^2, red, green, blue; one column a term.
Result<TableImage> gaussian_table(const TableSettings&, const SkinContext& skin) {
    std::vector<float> rgba;
    const std::vector<ChannelGaussians> terms = by_channel(skin.gaussians);
    for (const Rgb ChannelGaussians::*row : {&ChannelGaussians::weight, &ChannelGaussians::variance_mm2})
        for (const ChannelGaussians& term : terms)
            rgba.insert(rgba.end(), {float((term.*row)[0]), float((term.*row)[1]), float((term.*row)[2]), 1});
    return table_image("skin_gaussians", 2, rgba);
}

// Weights of the smoother normal, and in alpha its mip level above the sharp one's, over the logarithm of a
// texel's size in mm.
Result<TableImage> normal_blend_table(const TableSettings& settings, const SkinContext& skin) {
    std::vector<float> rgba;
    for (int i = 0; i < kBlendTexels; ++i) {
        const double log_mm = kMinLogMm + double(kMaxLogMm - kMinLogMm) * i / (kBlendTexels - 1);
        const NormalBlend blend = normal_blend(skin.gaussians, std::exp2(log_mm), settings.normal_lod_bias);
        for (const double weight : blend.weight) rgba.push_back(float(weight));
        rgba.push_back(float(blend.lod_bias));
    }
    return table_image("skin_normal_blend", 1, rgba);
}

// The tenth root of Beckmann's distribution over u = sqrt(1 - N.H) and v = sqrt(alpha), which is smooth
// enough to be interpolated; a table over N.H and alpha, as published, loses 11 % of an oily highlight.
Result<TableImage> beckmann_table(const TableSettings& settings, const SkinContext&) {
    if (!settings.needs_beckmann)
        return table_image("skin_beckmann", 1, std::vector{0.0f}, ImageFormat::r32f);
    std::vector<float> roots;
    for (int y = 0; y < kBeckmannHeight; ++y)
        for (int x = 0; x < kBeckmannWidth; ++x) {
            const double u = (x + 0.5) / kBeckmannWidth, v = (y + 0.5) / kBeckmannHeight;
            roots.push_back(float(std::pow(beckmann(1 - u * u, v * v) / std::numbers::pi, 0.1)));
        }
    return table_image("skin_beckmann", kBeckmannHeight, roots, ImageFormat::r32f);
}

// R per mm^2 divided by its integral, at even steps of distance, both ends included. The albedo is left out
// because the albedo map holds it.
Result<TableImage> transmission_table(const TableSettings&, const SkinContext& skin) {
    const Profile profile = {.name = "", .source = "", .model = skin.gaussians};
    std::vector<float> rgba;
    for (int i = 0; i < kRows; ++i) {
        const double distance_mm = std::max(double(kMaxDistanceMm) * i / (kRows - 1), kMinDistanceMm);
        for (int c = 0; c < 3; ++c) {
            const double albedo = diffuse_albedo(profile, c);
            rgba.push_back(albedo > 0 ? float(reflectance_per_mm2(profile, c, distance_mm) / albedo) : 0.0f);
        }
        rgba.push_back(1);
    }
    return table_image("skin_transmission", 1, rgba);
}

}  // namespace

Result<std::vector<TableImage>> bake_tables(const TableSettings& settings, const SkinContext& skin) {
    std::vector<TableImage> images;
    for (const auto make : {diffuse_table, zonal_table, closed_form_table, shadow_table, gaussian_table,
                            normal_blend_table, beckmann_table, transmission_table}) {
        Result<TableImage> image = make(settings, skin);
        if (!image) return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

}  // namespace dermis::preintegrated
