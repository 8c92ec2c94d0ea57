#include "dermis/optics/presets.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/optics/artistic_kernel.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/gltf_profile.h"
#include "dermis/optics/mtlx.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/primaries.h"
#include "dermis/optics/profile_file.h"
#include "dermis/optics/tissue/skin_model.h"

namespace dermis::inline optics {
namespace {

constexpr std::string_view kKeptPrefix = "object:";

struct KeptProfiles {
    std::mutex mutex;
    std::map<std::string, Profile, std::less<>> by_name;
};
KeptProfiles& kept_profiles() {
    static KeptProfiles kept;
    return kept;
}

bool is_plain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

Profile gpu_gems_3() {
    return {"gpu_gems_3", "d'Eon, Luebke 2007, GPU Gems 3, section 14.4", gpu_gems_3_skin()};
}

// Jensen et al. 2001, table 1: reduced scattering and absorption; g is part of the reduced coefficient.
Profile jensen(const char* name, const char* row, const Rgb& reduced_sigma_s, const Rgb& sigma_a) {
    const ScatteringMedium medium{
        .sigma_s_per_mm = reduced_sigma_s, .sigma_a_per_mm = sigma_a, .g = 0, .eta = 1.3};
    return {name, std::string("Jensen, Marschner, Levoy, Hanrahan 2001, table 1, ") + row + ", eta 1.3",
            DipoleProfile{medium}};
}
Profile jensen_skin1() {
    return jensen("jensen_skin1", "skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48});
}
Profile jensen_skin2() {
    return jensen("jensen_skin2", "skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145});
}

// The six skins of the OpenPBR examples. Their radius scales are Jensen's diffuse mean free paths in cm.
Profile openpbr(int number, const Rgb& color_acescg, const Rgb& radius_scale_cm) {
    constexpr const char* kRoman[] = {"I", "II", "III", "IV", "V", "VI"};
    BurleyProfile burley{.albedo = rec709_from_acescg(color_acescg)};
    for (size_t c = 0; c < 3; ++c)
        burley.d_mm[c] = 10 * radius_scale_cm[c] / diffuse_mean_free_path_per_d(burley.albedo[c]);
    return {"openpbr_skin_" + std::to_string(number),
            std::string("OpenPBR 1.1 example skin ") + kRoman[number - 1] +
                ": subsurface colour (ACEScg) and radius scale as diffuse mean free path in cm",
            burley};
}
constexpr Rgb kFairRadiusCm = {0.482, 0.169, 0.109}, kDarkRadiusCm = {0.367, 0.137, 0.068};

// Jimenez 2012 (SeparableSSS 1.0): the red Gaussians of GPU Gems 3 but the narrowest, widened per channel by
// 0.001 + falloff and mixed by strength with unscattered light. That light is given the narrowest Gaussian,
// which the source takes for light reflected at the surface. Its filter multiplies two 1-D kernels, which is
// not this radial profile exactly.
Profile separable_sss() {
    const ArtisticKernel kernel;
    const std::vector<GaussianTerm> red = gpu_gems_3_skin().terms;
    double scattered = 0;
    for (size_t i = 1; i < red.size(); ++i) scattered += red[i].weight[0];
    GaussianSum sum{.name = "separable_sss"};
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < red.size(); ++i) {
            const double width = 0.001 + kernel.falloff[c];
            GaussianTerm term{.variance_mm2 = red[i].variance_mm2 * width * width, .weight = {0, 0, 0}};
            term.weight[c] =
                i == 0 ? 1 - kernel.strength[c] : kernel.strength[c] * red[i].weight[0] / scattered;
            sum.terms.push_back(term);
        }
    return {
        "separable_sss",
        "Jimenez et al. 2015, Separable Subsurface Scattering, defaults of its code (strength .48 .41 .28, "
        "falloff 1 .37 .3), r in mm",
        sum};
}

// FSubsurfaceProfileStruct's defaults: a diffuse mean free path of 2.6748 mm times its colour.
Profile unreal_default() {
    BurleyProfile burley{.albedo = {0.91058, 0.338275, 0.2718}};
    constexpr Rgb kPathColor = {1.0, 0.088964, 0.072095};
    for (size_t c = 0; c < 3; ++c)
        burley.d_mm[c] = 2.6748 * 0.1 * 10 * kPathColor[c] / diffuse_mean_free_path_per_d(burley.albedo[c]);
    return {"unreal_default",
            "Unreal Engine 5.0 Python API, SubsurfaceProfileStruct defaults (diffuse mean free path)",
            burley};
}

struct Preset {
    std::string name;
    std::function<Profile()> make;
};

const std::vector<Preset>& presets() {
    static const std::vector<Preset> kPresets = {
        {"gpu_gems_3", gpu_gems_3},
        {"jensen_skin1", jensen_skin1},
        {"jensen_skin2", jensen_skin2},
        {"openpbr_skin_1",
         [] {
             return openpbr(1, {0.762, 0.652, 0.568}, kFairRadiusCm);
         }},
        {"openpbr_skin_2",
         [] {
             return openpbr(2, {0.671, 0.505, 0.371}, kFairRadiusCm);
         }},
        {"openpbr_skin_3",
         [] {
             return openpbr(3, {0.545, 0.445, 0.359}, kFairRadiusCm);
         }},
        {"openpbr_skin_4",
         [] {
             return openpbr(4, {0.351, 0.240, 0.148}, kDarkRadiusCm);
         }},
        {"openpbr_skin_5",
         [] {
             return openpbr(5, {0.227, 0.157, 0.091}, kDarkRadiusCm);
         }},
        {"openpbr_skin_6",
         [] {
             return openpbr(6, {0.073, 0.052, 0.025}, kDarkRadiusCm);
         }},
        {"separable_sss", separable_sss},
        {"unreal_default", unreal_default},
    };
    return kPresets;
}

// "burley:1,0.4,0.2"
Result<Profile> burley_from_lengths(std::string_view name) {
    const std::vector<std::string_view> parts = split(name.substr(name.find(':') + 1), ',');
    BurleyProfile burley;
    if (parts.size() != 1 && parts.size() != 3)
        return Error{"profile '" + std::string(name) + "': one or three lengths d in mm follow 'burley:'"};
    for (size_t c = 0; c < 3; ++c) {
        const std::string_view part = parts[parts.size() == 3 ? c : 0];
        const auto d = parse_number(part);
        if (!d)
            return Error{"profile '" + std::string(name) + "': '" + std::string(part) + "' is not a number"};
        burley.d_mm[c] = *d;
    }
    const Profile profile{std::string(name), "Christensen, Burley 2015, with d as given", burley};
    DERMIS_TRY(check(profile));
    return profile;
}

}  // namespace

GaussianSum gpu_gems_3_skin() {
    return {"gpu_gems_3",
            {{0.0064, {0.233, 0.455, 0.649}},
             {0.0484, {0.100, 0.336, 0.344}},
             {0.1870, {0.118, 0.198, 0.000}},
             {0.5670, {0.113, 0.007, 0.007}},
             {1.9900, {0.358, 0.004, 0.000}},
             {7.4100, {0.078, 0.000, 0.000}}}};
}

std::vector<std::string> profile_names() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    return names;
}

bool is_profile_file(std::string_view name) {
    const std::string extension = to_lower(utf8_path(name).extension().string());
    return extension == ".csv" || extension == ".mtlx" || extension == ".glb" || extension == ".gltf";
}

std::string keep_profile(const Profile& profile) {
    std::string name = std::string(kKeptPrefix);
    std::ranges::copy_if(profile.name, std::back_inserter(name), is_plain);
    name += ":" + hash_of(profile);
    KeptProfiles& kept = kept_profiles();
    const std::scoped_lock lock(kept.mutex);
    kept.by_name.try_emplace(name, profile);
    return name;
}

Result<Profile> find_profile(std::string_view name) {
    for (const Preset& preset : presets())
        if (preset.name == name) return preset.make();
    if (name.starts_with(kKeptPrefix)) {
        KeptProfiles& kept = kept_profiles();
        const std::scoped_lock lock(kept.mutex);
        if (const auto found = kept.by_name.find(name); found != kept.by_name.end()) return found->second;
    }
    if (name.starts_with("burley:")) return burley_from_lengths(name);
    if (is_skin_model(name)) {
        DERMIS_TRY_ASSIGN(const SkinModel model, parse_skin_model(name));
        return skin_profile(model);
    }
    if (is_profile_file(name)) {
        const std::string lower = to_lower(name);
        const std::filesystem::path path = utf8_path(name);
        return lower.ends_with(".csv")    ? read_profile_csv(path)
               : lower.ends_with(".mtlx") ? read_mtlx(path)
                                          : read_gltf_profile(path);
    }
    return Error{unknown_name("profile", name, profile_names()) +
                 ", or a .csv, .mtlx, .glb or .gltf file, burley:d_mm, or skin:melanin=0.02,blood=0.015"};
}

}  // namespace dermis::inline optics
