#include "dermis/shading/skin_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "dermis/bake/shadow_ramp.h"
#include "dermis/base/result.h"
#include "dermis/base/text.h"
#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/diffused_normals.h"
#include "dermis/optics/edge_expression.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/gaussian_lobes.h"
#include "dermis/optics/mean_curvature.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/profile.h"
#include "dermis/optics/wrap_reach.h"

namespace dermis::shading {
namespace {

// A float literal of six digits: "1.0", "0.000310047".
std::string literal(double value) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 6).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string vec3_literal(const Rgb& rgb) {
    return "vec3(" + literal(rgb[0]) + ", " + literal(rgb[1]) + ", " + literal(rgb[2]) + ")";
}

// A constant on a line of its own.
std::string vec3_constant(const std::string& name, const Rgb& value) {
    return "const vec3 " + name + " = " + vec3_literal(value) + ";\n";
}

// "0.31 %" of a part of 1.
std::string percent(double part) {
    const double rounded = double(int(part * 1e4 + 0.5)) / 100;
    return to_text(float(rounded)) + " %";
}

// Two digits, rounded up: "0.0027".
std::string error_text(double error) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::max(error, 1e-6))) - 1);
    return literal(std::ceil(error / unit) * unit);
}

// Steps of visibility that the edge is fitted at.
constexpr int kRampSteps = 129;

// "    vec3 a = 0.5 + polynomial_6(u, vec3(...), ...);", the coefficients halved, as the light is half of
// their sum.
std::string half_polynomial(const std::string& name, double start, const CurvaturePolynomial& polynomial) {
    std::string text = "    vec3 " + name + " = ";
    if (start != 0) text += literal(start) + " + ";
    text += "polynomial_6(u";
    for (const Rgb& term : polynomial)
        text += ", " + vec3_literal({0.5 * term[0], 0.5 * term[1], 0.5 * term[2]});
    return text + ");\n";
}

Rgb squared(Rgb value) {
    for (double& channel : value) channel *= channel;
    return value;
}

// skin_diffuse(n_dot_l, curvature_per_mm), with the error of its fit.
Result<std::string> diffuse_function(const GaussianSum& sum) {
    DERMIS_TRY_ASSIGN(const CurvatureExpressions form, fit_curvature_expressions(sum));
    return "// Diffuse light without a table: radiant exitance over irradiance at normal incidence, about 0 "
           "to 1.\n"
           "// n_dot_l from -1 to 1; curvature_per_mm 0 upwards, from 1 on the same. Within " +
           error_text(form.max_error) +
           " of the integral\n// over the sphere.\n"
           "vec3 skin_diffuse(float n_dot_l, float curvature_per_mm) {\n"
           "    float k = min(curvature_per_mm, 1.0), u = knee_coordinate(k, " +
           literal(kCurvatureKnee) + ");\n" + half_polynomial("a", 0.5, form.a) +
           half_polynomial("s", 0.5, form.s) + half_polynomial("k0", 0, form.k0) +
           half_polynomial("k1", 0, form.k1) + "    vec3 q = k * (" + vec3_literal(form.q[0]) + " + u * " +
           vec3_literal(form.q[1]) +
           ");\n"
           "    return line_and_hyperbola(vec3(n_dot_l), a, s, q, k0, k1);\n"
           "}\n";
}

// skin_shadow_edge(visibility) of the penumbra whose width suits the renderer's default.
Result<std::string> shadow_function(const Profile& profile) {
    DERMIS_TRY_ASSIGN(const std::vector<Rgb> ramp, shadow_ramp(profile, kShadowWidthMm, kRampSteps));
    const EdgeExpression edge = fit_edge_expression(ramp);
    std::string arguments;
    for (const Rgb& value : {edge.weight[0], edge.weight[1], edge.weight[2], edge.weight[3], edge.weight[4],
                             squared(edge.width[0]), edge.weight[5], squared(edge.width[1])})
        arguments += ", " + vec3_literal(value);
    return "// Light in a penumbra, 0 to 1, in place of the shadow's visibility, 0 to 1. The shadow's filter "
           "has to be\n"
           "// a disk of " +
           to_text(kShadowWidthMm) + " mm on the skin, at lights steeper than about 45 degrees. Within " +
           error_text(edge.max_error) +
           " of the integral.\n"
           "vec3 skin_shadow_edge(float visibility) {\n    return edge_of_hyperbolas(visibility" +
           arguments + ");\n}\n";
}

