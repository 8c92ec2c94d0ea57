// Pre-integrated skin shading: Penner 2011, GPU Pro 2 and SIGGRAPH 2011 "Pre-Integrated Skin Shading".
// Assumes that within a few mean free paths the skin is a sphere of the local curvature under one distant
// light; a point then needs only N.L and curvature. Tables come from the bakers (exact on the sphere, or the
// published ring), the closed form from src/fit, the hand-made curves from Yeung 2015.

#include <cstring>

#include "dermis/bake/lut.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/fit/closed_form.h"
#include "dermis/technique/forward.h"
#include "preintegrated/figures.h"

namespace dermis {
namespace {

enum class Diffuse : int32_t { lut, curve_2015, closed_form };
enum class TableConstruction : int32_t { sphere, ring };
enum class Curvature : int32_t { vertex, derivative, image };
enum class Normals : int32_t { sharp, smooth, blended };
enum class Shadow : int32_t { plain, scattered };
enum class Ambient : int32_t { exact, curve_2015 };

struct Params {
    Diffuse diffuse = Diffuse::lut;
    TableConstruction construction = TableConstruction::sphere;
    Curvature curvature = Curvature::vertex;
    float curvature_gain = 1;
    float tune_curvature = 1;
    Normals normals = Normals::blended;
    float normal_lod_bias = 3;
    Shadow shadow = Shadow::scattered;
    float shadow_width_mm = 8;
    Ambient ambient = Ambient::exact;
    SpecularModel specular = SpecularModel::ggx;
};

// Curvatures from 0 to this fill the tables; preintegrated.frag knows the same number.
constexpr double kMaxCurvaturePerMm = 0.5;
constexpr int kLutWidth = 512, kLutHeight = 128, kRows = 129;
constexpr double kShadowSharpening = 3;

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(&Params::diffuse, "diffuse", {"lut", "curve_2015", "closed_form"},
                "falloff over N.L and curvature: exact table, hand-made curves, fitted hyperbola")
        .choice(&Params::construction, "construction", {"sphere", "ring"},
                "what is integrated; the published ring makes light on tight curves")
        .choice(&Params::curvature, "curvature", {"vertex", "derivative", "image"},
                "where curvature comes from; derivative changes with the camera's distance")
        .number(&Params::curvature_gain, "curvature_gain", "", 0, 10,
                "times the curvature, for effect; 1 is right")
        .number(&Params::tune_curvature, "tune_curvature", "", 0.01, 100,
                "divides the derivative's curvature; 1 is right in mm")
        .choice(&Params::normals, "normals", {"sharp", "smooth", "blended"},
                "diffuse normal: as mapped, from a smaller mip, or one a channel by the profile's width")
        .number(&Params::normal_lod_bias, "normal_lod_bias", "mip levels", 0, 8,
                "how much smaller the mip is")
        .choice(&Params::shadow, "shadow", {"plain", "scattered"}, "whether light scatters into the penumbra")
        .number(&Params::shadow_width_mm, "shadow_width_mm", "mm", 1, 40, "width of the filtered penumbra")
        .choice(&Params::ambient, "ambient", {"exact", "curve_2015"},
                "zonal harmonics for light from all around: of the integral, or hand-made curves")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    Pass pass = forward_skin_pass("preintegrated/preintegrated.frag", params.specular, frame);
    pass.constants.insert(pass.constants.end(), {{"diffuse", int32_t(params.diffuse)},
                                                 {"shadow", int32_t(params.shadow)},
                                                 {"curvature", int32_t(params.curvature)},
                                                 {"normals", int32_t(params.normals)},
                                                 {"ambient", int32_t(params.ambient)}});
    for (const char* table : {"skin_lut", "skin_zonal", "skin_shadow", "skin_closed_form", "skin_variance"})
        pass.reads.push_back(table);
    return {.passes = {pass}};
}

TableImage to_image(std::string name, int width, int height, const std::vector<float>& rgba) {
    TableImage image{
        .name = std::move(name), .format = ImageFormat::rgba32f, .width = width, .height = height};
    image.bytes.resize(rgba.size() * sizeof(float));
    std::memcpy(image.bytes.data(), rgba.data(), image.bytes.size());
    return image;
}

TableImage to_image(std::string name, const Table& table) {
    std::vector<float> rgba;
    rgba.reserve(size_t(table.width) * size_t(table.height) * 4);
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x) {
            for (int c = 0; c < 3; ++c) rgba.push_back(table.at(x, y, c));
            rgba.push_back(1);
        }
    return to_image(std::move(name), table.width, table.height, rgba);
}

