#pragma once
// Skin from what it is made of: melanin in the epidermis, blood in the dermis.
//
// Two layers of tissue below one smooth boundary. Pigments give the absorption of each layer at each
// wavelength, collagen gives the scattering; layered_albedo.h gives the spectrum, the CIE 1931 observer under
// D65 the colour. docs/skin_model.md has the formulas, ranges and errors.
//
//     SkinModel model{.melanin = 0.03, .blood = 0.04, .oxygen = 0.75};
//     Rgb albedo = skin_albedo(model);          // linear Rec. 709
//     Profile profile = skin_profile(model);    // albedo, width and volume for techniques and references
//
// The functions take check()ed models and are pure.

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"
#include "dermis/optics/tissue/layered_albedo.h"
#include "dermis/optics/tissue/spectra.h"

namespace dermis::inline optics {

/// skin_model_keys() has meaning, unit and range of each. The defaults are a fair face.
struct SkinModel {
    double melanin = 0.02;
    double pheomelanin = 0;
    double blood = 0.015;
    double epidermis_blood = 0;
    double oxygen = 0.75;
    double epidermis_mm = 0.06;
    double scattering_per_mm = 4.6;
    double scattering_power = 1.421;
    double g = 0.8;
    double eta = 1.4;
    friend bool operator==(const SkinModel&, const SkinModel&) = default;
};

/// One row for every number of the model: parses, checks and documents it.
struct SkinModelKey {
    std::string_view name;
    double SkinModel::*member;
    double min, max;
    std::string_view unit, meaning;
};
[[nodiscard]] std::span<const SkinModelKey> skin_model_keys();

/// Errors name the key, its value and its range.
[[nodiscard]] Result<void> check(const SkinModel& model);

/// Points of the model in the middle of the six groups of the typology angle; tone 1 (very light) to 6
/// (dark).
[[nodiscard]] SkinModel skin_model_of_tone(int tone);

/// Whether a profile's name is the text of a skin model.
[[nodiscard]] bool is_skin_model(std::string_view name);
/// "skin:melanin=0.03,blood=0.04": what is not named keeps its default. A first "tone=3" replaces
/// the defaults by skin_model_of_tone(). find_profile() takes the same text.
/// Errors: an unknown key, not a number, out of range.
[[nodiscard]] Result<SkinModel> parse_skin_model(std::string_view text);
/// The text of a model: the keys that differ from the default.
[[nodiscard]] std::string skin_model_text(const SkinModel& model);

/// Both layers at wavelength i of tissue::wavelength_nm().
struct SkinLayers {
    tissue::TissueLayer epidermis, dermis;
};
[[nodiscard]] SkinLayers skin_layers(const SkinModel& model, int i);

/// Share of diffuse light that entered and leaves again, at each wavelength.
using SkinSpectrum = std::array<double, tissue::kWavelengths>;
[[nodiscard]] SkinSpectrum skin_spectrum(const SkinModel& model);

/// Its colour: linear Rec. 709 under D65. May be below 0 in blue for skins that lie outside of Rec. 709.
[[nodiscard]] Rgb skin_albedo(const SkinModel& model);
[[nodiscard]] Rgb linear_of_spectrum(const SkinSpectrum& spectrum);

/// Mean distance at which light leaves, in each channel.
[[nodiscard]] Rgb skin_mean_radius_mm(const SkinModel& model);

/// Burley's profile of the model's albedo and mean radius; its volume is walk_medium_of(profile). A fifth of
/// a second.
[[nodiscard]] Profile skin_profile(const SkinModel& model);

/// Individual typology angle in degrees, atan((L* - 50) / b*): Chardon, Cretois, Hourseau 1991.
[[nodiscard]] double typology_angle_deg(const Rgb& albedo_linear);

}  // namespace dermis::inline optics
