// Pre-integrated skin shading: Penner 2011, GPU Pro 2 and SIGGRAPH 2011 "Pre-Integrated Skin Shading".
// Assumes that within a few mean free paths the skin is a sphere of the local curvature under one distant
// light; a point then needs only N.L and curvature. Tables come from the bakers (exact on the sphere, or the
// published ring), the closed form from dermis/optics, the hand-made curves from Yeung 2015.

#include <algorithm>

#include "dermis/optics/diffused_normals.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/transmission.h"
#include "techniques/preintegrated/figures.h"
#include "techniques/preintegrated/tables.h"
#include "techniques/preintegrated/weights.h"

namespace dermis {
namespace {

enum class Diffuse : int32_t {
    lut = kDiffuseLut,
    half_ring = kDiffuseHalfRing,
    full_ring = kDiffuseFullRing,
    curve_2015 = kDiffuseCurve2015,
    closed_form = kDiffuseClosedForm,
    walk = kDiffuseWalk
};
enum class Curvature : int32_t {
    vertex = kCurvatureVertex,
    derivative = kCurvatureDerivative,
    image = kCurvatureImage
};
enum class Normals : int32_t {
    automatic = kNormalsAuto,
    baked = kNormalsBaked,
    blended = kNormalsBlended,
    lerp = kNormalsLerp,
    smooth = kNormalsSmooth,
    sharp = kNormalsSharp
};
enum class Shadow : int32_t {
    automatic = kShadowAuto,
    plain = kShadowPlain,
    scattered = kShadowScattered,
    gathered = kShadowGathered
};
enum class Ambient : int32_t {
    profile = kAmbientProfile,
    exact = kAmbientExact,
    curve_2015 = kAmbientCurve2015
};

constexpr const char* kOwnView = "skin_curvature";

struct Params {
    Diffuse diffuse = Diffuse::lut;
    Curvature curvature = Curvature::vertex;
    float curvature_gain = 1;
    Normals normals = Normals::automatic;
    Shadow shadow = Shadow::automatic;
    float shadow_width_mm = 2.5f;  // a wider filter lights the skin around a nose
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
    Ambient ambient = Ambient::profile;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(&Params::diffuse, "diffuse",
                {"lut", "half_ring", "full_ring", "curve_2015", "closed_form", "walk"},
                "light over N.L and curvature: exact table of the sphere; of the half ring of the Unity "
                "script or the "
                "full ring of Yeung 2015, which do not conserve energy; his curves, or closed form, without "
                "any table; walk: by random walks in balls, which with gain=curvature are exact on spheres")
        .choice(&Params::curvature, "curvature", {"vertex", "derivative", "image"},
                "source of the curvature; derivative depends on facets and camera")
        .number(&Params::curvature_gain, "curvature_gain", "", 0, 10,
                "factor on the curvature; 1 is physically right")
        .choice(&Params::normals, "normals", {"auto", "baked", "blended", "lerp", "smooth", "sharp"},
                "diffuse normal: mean over the profile, baked over the UV atlas; light of two mip levels, "
                "mixed per channel; the two normals mixed, as published; the smaller level; as mapped. auto: "
                "baked where head and settings allow it, else blended")
        .choice(&Params::shadow, "shadow", {"auto", "plain", "scattered", "gathered"},
                "penumbra as filtered; with scattered light by its width; or averaged over 64 places around "
                "the point by the profile, which needs a table. auto: gathered where diffuse reads a table, "
                "else scattered")
        .number(&Params::shadow_width_mm, "shadow_width_mm", "mm", 1, 40, "width of the filtered penumbra")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::gain, "gain", gain_names(), kGainHelp)
        .choice(&Params::ambient, "ambient", {"profile", "exact", "curve_2015"},
                "zonal harmonics for light from the environment: of the profile, on the ring of "
                "diffuse, else on the sphere; the sphere's in closed form per pixel; curves of 2015")
        .choice(&Params::specular, "specular", specular_model_names(),
                "specular model; ksk reads its Beckmann distribution from a table")
        .preset("cheap", "scattering at shadow edges by the penumbra's width, no transmission",
                {.shadow = Shadow::scattered, .transmission = Transmission::none})
        .preset("best", "the light of walks from vertex to vertex: a minute of walks, then cached",
                {.gain = Gain::links})
        .preset("source", "Penner 2011 as implemented in Unity: ring, derivatives, mixed normals",
                {.diffuse = Diffuse::half_ring,
                 .curvature = Curvature::derivative,
                 .normals = Normals::lerp,
                 .shadow = Shadow::plain,
                 .transmission = Transmission::none,
                 .gain = Gain::none,
                 .specular = SpecularModel::ksk})
        .preset("curve_2015", "Yeung 2015: curves instead of tables, for few texture units",
                {.diffuse = Diffuse::curve_2015,
                 .normals = Normals::sharp,
                 .shadow = Shadow::plain,
                 .transmission = Transmission::none,
                 .gain = Gain::none,
                 .ambient = Ambient::curve_2015})
        .build();
}

bool reads_tables(const Params& params) {
    return params.diffuse == Diffuse::lut || params.diffuse == Diffuse::half_ring ||
           params.diffuse == Diffuse::full_ring || params.diffuse == Diffuse::walk;
}

Shadow shadow_of(const Params& params) {
    if (params.shadow != Shadow::automatic) return params.shadow;
    return reads_tables(params) ? Shadow::gathered : Shadow::scattered;
}

// Baked normals hold the curvature and what light from all around sees, both of the sphere. Empty where the
// settings agree with that.
std::string settings_against_baked(const Params& params) {
    if (params.diffuse != Diffuse::lut && params.diffuse != Diffuse::walk) return "diffuse=lut";
    if (params.curvature != Curvature::vertex) return "curvature=vertex";
    return params.ambient != Ambient::profile ? "ambient=profile" : "";
}

std::string refusal(const ParameterValues& values) {
    const Params params = values.as<Params>();
    const std::string needed = settings_against_baked(params);
    if (params.normals == Normals::baked && !needed.empty())
        return "normals=baked needs " + needed + "; set it, or normals=auto";
    if (params.shadow == Shadow::gathered && !reads_tables(params))
        return "shadow=gathered reads a table; set diffuse=lut, or shadow=auto";
    return "";
}

// Why the scene has no baked normals; empty where it has. The curvature that they hold is red's.
std::string scene_against_baked(const Params& params, const FrameContext& frame) {
    if (!frame.atlas_fault.empty()) return frame.atlas_fault;
    if (frame.has_zonal_table) return "the scene's zonal_table replaces a part of them; drop it";
    if (frame.has_beckmann_table && params.specular == SpecularModel::ksk)
        return "their shader does not read the scene's beckmann_table; drop it";
    const Vec3 own = own_normal_weights(frame.skin_gaussians, {});
    const bool red_scatters_farthest = own.x < 1 && own.x <= std::min(own.y, own.z);
    return red_scatters_farthest ? "" : "red does not scatter farthest in the scene's profile";
}

void read_baked_normals(Pass& pass, PassList& list, const FrameContext& frame) {
    const DiffusedNormalsRequest request;
    list.diffused_normals = request;
    pass.constants.emplace_back("skin_outside_atlas", int32_t(frame.has_skin_outside_atlas));
    for (const char* texture : kDiffusedNormalsTextures) pass.reads.push_back(texture);
    pass.values.emplace_back("own_normal_weight", own_normal_weights(frame.skin_gaussians, request));
    pass.values.emplace_back("green_spread", green_spread(frame.skin_gaussians, request));
    pass.values.emplace_back("diffused_texels", float(request.size));
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    PassList list;
    bool baked = (params.normals == Normals::automatic && settings_against_baked(params).empty()) ||
                 params.normals == Normals::baked;
    if (const std::string fault = baked ? scene_against_baked(params, frame) : ""; !fault.empty()) {
        baked = false;
        if (params.normals == Normals::baked)
            list.refusal = "normals=baked: " + fault + ", or set normals=auto";
        else
            list.notices.push_back("normals=auto is blended, not baked: " + fault);
    }
    const bool tables = reads_tables(params);
    Pass pass = forward_skin_pass(!tables ? "preintegrated/textureless.frag"
                                  : baked ? "preintegrated/baked_normals.frag"
                                          : "preintegrated/preintegrated.frag",
                                  params.specular, frame, kOwnView);
    const bool chosen = params.normals != Normals::automatic && params.normals != Normals::baked;
    pass.constants.insert(pass.constants.end(),
                          {{"shadow", int32_t(shadow_of(params))},
                           {"normals", int32_t(chosen ? params.normals : Normals::blended)}});
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
    const std::array<Rgb, 3> weights = preintegrated::occlusion_blend(frame.skin_gaussians);
    for (size_t i = 0; i < weights.size(); ++i)
        pass.values.push_back({"occlusion_weight_" + std::to_string(i),
                               Vec3{float(weights[i][0]), float(weights[i][1]), float(weights[i][2])}});
    use_gain(pass, params.gain);
    if (baked) read_baked_normals(pass, list, frame);
    list.passes = {std::move(pass)};
    if (params.curvature == Curvature::image) list.needed_maps = {"curvature_map"};
    return list;
}

preintegrated::TableSettings table_settings(const Params& params) {
    return {.how = params.diffuse == Diffuse::half_ring   ? kUnity2011Ring
                   : params.diffuse == Diffuse::full_ring ? kYeung2015Ring
                                                          : Preintegration{},
            .shadow_width_mm = params.shadow_width_mm,
            .by_walks = params.diffuse == Diffuse::walk,
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
    return preintegrated::skin_values(params.shadow_width_mm, skin, !reads_tables(params));
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
            .refusal = refusal,
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .figures = figures};
}

}  // namespace dermis
