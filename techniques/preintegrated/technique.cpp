// Pre-integrated skin shading: Penner 2011, GPU Pro 2 and SIGGRAPH 2011 "Pre-Integrated Skin Shading".
// Assumes that within a few mean free paths the skin is a sphere of the local curvature under one distant
// light; a point then needs only N.L and curvature. Tables come from the bakers (exact on the sphere, or the
// published ring), the closed form from dermis/optics, the hand-made curves from Yeung 2015.

#include <algorithm>

#include "dermis/technique/diffused_normals.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/transmission.h"
#include "techniques/preintegrated/expressions.h"
#include "techniques/preintegrated/figures.h"
#include "techniques/preintegrated/occlusion_blend.h"
#include "techniques/preintegrated/tables.h"

namespace dermis {
namespace {

enum class Diffuse : int32_t {
    lut = kDiffuseLut,
    curve_2015 = kDiffuseCurve2015,
    closed_form = kDiffuseClosedForm
};
enum class TableConstruction : int32_t { sphere, ring };
enum class Curvature : int32_t {
    vertex = kCurvatureVertex,
    derivative = kCurvatureDerivative,
    image = kCurvatureImage
};
enum class Normals : int32_t {
    sharp = kNormalsSharp,
    smooth = kNormalsSmooth,
    blended = kNormalsBlended,
    lerp = kNormalsLerp,
    baked = kNormalsBaked
};
enum class Shadow : int32_t {
    plain = kShadowPlain,
    scattered = kShadowScattered,
    gathered = kShadowGathered
};
enum class Ambient : int32_t { exact = kAmbientExact, lut = kAmbientLut, curve_2015 = kAmbientCurve2015 };

constexpr const char* kOwnView = "skin_curvature";

struct Params {
    Diffuse diffuse = Diffuse::lut;
    TableConstruction construction = TableConstruction::sphere;
    Curvature curvature = Curvature::vertex;
    float curvature_gain = 1;
    float tune_curvature = 1;
    Normals normals = Normals::baked;
    float normal_lod_bias = 3;
    Shadow shadow = Shadow::scattered;
    float shadow_width_mm =
        2.5f;  // kShadowWidthMm lets light around a nose: green's share of the bust -.22 for .19
    Transmission transmission = Transmission::shadow_map;
    Ambient ambient = Ambient::lut;
    SpecularModel specular = SpecularModel::ggx;
    float oiliness = 1;
    float roughness_scale = 1;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(
            &Params::diffuse, "diffuse", {"lut", "curve_2015", "closed_form"},
            "diffuse light over N.L and curvature: exact table; curves of 2015 or closed form, with which no "
            "table is bound")
        .choice(&Params::construction, "construction", {"sphere", "ring"},
                "shape that is integrated; the ring is as published and does not conserve energy")
        .choice(&Params::curvature, "curvature", {"vertex", "derivative", "image"},
                "source of the curvature; derivative depends on facets and camera")
        .number(&Params::curvature_gain, "curvature_gain", "", 0, 10,
                "factor on the curvature; 1 is physically right")
        .number(&Params::tune_curvature, "tune_curvature", "", 0.01, 100,
                "divides the curvature from derivatives; 1 is right for positions in mm")
        .choice(
            &Params::normals, "normals", {"sharp", "smooth", "blended", "lerp", "baked"},
            "diffuse normal: as mapped, from a smaller mip level, or both by the profile's width in "
            "each channel: their light blended, or as published the normals mixed; or the profile's mean "
            "of the normals around each texel, baked once over the UV atlas (needs one, and the defaults of "
            "diffuse, construction, curvature and ambient; else as blended)")
        .number(&Params::normal_lod_bias, "normal_lod_bias", "mip levels", 0, 8,
                "maximum difference of the smaller mip level")
        .choice(
            &Params::shadow, "shadow", {"plain", "scattered", "gathered"},
            "penumbra as filtered; with scattered light by its width; or averaged over the places around by "
            "the profile and the light that they would have (with a table; else as scattered)")
        .number(&Params::shadow_width_mm, "shadow_width_mm", "mm", 1, 40, "width of the filtered penumbra")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::ambient, "ambient", {"exact", "lut", "curve_2015"},
                "zonal harmonics for light from the environment: closed form of the sphere; those of the "
                "construction, from a table if diffuse is; curves of 2015")
        .choice(&Params::specular, "specular", specular_model_names(),
                "specular model; ksk reads its Beckmann distribution from a table")
        .number(&Params::oiliness, "oiliness", "", 0, 4,
                "factor on the specular reflectance of material and map")
        .number(&Params::roughness_scale, "roughness_scale", "", 0.1, 3,
                "factor on the roughness of material and map")
        .build();
}

bool reads_tables(const Params& params) {
    return params.diffuse == Diffuse::lut;
}

// Baked normals hold the curvature and what light from all around sees: they are no part of other models of
// these. The curvature is that of red's.
bool reads_baked_normals(const Params& params, const FrameContext& frame) {
    const Vec3 own = own_normal_weights(frame.skin_gaussians, {});
    return params.normals == Normals::baked && reads_tables(params) && frame.has_skin_atlas &&
           params.construction == TableConstruction::sphere && params.curvature == Curvature::vertex &&
           params.ambient == Ambient::lut && !frame.has_zonal_table && own.x < 1 &&
           own.x <= std::min(own.y, own.z);
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    const bool tables = reads_tables(params), baked = reads_baked_normals(params, frame);
    Pass pass = forward_skin_pass(!tables ? "preintegrated/textureless.frag"
                                  : baked ? "preintegrated/baked_normals.frag"
                                          : "preintegrated/preintegrated.frag",
                                  params.specular, frame, kOwnView);
    pass.constants.emplace_back(
        "shadow", int32_t(!tables && params.shadow == Shadow::gathered ? Shadow::scattered : params.shadow));
    pass.constants.emplace_back(
        "normals", int32_t(params.normals == Normals::baked ? Normals::blended : params.normals));
    if (!baked)
        pass.constants.insert(pass.constants.end(), {{"diffuse", int32_t(params.diffuse)},
                                                     {"curvature", int32_t(params.curvature)},
                                                     {"ambient", int32_t(params.ambient)}});
    if (tables) {
        for (const char* table : {"skin_lut", "skin_rows"}) pass.reads.push_back(table);
        if (!baked) pass.reads.push_back("skin_beckmann");
        read_transmission(pass, params.transmission, frame);
    } else {
        read_transmission_without_table(pass, params.transmission, frame);
    }
    const std::array<Rgb, 3> weights = occlusion_blend(frame.skin_gaussians);
    for (size_t i = 0; i < weights.size(); ++i)
        pass.values.push_back({"occlusion_weight_" + std::to_string(i),
                               Vec3{float(weights[i][0]), float(weights[i][1]), float(weights[i][2])}});
    PassList list;
    if (baked) {
        list.diffused_normals = DiffusedNormalsRequest{};
        pass.constants.emplace_back("skin_outside_atlas", int32_t(frame.has_skin_outside_atlas));
        for (const char* texture : kDiffusedNormalsTextures) pass.reads.push_back(texture);
        pass.values.emplace_back("own_normal_weight",
                                 own_normal_weights(frame.skin_gaussians, *list.diffused_normals));
        pass.values.emplace_back("green_spread", green_spread(frame.skin_gaussians, *list.diffused_normals));
        pass.values.emplace_back("diffused_texels", float(list.diffused_normals->size));
    }
    list.passes = {std::move(pass)};
    if (params.curvature == Curvature::image) list.needed_maps = {"curvature_map"};
    return list;
}

preintegrated::TableSettings table_settings(const Params& params) {
    const bool ring = params.construction == TableConstruction::full_ring;
    return {.construction = ring ? Construction::half_ring : Construction::sphere,
            .normal_lod_bias = params.normal_lod_bias,
            .shadow_width_mm = params.shadow_width_mm,
            .needs_beckmann = params.specular == SpecularModel::ksk};
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    const Params params = values.as<Params>();
    if (!reads_tables(params)) return std::vector<TableImage>{};
    Result<std::vector<TableImage>> images = preintegrated::bake_tables(table_settings(params), skin);
    if (!images) return images;
    for (TableImage& image : transmission_tables(params.transmission, skin))
        images->push_back(std::move(image));
    return images;
}

Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const Params params = values.as<Params>();
    return preintegrated::skin_values(table_settings(params), skin, !reads_tables(params));
}

std::vector<Figure> figures() {
    std::vector<Figure> all = preintegrated::unity_figures();
    for (Figure& figure : preintegrated::curve_figures()) all.push_back(std::move(figure));
    return all;
}

}  // namespace

Technique make_preintegrated_technique() {
    return {.id = "preintegrated",
            .summary = "scattering on curved skin, at bumps and shadow edges",
            .source = "Penner 2011, Pre-Integrated Skin Shading, GPU Pro 2; curves: Yeung 2015",
            .parameters = parameters(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .figures = figures};
}

}  // namespace dermis
