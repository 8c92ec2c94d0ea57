#include "dermis/shading/skin_text.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/gaussian_lobes.h"
#include "dermis/optics/wrap_reach.h"
#include "dermis/shading/closed_form_source.h"
#include "dermis/shading/literals.h"
#include "dermis/shading/prefix.h"

namespace dermis::shading {
namespace {

using namespace export_text;

std::string heading(const Profile& profile, const GaussianFit& fit) {
    const double error = std::ranges::max(fit.max_error);
    std::string text = "// Skin: " + printable_line(profile.name) +
                       ".\n// Source: " + printable_line(profile.source) +
                       ".\n// Coefficients are for linear Rec. 709 red, green, blue.\n";
    if (error > 0)
        text += "// The profile is replaced by Gaussians: up to " + percent(error) +
                " of the light is at a wrong distance.\n";
    return text;
}

std::string gaussian_constants(const std::vector<ChannelGaussians>& terms) {
    std::string text = "// Gaussians of the profile, red, green, blue: weights, and variances in mm^2.\n";
    for (size_t i = 0; i < terms.size(); ++i) {
        text += vec3_constant("kSkinWeight" + std::to_string(i), terms[i].weight);
        text += vec3_constant("kSkinVariance" + std::to_string(i) + "Mm2", terms[i].variance_mm2);
    }
    return text;
}

// One lobe's lines of a function over curvature: its kappa_i and its part_i of the light.
std::string lobe_lines(size_t i, const std::string& weight, const std::string& variance) {
    const std::string index = std::to_string(i);
    return "    vec3 kappa_" + index + " = lobe_kappa(curvature_per_mm, " + variance + index + "Mm2);\n" +
           "    vec3 part_" + index + " = " + weight + index + " * lobe_part(kappa_" + index + ");\n";
}

// "part_0 + part_1", or "part_0 * lobe_band_1(kappa_0) + ...".
std::string sum_of(size_t count, const std::string& behind, const std::string& end) {
    std::string text;
    for (size_t i = 0; i < count; ++i) {
        const std::string index = std::to_string(i);
        text += (i ? " + part_" : "part_") + index + (behind.empty() ? "" : behind + index + end);
    }
    return text;
}

std::string ambient_band(const std::string& comment, int band, const std::string& of_flat_skin,
                         size_t count) {
    std::string text =
        comment + "vec3 skin_ambient_band_" + std::to_string(band) + "(float curvature_per_mm) {\n";
    for (size_t i = 0; i < count; ++i) text += lobe_lines(i, "kSkinWeight", "kSkinVariance");
    text += "    vec3 total = " + sum_of(count, "", "") + ";\n";
    return text + "    return " + of_flat_skin + " * (" +
           sum_of(count, " * lobe_band_" + std::to_string(band) + "(kappa_", ")") + ") / total;\n}\n";
}

std::string ambient_functions(size_t count) {
    return ambient_band(
               "// Light from all around: what the bands of order 1 and 2 of the environment's spherical "
               "harmonics (of radiance) are\n// multiplied with, in place of Lambert's 2 pi / 3 and pi / 4; "
               "order 0 "
               "keeps pi. curvature_per_mm is 0 upwards.\n",
               1, "2.0 * kPi / 3.0", count) +
           "\n" + ambient_band("// The same for order 2.\n", 2, "kPi / 4.0", count);
}

// Two leave up to 0.10 of wide skins, three 0.03 (jensen_skin2 0.09), for radii from 2 mm.
constexpr int kLobes = 3;
// The error is stated from this radius up.
constexpr double kLeastLobeRadiusMm = 2;

std::string spherical_gaussians_function(const GaussianSum& sum) {
    const std::vector<ChannelGaussians> lobes = lobes_of(sum, kLobes, LobeWidth::deviation);
    const double error = merging_error(sum, lobes, kLeastLobeRadiusMm) + kLobeLightError;
    std::string text = "// The profile as " + std::to_string(lobes.size()) +
                       " lobes, red, green, blue: weights, and variances in mm^2.\n";
    for (size_t i = 0; i < lobes.size(); ++i) {
        text += vec3_constant("kSkinLobeWeight" + std::to_string(i), lobes[i].weight);
        text += vec3_constant("kSkinLobeVariance" + std::to_string(i) + "Mm2", lobes[i].variance_mm2);
    }
    text +=
        "\n// Diffuse light by spherical Gaussians, without a table; less exact than skin_diffuse.\n"
        "// Radiant exitance over irradiance at normal incidence, 0 to 1. n_dot_l from -1 to 1;\n"
        "// curvature_per_mm 0 upwards. Within " +
        error_text(error) + " of the integral over the sphere where it is at most " +
        literal(1 / kLeastLobeRadiusMm) + ".\n";
    text += "vec3 skin_spherical_gaussians(float n_dot_l, float curvature_per_mm) {\n";
    for (size_t i = 0; i < lobes.size(); ++i) text += lobe_lines(i, "kSkinLobeWeight", "kSkinLobeVariance");
    return text + "    return (" + sum_of(lobes.size(), " * lobe_light(n_dot_l, kappa_", ")") + ") / (" +
           sum_of(lobes.size(), "", "") + ");\n}\n";
}

std::string wrap_function(const WrapReach& reach) {
    return "// Of the profile, in mm^2: how far wrapped diffuse reaches.\n" +
           vec3_constant("kSkinSecondMomentMm2", reach.second_moment_mm2) +
           vec3_constant("kSkinBendMm2", reach.bend_mm2) +
           "\n// Wrapped diffuse, without a table: radiant exitance over irradiance at normal incidence, 0 "
           "to "
           "1.\n// n_dot_l from -1 to 1, curvature_per_mm the mean curvature of the surface, any sign.\n"
           "vec3 skin_wrap(float n_dot_l, float curvature_per_mm) {\n"
           "    return wrapped_cosine(n_dot_l, wrap_reach(curvature_per_mm, kSkinSecondMomentMm2, "
           "kSkinBendMm2));\n"
           "}\n";
}

}  // namespace

Result<Source> profile_source(const Profile& profile) {
    const GaussianFit fit = to_gaussian_sum(profile);
    DERMIS_TRY(check_preintegrable(fit.sum));
    const std::vector<ChannelGaussians> terms = by_channel(fit.sum);
    std::string text = heading(profile, fit);
    for (const char* file : {"pi", "closed_form", "spherical_gaussians", "transmission", "wrap", "zonal"})
        text += "#include \"shaders/include/skin/" + std::string(file) + ".glsl\"\n";
    DERMIS_TRY_ASSIGN(const std::string diffuse, diffuse_function(fit.sum));
    DERMIS_TRY_ASSIGN(const std::string shadow, shadow_function(profile));
    text += "\n" + gaussian_constants(terms) + "\n" + diffuse + "\n" + spherical_gaussians_function(fit.sum) +
            "\n" + wrap_function(wrap_reach(fit.sum)) + "\n" + ambient_functions(terms.size()) + "\n" +
            shadow + "\n" + transmission_function(terms);
    return Source{"profile " + printable_line(profile.name), text};
}

Result<std::string> skin_text(const Profile& profile, std::span<const Source> functions, Language language) {
    DERMIS_TRY_ASSIGN(Source own, profile_source(profile));
    std::vector<Source> sources(functions.begin(), functions.end());
    sources.push_back(std::move(own));
    DERMIS_TRY_ASSIGN(std::vector<Unit> units, read_sources(sources));
    prefix_names(units);
    const std::vector<std::string> heading = {
        "Shading functions for skin: " + printable_line(profile.name) +
            ". Printed by `dermis export`; change its source, not this file.",
        "SPDX-License-Identifier: MIT, Copyright (c) 2026 The Dermis authors", "",
        "Units: lengths in mm, curvature in 1/mm, colours linear. Directions are normalised and point away "
        "from the surface.",
        "Pure functions: fetch textures and derivatives yourself and pass them. Needs 32-bit floats "
        "(highp)."};
    return print(units, language, heading);
}

}  // namespace dermis::shading
