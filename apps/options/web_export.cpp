#include "web_export.h"

#include <algorithm>

#include "catalog/catalog.h"
#include "dermis/bake/shadow_ramp.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/shading/skin_text.h"
#include "techniques/preintegrated/constants.h"

namespace dermis::cli {
namespace {

constexpr const char* kNumerals[] = {"I", "II", "III", "IV", "V", "VI"};
constexpr std::string_view kSharedShaders[] = {"shaders/include/constants.h", "shaders/renderer/constants.h",
                                               "techniques/preintegrated/constants.h",
                                               "shaders/renderer/tone_map.glsl"};

Result<TableImage> table_of(std::span<const TableImage> tables, std::string_view name) {
    const auto table = std::ranges::find(tables, name, &TableImage::name);
    if (table == tables.end()) return Error{"the technique makes no table " + std::string(name)};
    return *table;
}

// The page's data of one skin, by the technique's default settings.
class ToneMaker {
  public:
    static Result<ToneMaker> create() {
        DERMIS_TRY_ASSIGN(const Technique* technique,
                          find_technique(built_in_catalog().techniques, "preintegrated"));
        ToneMaker maker(*technique);
        DERMIS_TRY(maker.values_.set("shadow_width_mm", to_text(kShadowWidthMm)));
        return maker;
    }

    [[nodiscard]] Result<WebTone> make(const std::string& name, const std::string& profile_name,
                                       Vec3 tint_linear, Vec3 mean_linear) const {
        Result<Profile> profile = find_profile(profile_name);
        if (!profile) return profile.error();
        SkinContext skin = {.profile = *profile, .gaussians = to_gaussian_sum(*profile).sum};
        DERMIS_TRY_ASSIGN(const std::vector<TableImage> tables, technique_.tables(values_, skin));
        DERMIS_TRY_ASSIGN(const TableImage diffuse, table_of(tables, "skin_lut"),
                          rows = table_of(tables, "skin_rows"));
        if (!rows) return rows.error();
        WebTone tone = {.name = name,
                        .description = profile->name,
                        .albedo_tint_linear = tint_linear,
                        .mean_albedo_linear = mean_linear * tint_linear,
                        .diffuse_table = diffuse,
                        .rows_table = *rows,
                        .gain = walked_gain_form(walk_medium_of(*profile))};
        const PassList list = technique_.build(values_, {.skin_gaussians = skin.gaussians});
        for (const auto& [value_name, value] : list.passes.front().values)
            for (size_t i = 0; i < tone.occlusion_weights.size(); ++i)
                if (value_name == "occlusion_weight_" + std::to_string(i))
                    tone.occlusion_weights[i] = std::get<Vec3>(value);
        return tone;
    }

  private:
    explicit ToneMaker(const Technique& technique) : technique_(technique), values_(technique.parameters) {}
    const Technique& technique_;
    ParameterValues values_;
};

// The scene's own skin, then the six tones of OpenPBR.
Result<std::vector<WebTone>> make_tones(const Scene& scene) {
    DERMIS_TRY_ASSIGN(const ToneMaker maker, ToneMaker::create());
    DERMIS_TRY_ASSIGN(const Vec3 mean, mean_skin_albedo(scene));
    std::vector<WebTone> tones;
    DERMIS_TRY_ASSIGN(WebTone own,
                      maker.make("Own", scene.skin.profile, scene.skin.albedo_tint_linear, mean));
    tones.push_back(std::move(own));
    for (int tone = 1; tone <= 6; ++tone) {
        DERMIS_TRY_ASSIGN(WebTone made,
                          maker.make(kNumerals[tone - 1], "openpbr_skin_" + std::to_string(tone),
                                     tint_towards(skin_tone_albedo_linear(tone), mean), mean));
        tones.push_back(std::move(made));
    }
    return tones;
}

}  // namespace

Result<WebPage> make_web_page(const SceneChoice& choice, const std::string& profile,
                              std::vector<std::filesystem::path>& inputs) {
    Result<Scene> scene = choice.load();
    if (!scene) return scene.error();
    if (!profile.empty()) scene->skin.profile = profile;
    inputs = files_of(*scene);
    DERMIS_TRY(complete_scene(*scene));
    Result<std::vector<WebTone>> tones = make_tones(*scene);
    if (!tones) return tones.error();
    return dermis::make_web_page({.scene = *scene,
                                  .tones = std::move(*tones),
                                  .functions = shading::skin_sources(),
                                  .texts = built_in_web_texts(),
                                  .shared_shaders = kSharedShaders,
                                  .table_max_curvature_per_mm = kMaxCurvaturePerMm,
                                  .shadow_width_mm = kShadowWidthMm});
}

}  // namespace dermis::cli
