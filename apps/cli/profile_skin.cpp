// dermis profile skin: a skin from its melanin and blood; its colour, width, volume and spectrum.

#include "profile_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "dermis/bake/profile_report.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/tissue/skin_model.h"
#include "dermis/plot/sheet.h"

namespace dermis::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ProfileSkinOptions {
    SkinModel model;
    std::string chart;
    bool json = false;
};

Rgb rgb_of(Vec3 c) {
    return {double(c.x), double(c.y), double(c.z)};
}

struct SkinNumbers {
    Profile profile;
    Rgb albedo, acescg, lab, radius_mm;
    ScatteringMedium volume;
    double typology_deg;
};

SkinNumbers numbers_of(const SkinModel& model) {
    const Profile profile = skin_profile(model);
    const Rgb albedo = skin_albedo(model);
    return {.profile = profile,
            .albedo = albedo,
            .acescg = rgb_of(inverse(kLinearFromAcesCg) * to_vec3(albedo)),
            .lab = rgb_of(lab_from_linear(to_vec3(albedo))),
            .radius_mm = {mean_radius_mm(profile, 0), mean_radius_mm(profile, 1), mean_radius_mm(profile, 2)},
            .volume = walk_medium_of(profile),
            .typology_deg = typology_angle_deg(albedo)};
}

Json skin_json(const SkinModel& model, const SkinNumbers& n) {
    Json pigments, spectrum = Json::array();
    for (const SkinModelKey& key : skin_model_keys()) pigments[std::string(key.name)] = model.*key.member;
    const SkinSpectrum reflectance = skin_spectrum(model);
    for (int i = 0; i < tissue::kWavelengths; ++i) {
        const SkinLayers layers = skin_layers(model, i);
        spectrum.push_back({{"nm", tissue::wavelength_nm(i)},
                            {"reflectance", reflectance[size_t(i)]},
                            {"epidermis_sigma_a_per_mm", layers.epidermis.sigma_a_per_mm},
                            {"dermis_sigma_a_per_mm", layers.dermis.sigma_a_per_mm},
                            {"reduced_sigma_s_per_mm", layers.dermis.sigma_s_per_mm}});
    }
    return {{"name", n.profile.name},
            {"model", pigments},
            {"albedo_linear_rec709", n.albedo},
            {"albedo_acescg", n.acescg},
            {"lab", n.lab},
            {"typology_angle_deg", n.typology_deg},
            {"mean_radius_mm", n.radius_mm},
            {"burley_d_mm", burley_equivalent(n.profile).d_mm},
            {"volume",
             {{"sigma_s_per_mm", n.volume.sigma_s_per_mm},
              {"sigma_a_per_mm", n.volume.sigma_a_per_mm},
              {"g", n.volume.g},
              {"eta", n.volume.eta}}},
            {"spectrum", spectrum}};
}

void print_skin(const SkinNumbers& n) {
    const auto row = [](const char* what, const Rgb& value) {
        std::printf("  %-34s %s\n", what, value_text(value).c_str());
    };
    std::printf("%s\n", n.profile.name.c_str());
    row("albedo, linear Rec. 709", n.albedo);
    row("albedo, ACEScg", n.acescg);
    row("L* a* b* (D65)", n.lab);
    std::printf("  %-34s %s\n", "typology angle (degrees)", number_text(n.typology_deg).c_str());
    row("mean radius (mm)", n.radius_mm);
    row("Burley d (mm)", burley_equivalent(n.profile).d_mm);
    row("volume: sigma_s (1/mm)", n.volume.sigma_s_per_mm);
    row("volume: sigma_a (1/mm)", n.volume.sigma_a_per_mm);
    std::printf("  %-34s %s, %s\n", "volume: g, eta", to_text(n.volume.g).c_str(),
                to_text(n.volume.eta).c_str());
    std::printf("Give the first line wherever a profile is asked for.\n");
}

Image patch_of(const Rgb& albedo) {
    constexpr int kSide = 96;
    Image image(kSide, kSide, 3, PixelFormat::u8, Encoding::srgb);
    const Vec3 encoded = srgb_encode(to_vec3(albedo));
    const float channels[3] = {encoded.x, encoded.y, encoded.z};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, std::clamp(channels[c], 0.0f, 1.0f));
    return image;
}

Result<void> write_chart(const ProfileSkinOptions& options) {
    DERMIS_TRY_ASSIGN(const Font font, Font::load());
    Sheet sheet{.title = "Skin by melanin and blood",
                .source = "below each patch: individual typology angle in degrees, L* a* b*",
                .note = "epidermis " + to_text(options.model.epidermis_mm) + " mm, oxygen saturation " +
                        to_text(options.model.oxygen) + "; columns: blood in the dermis"};
    for (const double melanin : {0.01, 0.03, 0.06, 0.1, 0.16, 0.25, 0.43}) {
        SheetRow row{.label = "melanin " + to_text(melanin)};
        for (const double blood : {0.002, 0.005, 0.01, 0.02, 0.04, 0.07}) {
            SkinModel model = options.model;
            model.melanin = melanin, model.blood = blood;
            const Rgb albedo = skin_albedo(model);
            const Vec3 lab = lab_from_linear(to_vec3(albedo));
            char beneath[64];
            std::snprintf(beneath, sizeof beneath, "%.0f; %.0f %.0f %.0f", typology_angle_deg(albedo),
                          double(lab.x), double(lab.y), double(lab.z));
            row.cells.push_back({"blood " + to_text(blood), patch_of(albedo), beneath});
        }
        sheet.rows.push_back(std::move(row));
    }
    return write_image(options.chart, compose_sheet(sheet, font));
}

Result<int> run_skin(const ProfileSkinOptions& options) {
    DERMIS_TRY(check(options.model));
    const SkinNumbers numbers = numbers_of(options.model);
    if (options.json)
        std::fputs((skin_json(options.model, numbers).dump(2) + "\n").c_str(), stdout);
    else
        print_skin(numbers);
    if (!options.chart.empty()) DERMIS_TRY(write_chart(options));
    return 0;
}

}  // namespace

std::string skin_flag_of(std::string_view key) {
    std::string flag = "--" + std::string(key);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

void add_profile_skin(CommandLine& line, Command* profile) {
    const auto options = std::make_shared<ProfileSkinOptions>();
    Command* command = line.add("skin", "Makes a skin from its melanin and blood",
                                "dermis profile skin --melanin 0.03 --blood 0.04 --oxygen 0.75", profile);
    for (const SkinModelKey& key : skin_model_keys())
        command
            ->add_option(skin_flag_of(key.name), options->model.*key.member, {key.min, key.max},
                         std::string(key.meaning) + (key.unit.empty() ? "" : ", " + std::string(key.unit)))
            ->capture_default_str();
    command->add_output("--chart", options->chart, "PNG file: patches over melanin and blood");
    command->add_flag("--json", options->json, "print JSON, with the spectrum");
    line.when_chosen(
        command,
        [options]() -> Result<FileUse> {
            if (options->chart.empty()) return FileUse{};
            if (to_lower(std::filesystem::path(options->chart).extension().string()) != ".png")
                return Error{"--chart " + options->chart + ": the chart is written as .png"};
            return FileUse{.outputs = {options->chart}, .inputs = {}};
        },
        [options] { return run_skin(*options); });
}

}  // namespace dermis::cli
