#include "dermis/optics/tissue/skin_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/optics/check_value.h"
#include "dermis/optics/preintegration/quadrature.h"

namespace dermis::inline optics {
namespace {

constexpr std::string_view kSkinPrefix = "skin:";

constexpr SkinModelKey kSkinKeys[] = {
    {"melanin", &SkinModel::melanin, 0, 1, "", "volume fraction of melanosomes in the epidermis"},
    {"pheomelanin", &SkinModel::pheomelanin, 0, 1, "",
     "share of the melanin that is pheomelanin, the rest is eumelanin"},
    {"blood", &SkinModel::blood, 0, 1, "", "volume fraction of blood in the dermis"},
    {"epidermis_blood", &SkinModel::epidermis_blood, 0, 1, "", "volume fraction of blood in the epidermis"},
    {"oxygen", &SkinModel::oxygen, 0, 1, "", "oxygen saturation of the blood"},
    {"epidermis_mm", &SkinModel::epidermis_mm, 0, 1, "mm", "thickness of the epidermis"},
    {"scattering_per_mm", &SkinModel::scattering_per_mm, 0.1, 100, "1/mm", "reduced scattering at 500 nm"},
    {"scattering_power", &SkinModel::scattering_power, 0, 4, "",
     "b of scattering * (wavelength / 500 nm)^-b"},
    {"g", &SkinModel::g, 0, 0.95, "", "mean cosine of the phase function of tissue"},
    {"eta", &SkinModel::eta, 1, 2, "", "index of refraction"},
};

// Gauss rule for the mean radius.
constexpr int kSkinWaves = 8;

}  // namespace

std::span<const SkinModelKey> skin_model_keys() {
    return kSkinKeys;
}

Result<void> check(const SkinModel& model) {
    for (const SkinModelKey& key : kSkinKeys) {
        const double value = model.*key.member;
        if (!(value >= key.min && value <= key.max))
            return out_of_range("skin model: " + std::string(key.name), value,
                                to_text(key.min) + " to " + to_text(key.max));
    }
    return {};
}

// Typology angles of 60, 48, 34, 19, -10 and -45 degrees; blood rises with lightness lost to it.
SkinModel skin_model_of_tone(int tone) {
    constexpr double kMelanin[] = {0.0056, 0.0162, 0.0291, 0.0479, 0.1067, 0.2983};
    constexpr double kBlood[] = {0.004, 0.006, 0.009, 0.011, 0.014, 0.018};
    const auto i = size_t(std::clamp(tone, 1, 6) - 1);
    return {.melanin = kMelanin[i], .blood = kBlood[i]};
}

bool is_skin_model(std::string_view name) {
    return name.starts_with(kSkinPrefix);
}

Result<SkinModel> parse_skin_model(std::string_view text) {
    const std::string place = "'" + std::string(text.substr(0, 100)) + "'";
    if (!is_skin_model(text))
        return Error{place + ": a skin model begins with '" + std::string(kSkinPrefix) + "'"};
    SkinModel model;
    if (text.size() == kSkinPrefix.size()) return model;
    for (const std::string_view part : split(text.substr(kSkinPrefix.size()), ',')) {
        const size_t equal = part.find('=');
        const std::string_view name = trim(part.substr(0, equal));
        const auto key = std::find_if(std::begin(kSkinKeys), std::end(kSkinKeys),
                                      [&](const SkinModelKey& k) { return k.name == name; });
        const bool is_tone = name == "tone" && part.data() == text.data() + kSkinPrefix.size();
        if (key == std::end(kSkinKeys) && !is_tone) {
            std::vector<std::string> names;
            for (const SkinModelKey& k : kSkinKeys) names.emplace_back(k.name);
            return Error{place + ": " + unknown_name("key", name, names)};
        }
        const auto number =
            equal == std::string_view::npos ? std::nullopt : parse_number(trim(part.substr(equal + 1)));
        if (!number)
            return Error{place + ": " + std::string(name) +
                         " needs a number, as in 'skin:melanin=0.03,blood=0.04'"};
        if (is_tone && (!(*number >= 1 && *number <= 6) || *number != int(*number)))
            return out_of_range("skin model: tone", *number, "1 to 6, without a fraction");
        if (is_tone)
            model = skin_model_of_tone(int(*number));
        else
            model.*key->member = *number;
    }
    DERMIS_TRY(check(model));
    return model;
}

std::string skin_model_text(const SkinModel& model) {
    std::string text(kSkinPrefix);
    for (const SkinModelKey& key : kSkinKeys)
        if (model.*key.member != SkinModel{}.*key.member)
            text += (text.size() > kSkinPrefix.size() ? "," : "") + std::string(key.name) + "=" +
                    to_text(model.*key.member);
    return text;
}

SkinLayers skin_layers(const SkinModel& model, int i) {
    const double baseline = tissue::baseline_sigma_a_per_mm(i);
    const double blood = tissue::blood_sigma_a_per_mm(i, model.oxygen);
    const double melanin = (1 - model.pheomelanin) * tissue::eumelanin_sigma_a_per_mm(i) +
                           model.pheomelanin * tissue::pheomelanin_sigma_a_per_mm(i);
    // Jacques 2013, equation 2.
    const double scattering =
        model.scattering_per_mm * std::pow(tissue::wavelength_nm(i) / 500, -model.scattering_power);
    const double rest = std::max(0.0, 1 - model.melanin - model.epidermis_blood);
    return {{scattering, model.melanin * melanin + model.epidermis_blood * blood + rest * baseline},
            {scattering, model.blood * blood + (1 - model.blood) * baseline}};
}

namespace {

// Fourier transform of the profile at the wave number k: diffusion along the surface adds D k^2, D = 1 / (3
// sigma_s'), to the absorption (Haskell et al. 1994, Boundary conditions for the diffusion equation).
double transform_at(const SkinModel& model, int i, double k_per_mm) {
    SkinLayers layers = skin_layers(model, i);
    if (k_per_mm <= 0)
        return tissue::layered_albedo(layers.epidermis, model.epidermis_mm, layers.dermis, model.g,
                                      model.eta);
    const auto raise = [&](tissue::TissueLayer& layer) {
        const double sigma_t = layer.sigma_s_per_mm + layer.sigma_a_per_mm;
        layer.sigma_a_per_mm += k_per_mm / std::atan(k_per_mm / sigma_t) - sigma_t;
    };
    raise(layers.epidermis);
    raise(layers.dermis);
    return tissue::layered_albedo(layers.epidermis, model.epidermis_mm, layers.dermis, model.g, model.eta);
}

SkinSpectrum spectrum_at(const SkinModel& model, double k_per_mm) {
    SkinSpectrum spectrum;
    for (int i = 0; i < tissue::kWavelengths; ++i) spectrum[size_t(i)] = transform_at(model, i, k_per_mm);
    return spectrum;
}

}  // namespace

SkinSpectrum skin_spectrum(const SkinModel& model) {
    return spectrum_at(model, 0);
}

Rgb linear_of_spectrum(const SkinSpectrum& spectrum) {
    Rgb linear = {};
    for (size_t i = 0; i < spectrum.size(); ++i)
        for (size_t c = 0; c < 3; ++c) linear[c] += tissue::linear_weights()[i][c] * spectrum[i];
    return linear;
}

Rgb skin_albedo(const SkinModel& model) {
    return linear_of_spectrum(skin_spectrum(model));
}

// A profile's mean radius is the integral of (1 - transform(k) / transform(0)) / k^2 over k; k = k0 u / (1 -
// u). A channel's light is that of its positive shares: the negative ones would take narrow light from wide
// light.
Rgb skin_mean_radius_mm(const SkinModel& model) {
    static const preintegration::GaussLegendre<kSkinWaves> kRule;
    constexpr double kMiddlePerMm = 2;
    const auto light = [](const SkinSpectrum& spectrum) {
        Rgb sum = {};
        for (size_t i = 0; i < spectrum.size(); ++i)
            for (size_t c = 0; c < 3; ++c)
                sum[c] += std::max(0.0, tissue::linear_weights()[i][c]) * spectrum[i];
        return sum;
    };
    const Rgb all = light(skin_spectrum(model));
    Rgb radius = {};
    for (size_t n = 0; n < kSkinWaves; ++n) {
        const double u = kRule.node(n);
        const Rgb wave = light(spectrum_at(model, kMiddlePerMm * u / (1 - u)));
        for (size_t c = 0; c < 3; ++c)
            radius[c] += kRule.weight(n) * (1 - wave[c] / all[c]) / (kMiddlePerMm * u * u);
    }
    return radius;
}

Profile skin_profile(const SkinModel& model) {
    const Rgb albedo = skin_albedo(model), radius = skin_mean_radius_mm(model);
    constexpr double kDarkest = 0.001, kShortestMm = 0.001;  // also where blue lies outside of Rec. 709
    BurleyProfile burley;
    for (size_t c = 0; c < 3; ++c) {
        burley.albedo[c] = std::clamp(albedo[c], kDarkest, 1.0);
        burley.d_mm[c] = std::max(radius[c] / 2.5, kShortestMm);
    }
    return {skin_model_text(model), "skin from pigments (docs/skin_model.md)", burley};
}

double typology_angle_deg(const Rgb& c) {
    const Vec3 lab = lab_from_linear({float(c[0]), float(c[1]), float(c[2])});
    return std::atan2(double(lab.x) - 50, double(lab.z)) * 180 / std::numbers::pi;
}

}  // namespace dermis::inline optics
