#include "dermis/judge/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "dermis/image/io.h"
#include "dermis/scene/scene_words.h"

namespace dermis::inline judge {

extern const std::string_view kReportPage;

namespace {

using Json = nlohmann::ordered_json;

// The maps' last colour is this share of the largest value, so that a single outlier does
// not darken all other pixels.
constexpr double kFullQuantile = 0.995;

Result<std::string> data_uri(const Image& image) {
    const Result<std::vector<std::byte>> png = encode_image(".png", image);
    if (!png) return png.error();
    return "data:image/png;base64," + base64(*png);
}

Result<std::string> picture_uri(const Image& radiance, const Scene& scene) {
    const Image shown = tone_mapped(radiance, scene.tone_map, std::exp2(scene.exposure_ev));
    Image opaque(shown.width, shown.height, 3);
    for (size_t i = 0; i < opaque.pixel_count(); ++i)
        std::copy_n(&shown.floats()[size_t(shown.channels) * i], 3, &opaque.floats()[3 * i]);
    return data_uri(convert(opaque, PixelFormat::u8, Encoding::srgb));
}

double quantile(const Image& values, const Image& mask, double share) {
    std::vector<float> inside;
    for (size_t i = 0; i < mask.pixel_count(); ++i)
        if (mask.floats()[i] > 0) inside.push_back(values.floats()[i]);
    if (inside.empty()) return 0;
    const auto at = inside.begin() + std::ptrdiff_t(double(inside.size() - 1) * share);
    std::ranges::nth_element(inside, at);
    return *at;
}

// Two figures, for reading, and never 0.
double rounded_up(double full) {
    full = std::max(full, 1e-6);
    const double unit = std::pow(10.0, std::floor(std::log10(full)) - 1);
    return std::ceil(full / unit) * unit;
}

// One scale for all techniques, so that maps can be compared.
double common_full(const Comparison& comparison, Image Compared::*map) {
    double full = 0;
    for (const Compared& row : comparison.rows)
        full = std::max(full, quantile(row.*map, comparison.masks.skin, kFullQuantile));
    return rounded_up(full);
}

// Scale of the reference's effect of scattering; the techniques' effects use the same.
double effect_full(const Comparison& comparison, const Image& effect) {
    Image size(effect.width, effect.height, 1);
    for (size_t i = 0; i < size.pixel_count(); ++i) {
        const float* at = &effect.floats()[3 * i];
        size.floats()[i] = std::abs(at[0] + at[1] + at[2]) / 3;
    }
    return rounded_up(quantile(size, comparison.masks.skin, kFullQuantile));
}

struct Scales {
    double flip = 0, distance = 0, effect = 0;
};

Result<void> add_image(Json& images, std::string_view group, const std::string& label,
                       Result<std::string> uri) {
    if (!uri) return uri.error();
    images.push_back({{"group", group}, {"label", label}, {"uri", std::move(*uri)}});
    return {};
}

Result<Json> images_of(const Scene& scene, const Comparison& comparison, const Image& effect,
                       const Scales& scales) {
    Json images = Json::array();
    Result<void> good;
    const auto add = [&](std::string_view group, const std::string& label, Result<std::string> uri) {
        if (good) good = add_image(images, group, label, std::move(uri));
    };
    const Image& skin = comparison.masks.skin;
    const auto signed_uri = [&](const Image& map) { return data_uri(signed_map(map, scales.effect, skin)); };
    add("picture", "reference", picture_uri(comparison.reference_radiance, scene));
    for (const Compared& row : comparison.rows)
        add("picture", row.contestant.name(), picture_uri(row.radiance, scene));
    add("regions", "regions of the skin", data_uri(region_picture(comparison.regions, skin)));
    add("effect", "reference", signed_uri(effect));
    if (comparison.second)
        add("effect", "reference by " + std::string(judge_name(*comparison.second_integrator)),
            signed_uri(mean_effect(comparison.second->effect)));
    for (const Compared& row : comparison.rows) add("effect", row.contestant.name(), signed_uri(row.effect));
    for (const Compared& row : comparison.rows)
        add("what is left", row.contestant.name(), signed_uri(difference(row.effect, effect)));
    for (const Compared& row : comparison.rows)
        add("FLIP", row.contestant.name(), data_uri(heat_map(row.flip, scales.flip, skin)));
    for (const Compared& row : comparison.rows)
        add("linear error", row.contestant.name(), data_uri(heat_map(row.distance, scales.distance, skin)));
    if (!good) return good.error();
    return images;
}

Json json_number(std::optional<double> value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json rows_of(const Comparison& comparison) {
    Json rows = Json::array();
    const std::vector<ScoreRow> scores = score_rows("", comparison);
    for (size_t i = 0; i < scores.size(); ++i) {
        Json row = {{"technique", scores[i].technique},
                    {"settings", scores[i].settings},
                    {"summary", comparison.rows[i].contestant.technique->summary}};
        for (const ScoreColumn& column : score_columns())
            row[std::string(column.name)] = json_number(column.get(scores[i]));
        if (scores[i].time_ratio <= 0) row["time_ratio"] = nullptr;
        rows.push_back(std::move(row));
    }
    return rows;
}

Json regions_of(const Comparison& comparison) {
    Json regions = Json::array();
    for (const Region region : kRegions) {
        const Vec3 c = region_color(region) * 255;
        Json shares = Json::array();
        for (const Compared& row : comparison.rows) {
            const std::optional<Captured>& found = row.first.regions[size_t(region)].captured;
            shares.push_back(found && found->all.known() ? Json(found->all.share) : Json(nullptr));
        }
        const std::optional<Captured>& first = comparison.rows.front().first.regions[size_t(region)].captured;
        regions.push_back({{"name", region_name(region)},
                           {"text", region_text(region)},
                           {"color", {std::lround(c.x), std::lround(c.y), std::lround(c.z)}},
                           {"pixels", first ? first->pixels : 0},
                           {"effect_rms", first ? json_number(first->all.effect_rms) : Json(nullptr)},
                           {"shares", std::move(shares)}});
    }
    return regions;
}

std::string_view integrator_text(Integrator integrator) {
    if (integrator == Integrator::walk) return "random walks through the volume";
    if (integrator == Integrator::lambert) return "no transport: light leaves where it entered";
    return "surface integral of the diffusion profile";
}

size_t covered(const Image& mask) {
    return size_t(std::ranges::count_if(mask.floats(), [](float v) { return v > 0; }));
}

Json judge_json(Integrator integrator, const EffectReference& reference) {
    return {{"name", judge_name(integrator)},
            {"integrator", integrator_text(integrator)},
            {"samples", reference.samples},
            {"effect_rms", reference.noise.effect_rms},
            {"reference_noise", reference.noise.noise_rms}};
}

// The first decides.
Json judges_of(const Comparison& comparison) {
    Json judges = Json::array({judge_json(comparison.integrator, comparison.reference)});
    if (comparison.second) judges.push_back(judge_json(*comparison.second_integrator, *comparison.second));
    return judges;
}

Json facts_of(const Scene& scene, const Comparison& comparison, const ComparisonSettings& settings) {
    const ReferenceSettings& reference = settings.reference;
    const bool traced = reference.lighting.ambient == AmbientModel::traced;
    return {{"width", settings.width},
            {"height", settings.height},
            {"profile", scene.skin.profile},
            {"ambient", traced ? "traced" : "as the renderer approximates it, on both sides"},
            {"grid", settings.grid},
            {"probes", settings.probes},
            {"walks", settings.walks},
            {"judges", judges_of(comparison)},
            {"reference_rmse", comparison.reference_rmse},
            {"camera", camera_text(scene.camera)},
            {"light", light_text(scene.key_light())},
            {"device", comparison.device},
            {"frames", settings.frames},
            {"shadow_map_size", settings.shadow_map_size},
            {"skin_pixels", covered(comparison.masks.skin)},
            {"terminator_pixels", covered(comparison.masks.terminator)},
            {"penumbra_pixels", covered(comparison.masks.penumbra)},
            {"terminator_cosine", kTerminatorCosine},
            {"penumbra_mm", kPenumbraBandMm}};
}

Json color_stops(Vec3 (*color)(float), float first) {
    constexpr int kCount = 20;
    Json stops = Json::array();
    for (int i = 0; i <= kCount; ++i) {
        const Vec3 c = color(first + (1 - first) * float(i) / kCount) * 255;
        stops.push_back({std::lround(c.x), std::lround(c.y), std::lround(c.z)});
    }
    return stops;
}

Json scales_json(const Scales& scales) {
    const Json heat = color_stops(heat_color, 0), both = color_stops(signed_color, -1);
    return Json::array({{{"label",
                          "effect: darker or brighter than without scattering; what is left: than the "
                          "reference; mean of the channels"},
                         {"stops", both},
                         {"from", -scales.effect},
                         {"to", scales.effect}},
                        {{"label", "FLIP"}, {"stops", heat}, {"from", 0}, {"to", scales.flip}},
                        {{"label", "linear error, largest channel"},
                         {"stops", heat},
                         {"from", 0},
                         {"to", scales.distance}}});
}

void replace_all(std::string& text, std::string_view what, std::string_view with) {
    for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

Result<std::string> report_html(const Scene& scene, const Comparison& comparison,
                                const ComparisonSettings& settings) {
    const Image effect = mean_effect(comparison.reference.effect);
    const Scales scales{.flip = common_full(comparison, &Compared::flip),
                        .distance = common_full(comparison, &Compared::distance),
                        .effect = effect_full(comparison, effect)};
    Result<Json> images = images_of(scene, comparison, effect, scales);
    if (!images) return images.error();
    std::vector<std::string> warnings = scene.warnings;
    warnings.insert(warnings.end(), comparison.warnings.begin(), comparison.warnings.end());
    const Json data = {{"scene", scene.name},
                       {"credit", scene.credit},
                       {"warnings", warnings},
                       {"images", std::move(*images)},
                       {"rows", rows_of(comparison)},
                       {"regions", regions_of(comparison)},
                       {"facts", facts_of(scene, comparison, settings)},
                       {"scales", scales_json(scales)}};
    // No text of the data may end the script element or start another.
    std::string json = data.dump(-1, ' ', true, Json::error_handler_t::replace);
    replace_all(json, "<", "\\u003c");
    std::string page(kReportPage);
    replace_all(page, "/*DATA*/", json);
    return page;
}

namespace {

// CIE L* of about 3, 22, 41, 60, 79, 96: equal steps, so that equal differences look equal.
constexpr Vec3 kStops[] = {{0.04f, 0.03f, 0.10f}, {0.29f, 0.10f, 0.45f}, {0.66f, 0.18f, 0.45f},
                           {0.93f, 0.40f, 0.27f}, {0.99f, 0.71f, 0.36f}, {0.99f, 0.97f, 0.78f}};
// From 0 outwards, of the same lightness on both sides: CIE L* of about 3, 33, 62, 92.
constexpr Vec3 kAbove[] = {
    {0.05f, 0.05f, 0.05f}, {0.60f, 0.13f, 0.12f}, {0.95f, 0.48f, 0.33f}, {1.00f, 0.89f, 0.75f}};
constexpr Vec3 kBelow[] = {
    {0.05f, 0.05f, 0.05f}, {0.10f, 0.29f, 0.62f}, {0.33f, 0.62f, 0.92f}, {0.78f, 0.93f, 1.00f}};
constexpr Vec3 kOutside = {0.11f, 0.11f, 0.12f};

// 0 is the first stop, 1 the last; clamped.
Vec3 between(std::span<const Vec3> stops, float value) {
    const size_t last = stops.size() - 1;
    const float at = (value > 0 ? std::min(value, 1.0f) : 0) * float(last);
    const size_t low = std::min(size_t(at), last - 1);
    return stops[low] + (stops[low + 1] - stops[low]) * (at - float(low));
}

template <class Color>
Image colored(const Image& mask, Color color) {
    Image picture(mask.width, mask.height, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        const Vec3 c = mask.floats()[i] > 0 ? color(i) : kOutside;
        const float channels[3] = {c.x, c.y, c.z};
        for (size_t k = 0; k < 3; ++k)
            picture.values<uint8_t>()[3 * i + k] = uint8_t(std::lround(channels[k] * 255));
    }
    return picture;
}

}  // namespace

Vec3 heat_color(float value) {
    return between(kStops, value);
}

Image heat_map(const Image& values, double full, const Image& mask) {
    return colored(mask, [&](size_t i) { return heat_color(float(values.floats()[i] / full)); });
}

Vec3 signed_color(float value) {
    return value < 0 ? between(kBelow, -value) : between(kAbove, value);
}

Image signed_map(const Image& rgb, double full, const Image& mask) {
    return colored(mask, [&](size_t i) {
        const float* at = &rgb.floats()[3 * i];
        return signed_color(float((at[0] + at[1] + at[2]) / (3 * full)));
    });
}

}  // namespace dermis::inline judge