// skin_transmittance(thickness_mm), of the constants kSkinWeight0...
std::string transmission_function(const std::vector<ChannelGaussians>& terms) {
    std::string sum, total;
    for (size_t i = 0; i < terms.size(); ++i) {
        Rgb exponent;
        for (size_t c = 0; c < 3; ++c) exponent[c] = -0.5 * std::numbers::log2e / terms[i].variance_mm2[c];
        const std::string weight = "kSkinWeight" + std::to_string(i);
        sum += (i ? " + " : "") + weight + " * gaussian_falloff_rgb(thickness_mm, " + vec3_literal(exponent) +
               ")";
        total += (i ? " + " : "") + weight;
    }
    return "// Light through a slab, as part of the light that enters its far side: 1 at thickness 0. It "
           "ignores the far "
           "boundary\n// (d'Eon, Luebke 2007, section 14.5). thickness_mm is 0 upwards.\n"
           "vec3 skin_transmittance(float thickness_mm) {\n    vec3 total = " +
           total + ";\n    return (" + sum +
           ") / total;\n}\n\n"
           "// Of what a point of a slab sends out, the share that has entered its far side, 0 to 0.5; the "
           "rest has entered\n// here. skin_thin_light() mixes skin_diffuse(...) and max(-N.L, 0.0) by it, "
           "each "
           "times the visibility of the light\n// on its side: exact for a slab by the profile. "
           "thickness_mm is 0 upwards.\n"
           "vec3 skin_far_share(float thickness_mm) {\n    vec3 through = skin_transmittance(thickness_mm);\n"
           "    return through / (1.0 + through);\n}\n";
}

std::string mean_normal_function(const char* channel, const std::string& baked, const char* shorter,
                                 float own_weight) {
    return fmt::format(
        "vec3 skin_mean_normal_{}(vec3 red_texel, {}vec3 spread_texel, vec3 n_own) {{\n"
        "    float shorter = spread_texel.z * spread_texel.z * baked_skin(red_texel);\n"
        "    return mean_normal({}, {}, n_own, mix(1.0, {}, baked_skin(red_texel)));\n}}\n",
        channel, std::string_view(channel) == "red" ? "" : "vec3 green_texel, ", baked, shorter,
        literal(own_weight));
}

