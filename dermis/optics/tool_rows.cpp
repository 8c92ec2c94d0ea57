// Converts a tool's keys to {A, d} and back. Most tools differ only in the length that they state per d (a
// function of A) and in its unit.

#include "dermis/optics/tool_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/optics/artistic_kernel.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"

namespace dermis::inline optics {
namespace {

using std::numbers::pi;
using Values = ToolValues;
using LengthPerD = double (*)(double albedo);

constexpr double kMaxLength = 1e6, kMinLength = 1e-9;

double d_itself(double) {
    return 1;
}
// Cycles multiplies the radii of its Burley and random walk modes by 1 / (4 pi) before use.
double four_pi_mean_free_path_per_d(double albedo) {
    return 4 * pi * mean_free_path_per_d(albedo);
}

// Lengths as largest * colour, the form of most interfaces.
struct ScaledColor {
    double scale;
    Rgb color;
};
ScaledColor split_scale(const Rgb& lengths) {
    const double largest = *std::ranges::max_element(lengths);
    return {largest, {lengths[0] / largest, lengths[1] / largest, lengths[2] / largest}};
}

Rgb lengths_of(const BurleyProfile& burley, LengthPerD length_per_d, double mm_per_unit) {
    Rgb lengths;
    for (size_t c = 0; c < 3; ++c) lengths[c] = burley.d_mm[c] * length_per_d(burley.albedo[c]) / mm_per_unit;
    return lengths;
}

BurleyProfile burley_of_lengths(const Rgb& albedo, const Rgb& radius, double scale, LengthPerD length_per_d,
                                double mm_per_unit) {
    BurleyProfile burley{.albedo = albedo};
    for (size_t c = 0; c < 3; ++c) burley.d_mm[c] = radius[c] * scale * mm_per_unit / length_per_d(albedo[c]);
    return burley;
}

// ---- Look radii ------------------------------------------------------------------------------------------

constexpr double kFaceworksSkinRadius = 2.7;

double faceworks_red_d_mm() {
    return burley_equivalent(*find_profile("gpu_gems_3")).d_mm[0];
}

Values write_faceworks(const BurleyProfile& burley) {
    return {{kFaceworksSkinRadius * burley.d_mm[0] / faceworks_red_d_mm()}};
}
BurleyProfile read_faceworks(const Values& values) {
    return burley_equivalent(scaled(*find_profile("gpu_gems_3"), values[0][0] / kFaceworksSkinRadius));
}

// Jimenez 2015: mean radius = width / 3 * (0.001 + falloff) * (strength of the five wide Gaussians, the rest
// in the narrowest).
constexpr double kSeparableKernelRange = 3;

double separable_mean_radius(double strength) {
    const std::vector<GaussianTerm> red = gpu_gems_3_skin().terms;
    double weights = 0, weighted = 0;
    for (size_t i = 1; i < red.size(); ++i) {
        weights += red[i].weight[0];
        weighted += red[i].weight[0] * std::sqrt(pi * red[i].variance_mm2 / 2);
    }
    return strength * weighted / weights + (1 - strength) * std::sqrt(pi * red[0].variance_mm2 / 2);
}

constexpr ArtisticKernel kSeparableKernel;

Values write_separable(const BurleyProfile& burley) {
    Rgb widening;  // (0.001 + falloff) times width / 3
    for (size_t c = 0; c < 3; ++c)
        widening[c] = 2.5 * burley.d_mm[c] / separable_mean_radius(kSeparableKernel.strength[c]);
    const double unit = *std::ranges::max_element(widening) / 1.001;
    Rgb falloff;
    for (size_t c = 0; c < 3; ++c) falloff[c] = widening[c] / unit - 0.001;
    return {{kSeparableKernelRange * unit}, kSeparableKernel.strength, falloff};
}
BurleyProfile read_separable(const Values& values) {
    BurleyProfile burley;
    for (size_t c = 0; c < 3; ++c)
        burley.d_mm[c] = values[0][0] / kSeparableKernelRange * (0.001 + values[2][c]) *
                         separable_mean_radius(values[1][c]) / 2.5;
    return burley;
}

// ---- Lengths that follow from d and A --------------------------------------------------------------------

Values write_hdrp(const BurleyProfile& burley) {
    const ScaledColor d = split_scale(lengths_of(burley, d_itself, 1));
    return {d.color, {d.scale}};
}
BurleyProfile read_hdrp(const Values& values) {
    return burley_of_lengths({1, 1, 1}, values[0], values[1][0], d_itself, 1);
}

// Babylon.js 9.34 (subSurfaceConfiguration.js, subSurfaceScattering.fragment.js) takes a colour for 1/d in
// 1/mm and its largest channel also for the d in mm that the samples are drawn from: both are true if the
// largest is the reciprocal of the smallest. It takes the picture for half as wide as it is, so lengths on
// the picture are twice those of the profile.
constexpr double kBabylonWidening = 2;

Values write_babylon(const BurleyProfile& burley) {
    const double largest = *std::ranges::max_element(burley.d_mm);
    Rgb d_mm;  // a channel without light takes the largest
    for (size_t c = 0; c < 3; ++c) d_mm[c] = burley.d_mm[c] > 0 ? burley.d_mm[c] : largest;
    const double middle = std::sqrt(largest * *std::ranges::min_element(d_mm));
    return {{middle / d_mm[0], middle / d_mm[1], middle / d_mm[2]}, {kBabylonWidening / middle}};
}
BurleyProfile read_babylon(const Values& values) {
    BurleyProfile burley;
    for (size_t c = 0; c < 3; ++c) burley.d_mm[c] = kBabylonWidening / (values[0][c] * values[1][0]);
    return burley;
}

constexpr double kUnrealWorldUnitScale = 0.1;

Values write_unreal(const BurleyProfile& burley) {
    const ScaledColor path =
        split_scale(lengths_of(burley, diffuse_mean_free_path_per_d, 10 * kUnrealWorldUnitScale));
    return {burley.albedo, path.color, {path.scale}, {kUnrealWorldUnitScale}};
}
BurleyProfile read_unreal(const Values& values) {
    return burley_of_lengths(values[0], values[1], values[2][0] * values[3][0], diffuse_mean_free_path_per_d,
                             10);
}

constexpr double kMmPerMetre = 1000;

template <LengthPerD length_per_d>
Values write_blender(const BurleyProfile& burley) {
    const ScaledColor radius = split_scale(lengths_of(burley, length_per_d, kMmPerMetre));
    return {burley.albedo, radius.color, {radius.scale}};
}
template <LengthPerD length_per_d>
BurleyProfile read_blender(const Values& values) {
    return burley_of_lengths(values[0], values[1], values[2][0], length_per_d, kMmPerMetre);
}

constexpr double kMmPerCentimetre = 10;

Values write_openpbr(const BurleyProfile& burley) {
    const ScaledColor path = split_scale(lengths_of(burley, mean_free_path_per_d, kMmPerCentimetre));
    return {burley.albedo, {path.scale}, path.color};
}
BurleyProfile read_openpbr(const Values& values) {
    return burley_of_lengths(values[0], values[2], values[1][0], mean_free_path_per_d, kMmPerCentimetre);
}

// Beer-Lambert: sigma_t = -ln(colour) / distance. The shortest path as distance keeps colours at 1/e and
// above.
Values write_gltf(const BurleyProfile& burley) {
    const Rgb path_m = lengths_of(burley, mean_free_path_per_d, kMmPerMetre);
    const double distance = *std::ranges::min_element(path_m);
    Rgb color;
    for (size_t c = 0; c < 3; ++c) color[c] = std::exp(-distance / path_m[c]);
    return {burley.albedo, color, {distance}};
}
BurleyProfile read_gltf(const Values& values) {
    Rgb path_m;
    for (size_t c = 0; c < 3; ++c) path_m[c] = -values[2][0] / std::log(values[1][c]);
    return burley_of_lengths(values[0], path_m, 1, mean_free_path_per_d, kMmPerMetre);
}

constexpr double kSkinEta = 1.4;

Values write_pbrt(const BurleyProfile& burley) {
    const ScatteringMedium medium = medium_of(burley, burley.g, kSkinEta);
    return {medium.sigma_a_per_mm, medium.sigma_s_per_mm, {medium.g}, {medium.eta}, {1}};
}
BurleyProfile read_pbrt(const Values& values) {
    ScatteringMedium medium{.g = values[2][0], .eta = values[3][0]};
    for (size_t c = 0; c < 3; ++c) {
        medium.sigma_a_per_mm[c] = values[0][c] * values[4][0];
        medium.sigma_s_per_mm[c] = values[1][c] * values[4][0];
    }
    return burley_of(medium);
}

// ---- The rows --------------------------------------------------------------------------------------------

ToolKey color_key(std::string_view name, const Rgb& value, std::string_view meaning) {
    return {name, 3, value, 0, 1, "", meaning};
}
ToolKey ratio_key(std::string_view name, const Rgb& value, std::string_view meaning) {
    return {name, 3, value, kMinLength, kMaxLength, "", meaning};
}
ToolKey length_key(std::string_view name, double value, std::string_view unit, std::string_view meaning) {
    return {name, 1, {value}, kMinLength, kMaxLength, unit, meaning};
}

constexpr std::string_view kAlbedoInMap = "the albedo (read as 1; the base colour map has it)";
constexpr std::string_view kWalkBoundary = "index-matched half-space, diffuse light";

ToolRow faceworks() {
    return {{ToolId::faceworks,
             "faceworks",
             "width of a blur: the standard deviation of the widest of six Gaussians",
             "none: a normalised blur of irradiance",
             "the albedo; the shape becomes that of GPU Gems 3, with red's mean radius",
             {length_key("diffusionRadius", 2.7, "mm",
                         "2.7 mm is the skin of GPU Gems 3; divide by the mm in a "
                         "world unit")}},
            write_faceworks,
            read_faceworks};
}
ToolRow separable_sss_row() {
    return {{ToolId::separable_sss,
             "separable_sss",
             "width of a blur: half of it, over which its kernel runs from 0 to 3",
             "none: a normalised blur of irradiance",
             kAlbedoInMap,
             {length_key("sssWidth", 3, "mm",
                         "3 mm is the scale of GPU Gems 3; divide by the mm in a world unit"),
              color_key("strength", kSeparableKernel.strength, "the part of the light that is blurred"),
              ratio_key("falloff", kSeparableKernel.falloff, "widens red's Gaussians per channel")}},
            write_separable,
            read_separable};
}
ToolRow hdrp() {
    return {{ToolId::hdrp,
             "hdrp",
             "Burley d",
             "none: a normalised blur of irradiance, transmittance as Burley's",
             kAlbedoInMap,
             {color_key("scatteringDistance", {1, 0.37, 0.3}, "colour, the largest channel 1"),
              length_key("scatteringDistanceMultiplier", 1, "mm",
                         "Burley d of the largest channel; world scale "
                         "1 m a unit")}},
            write_hdrp,
            read_hdrp};
}
ToolRow babylon() {
    return {{ToolId::babylon,
             "babylon",
             "the reciprocal of Burley d, on the picture's plane",
             "none: a normalised blur of irradiance",
             kAlbedoInMap,
             {ratio_key("color", {1, 1, 1}, "of addDiffusionProfile; the widest channel the smallest"),
              length_key("metersPerUnit", 1, "",
                         "of the scene; divide by the units in a metre. Burley d is 2 mm / (color * "
                         "metersPerUnit)")}},
            write_babylon,
            read_babylon};
}
ToolRow unreal() {
    return {{ToolId::unreal,
             "unreal",
             "diffuse mean free path 1/sigma_tr (Enable Mean Free Path off)",
             "index-matched, perpendicular light (searchlight)",
             "",
             {color_key("surface_albedo", {0.91058, 0.338275, 0.2718}, "as the base colour, on average"),
              ratio_key("mean_free_path_color", {1, 0.088964, 0.072095}, "per channel, the largest 1"),
              length_key("mean_free_path_distance", 2.6748, "cm", "before the world unit scale"),
              length_key("world_unit_scale", kUnrealWorldUnitScale, "", "times the distance")}},
            write_unreal,
            read_unreal};
}

template <LengthPerD length_per_d>
ToolRow blender(ToolId id, std::string_view name, std::string_view length, std::string_view boundary) {
    return {{id,
             name,
             length,
             boundary,
             "",
             {color_key("base_color", {0.8, 0.8, 0.8}, "the albedo"),
              ratio_key("subsurface_radius", {1, 0.2, 0.1}, "per channel"),
              length_key("subsurface_scale", 0.05, "m", "times the radius; scene unit 1 m")}},
            write_blender<length_per_d>,
            read_blender<length_per_d>};
}

ToolRow openpbr() {
    return {{ToolId::openpbr,
             "openpbr",
             "mean free path 1/sigma_t",
             kWalkBoundary,
             "",
             {color_key("subsurface_color", {0.8, 0.8, 0.8}, "multiple-scattering albedo, linear Rec. 709"),
              length_key("subsurface_radius", 1, "cm", "scene unit 1 cm"),
              ratio_key("subsurface_radius_scale", {1, 0.5, 0.25}, "per channel")}},
            write_openpbr,
            read_openpbr};
}
ToolRow gltf() {
    return {{ToolId::gltf_volume_scatter,
             "gltf_volume_scatter",
             "mean free path 1/sigma_t",
             kWalkBoundary,
             "",
             {color_key("multiscatterColorFactor", {0.8, 0.6, 0.5}, "multiple-scattering albedo"),
              {"attenuationColor",
               3,
               {0.7, 0.5, 0.3},
               1e-12,
               1 - 1e-12,
               "",
               "what is left of white after the distance"},
              length_key("attenuationDistance", 0.001, "m", "sigma_t = -ln(attenuationColor) / distance")}},
            write_gltf,
            read_gltf};
}
ToolRow pbrt() {
    return {{ToolId::pbrt,
             "pbrt",
             "absorption and scattering coefficients",
             kWalkBoundary,
             "",
             {{"sigma_a", 3, {0.032, 0.17, 0.48}, 0, kMaxLength, "1/mm", "absorption"},
              {"sigma_s", 3, {0.74, 0.88, 1.01}, 0, kMaxLength, "1/mm", "scattering"},
              {"g", 1, {0}, -0.99, 0.99, "", "mean cosine"},
              {"eta", 1, {kSkinEta}, 1, 3, "", "index of refraction; does not enter the conversion"},
              {"scale", 1, {1}, kMinLength, kMaxLength, "", "times both sigmas; the mm in a scene unit"}}},
            write_pbrt,
            read_pbrt};
}

}  // namespace

const std::vector<ToolRow>& tool_rows() {
    static const std::vector<ToolRow> kRows = {
        faceworks(),
        separable_sss_row(),
        hdrp(),
        unreal(),
        babylon(),
        blender<four_pi_mean_free_path_per_d>(ToolId::blender_burley, "blender_burley",
                                              "4 pi times the mean free path 1/sigma_t",
                                              "index-matched, diffuse light"),
        blender<four_pi_mean_free_path_per_d>(ToolId::blender_random_walk, "blender_random_walk",
                                              "4 pi times the mean free path 1/sigma_t", kWalkBoundary),
        blender<diffuse_mean_free_path_per_d>(ToolId::blender_random_walk_skin, "blender_random_walk_skin",
                                              "diffuse mean free path 1/sigma_tr",
                                              "refractive: the albedo of a dipole with the material's index"),
        openpbr(),
        gltf(),
        pbrt(),
    };
    return kRows;
}

}  // namespace dermis::inline optics