Preintegration construction_of(const Params& params) {
    return {.construction =
                params.construction == TableConstruction::ring ? Construction::ring : Construction::sphere};
}

Result<TableImage> diffuse_table(const Params& params, const SkinContext& skin) {
    Result<LutOptions> options =
        lut_options(params.construction == TableConstruction::ring ? "penner" : "dermis");
    if (!options) return options.error();
    options->profile = {.name = skin.profile.name, .source = skin.profile.source, .model = skin.gaussians};
    options->width = kLutWidth;
    options->height = kLutHeight;
    const Result<Table> table = bake_lut(*options);
    if (!table) return table.error();
    return to_image("skin_lut", *table);
}

// Rows at even steps of curvature, both ends included.
TableImage zonal_table(const Params& params, const SkinContext& skin) {
    std::vector<float> rgba(size_t(kRows) * 3 * 4, 1.0f);
    for (int i = 0; i < kRows; ++i) {
        const double curvature = std::max(kMaxCurvaturePerMm * i / (kRows - 1), 1e-6);
        const auto zh = preintegrated_zonal_harmonics(skin.gaussians, 1 / curvature, construction_of(params));
        for (size_t l = 0; l < 3; ++l)
            for (size_t c = 0; c < 3; ++c) rgba[(l * kRows + size_t(i)) * 4 + c] = float(zh[l][c]);
    }
    return to_image("skin_zonal", kRows, 3, rgba);
}

Result<TableImage> closed_form_table(const Params& params, const SkinContext& skin) {
    const Result<ClosedForm> form =
        fit_closed_form(skin.gaussians, kMaxCurvaturePerMm, kRows, construction_of(params));
    if (!form) return form.error();
    std::vector<float> rgba(size_t(kRows) * 5 * 4, 1.0f);
    for (size_t i = 0; i < form->rows.size(); ++i) {
        const ClosedFormCoefficients& row = form->rows[i];
        const Rgb* colors[5] = {&row.a, &row.q, &row.s, &row.k0, &row.k1};
        for (size_t k = 0; k < 5; ++k)
            for (size_t c = 0; c < 3; ++c) rgba[(k * kRows + i) * 4 + c] = float((*colors[k])[c]);
    }
    return to_image("skin_closed_form", kRows, 5, rgba);
}

Result<TableImage> shadow_table(const Params& params, const SkinContext& skin) {
    const Result<Table> table = bake_shadow({.profile = skin.profile,
                                             .width = 256,
                                             .height = 1,
                                             .min_width_mm = params.shadow_width_mm,
                                             .max_width_mm = params.shadow_width_mm * 1.0001,
                                             .sharpening = kShadowSharpening});
    if (!table) return table.error();
    return to_image("skin_shadow", *table);
}

// Variance along one axis: a sum of Gaussians has the weighted mean of theirs.
TableImage variance_image(const GaussianSum& gaussians) {
    std::vector<float> rgba = {0, 0, 0, 1};
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, weight = 0;
        for (const GaussianTerm& term : gaussians.terms)
            sum += term.weight[c] * term.variance_mm2, weight += term.weight[c];
        rgba[c] = float(weight > 0 ? sum / weight : 0);
    }
    return to_image("skin_variance", 1, 1, rgba);
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    const Params params = values.as<Params>();
    std::vector<TableImage> images = {zonal_table(params, skin), variance_image(skin.gaussians)};
    for (const auto make : {diffuse_table, closed_form_table, shadow_table}) {
        Result<TableImage> image = make(params, skin);
        if (!image) return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

}  // namespace

Technique make_preintegrated_technique() {
    return {.id = "preintegrated",
            .summary = "scattering by curvature, by bumps and into shadows, from tables or a closed form",
            .source = "Penner 2011, Pre-Integrated Skin Shading, GPU Pro 2; curves: Yeung 2015",
            .parameters = parameters(),
            .build = build,
            .tables = tables,
            .figures = preintegrated_figures};
}

}  // namespace dermis