// Texels of baked normals to the mean normal of each channel, and the curvature of red's length.
std::string baked_normals_functions(const GaussianSum& sum) {
    const Vec3 own = own_normal_weights(sum, {});
    const MeanCurvature form = fit_mean_curvature(sum, 0);
    const std::string green = "baked_green(baked_red(red_texel), green_texel)";
    const std::string shorter = literal(green_spread(sum, {})) + " * shorter";
    std::string horner = literal(form.terms.back());
    for (size_t i = kMeanCurvatureTerms - 1; i-- > 0;)
        horner = literal(form.terms[i]) + " + u * (" + horner + ")";
    return "// Mean normals of the channels, shorter than 1 where the normals around the point differ: from "
           "the\n"
           "// texels of baked normals and the pixel's own normal. Where the texels hold no skin, the own "
           "normal.\n" +
           mean_normal_function("red", "baked_red(red_texel)", "shorter", own.x) + "\n" +
           mean_normal_function("green", green, shorter.c_str(), own.y) + "\n" +
           mean_normal_function("blue", green, shorter.c_str(), own.z) +
           "\n// The curvature of red's mean normal, 0 to 1 per mm, from its length. Within " +
           percent(form.max_error) +
           ".\nfloat skin_curvature_of_mean(float mean_length) {\n    float u = min(sqrt(max(1.0 - "
           "mean_length, 0.0)), " +
           literal(form.largest_u) + ");\n    return clamp(u * (" + horner + "), 0.0, 1.0);\n}\n";
}

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
        text += vec3_constant(fmt::format("kSkinVariance{}Mm2", i), terms[i].variance_mm2);
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
    std::string text = fmt::format("{}vec3 skin_ambient_band_{}(float curvature_per_mm) {{\n", comment, band);
    for (size_t i = 0; i < count; ++i) text += lobe_lines(i, "kSkinWeight", "kSkinVariance");
    text += "    vec3 total = " + sum_of(count, "", "") + ";\n";
    return text + "    return " + of_flat_skin + " * (" +
           sum_of(count, fmt::format(" * lobe_band_{}(kappa_", band), ")") + ") / total;\n}\n";
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
    std::string text = fmt::format(
        "// The profile as {} lobes, red, green, blue: weights, and variances in mm^2.\n", lobes.size());
    for (size_t i = 0; i < lobes.size(); ++i) {
        text += vec3_constant("kSkinLobeWeight" + std::to_string(i), lobes[i].weight);
        text += vec3_constant(fmt::format("kSkinLobeVariance{}Mm2", i), lobes[i].variance_mm2);
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

// What a shader of skin calls first.
const std::string kMainFunctions[] = {"skin_diffuse",        "skin_gain",           "skin_shadow_edge",
                                      "skin_ambient_band_1", "skin_ambient_band_2", "skin_far_share",
                                      "skin_thin_light"};

}  // namespace

Result<Source> profile_source(const Profile& profile) {
    const GaussianFit fit = to_gaussian_sum(profile);
    DERMIS_TRY(check_preintegrable(fit.sum));
    const std::vector<ChannelGaussians> terms = by_channel(fit.sum);
    std::string text = heading(profile, fit);
    for (const char* file :
         {"pi", "baked_normals", "closed_form", "spherical_gaussians", "transmission", "wrap", "zonal"})
        text += "#include \"shaders/include/skin/" + std::string(file) + ".glsl\"\n";
    DERMIS_TRY_ASSIGN(const std::string diffuse, diffuse_function(fit.sum));
    DERMIS_TRY_ASSIGN(const std::string shadow, shadow_function(profile));
    text += "\n" + gaussian_constants(terms) + "\n" + diffuse + "\n" + spherical_gaussians_function(fit.sum) +
            "\n" + wrap_function(wrap_reach(fit.sum)) + "\n" + ambient_functions(terms.size()) + "\n" +
            shadow + "\n" + transmission_function(terms) + "\n" + baked_normals_functions(fit.sum);
    return Source{"profile " + printable_line(profile.name), text};
}

Result<std::string> skin_text(const Profile& profile, std::span<const Source> functions, Language language,
                              std::span<const std::string> names) {
    DERMIS_TRY_ASSIGN(Source own, profile_source(profile));
    std::vector<Source> sources(functions.begin(), functions.end());
    sources.push_back(std::move(own));
    DERMIS_TRY_ASSIGN(std::vector<Unit> units, read_sources(sources));
    prefix_names(units);
    if (!names.empty()) DERMIS_TRY(keep_functions(units, names));
    std::vector<std::string> heading = {
        "Shading functions for skin: " + printable_line(profile.name) +
            ". Printed by `dermis export`; change its source, not this file.",
        "SPDX-License-Identifier: MIT, Copyright (c) 2026 The Dermis authors",
        "",
        "Units: lengths in mm, curvature in 1/mm, colours linear. Directions are normalised and point away "
        "from the surface.",
        "Pure functions: fetch textures and derivatives yourself and pass them. Needs 32-bit floats "
        "(highp).",
        "",
        "How to call it:"};
    for (const std::string& line : call_lines(units, language, names.empty() ? kMainFunctions : names))
        heading.push_back("    " + line);
    return print(units, language, heading);
}

}  // namespace dermis::shading
