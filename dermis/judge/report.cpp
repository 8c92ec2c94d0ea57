#include "dermis/judge/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "dermis/image/io.h"
#include "dermis/judge/heat_map.h"

namespace dermis {

extern const std::string_view kReportPage;

namespace {

using Json = nlohmann::ordered_json;

// The error maps' brightest colour stands for this share of the largest value, so that one wild pixel does
// not darken all others.
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

// One scale for all techniques, so that maps can be compared; two figures, so that people can read it.
double common_full(const Comparison& comparison, Image Compared::*map) {
    double full = 1e-6;
    for (const Compared& row : comparison.rows)
        full = std::max(full, quantile(row.*map, comparison.masks.skin, kFullQuantile));
    const double unit = std::pow(10.0, std::floor(std::log10(full)) - 1);
    return std::ceil(full / unit) * unit;
}

Result<void> add_image(Json& images, std::string_view group, const std::string& label,
                       Result<std::string> uri) {
    if (!uri) return uri.error();
    images.push_back({{"group", group}, {"label", label}, {"uri", std::move(*uri)}});
    return {};
}

Result<Json> images_of(const Scene& scene, const Comparison& comparison, double flip_full,
                       double distance_full) {
    Json images = Json::array();
    const ReferencePicture& truth = comparison.reference.picture;
    if (auto added = add_image(images, "picture", "ground truth", picture_uri(truth.radiance, scene)); !added)
        return added.error();
    for (const Compared& row : comparison.rows)
        if (auto added =
                add_image(images, "picture", row.contestant.name(), picture_uri(row.radiance, scene));
            !added)
            return added.error();
    for (const Compared& row : comparison.rows)
        if (auto added = add_image(images, "FLIP", row.contestant.name(),
                                   data_uri(heat_map(row.flip, flip_full, comparison.masks.skin)));
            !added)
            return added.error();
    for (const Compared& row : comparison.rows)
        if (auto added = add_image(images, "linear error", row.contestant.name(),
                                   data_uri(heat_map(row.distance, distance_full, comparison.masks.skin)));
            !added)
            return added.error();
    return images;
}

Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json rows_of(const Comparison& comparison) {
    Json rows = Json::array();
    for (const Compared& row : comparison.rows) {
        const Scores& s = row.scores;
        const auto part = [](const std::optional<double>& v) { return v ? json_number(*v) : Json(nullptr); };
        rows.push_back({{"technique", row.contestant.technique->id},
                        {"settings", row.contestant.settings},
                        {"summary", row.contestant.technique->summary},
                        {"rmse", json_number(s.rmse)},
                        {"rel_mse", json_number(s.rel_mse)},
                        {"psnr_db", json_number(s.psnr_db)},
                        {"ssim", json_number(s.ssim)},
                        {"delta_e_2000", json_number(s.delta_e_2000)},
                        {"flip", json_number(s.flip)},
                        {"terminator_rmse", part(s.terminator_rmse)},
                        {"penumbra_rmse", part(s.penumbra_rmse)},
                        {"time_ms", json_number(row.time_ms)},
                        {"time_ratio", row.time_ratio > 0 ? json_number(row.time_ratio) : Json(nullptr)},
                        {"bytes", row.bytes()}});
    }
    return rows;
}

std::string_view integrator_text(Integrator integrator) {
    if (integrator == Integrator::walk) return "random walks through the volume";
    if (integrator == Integrator::lambert) return "no transport: light leaves where it entered";
    return "surface integral of the diffusion profile";
}

size_t covered(const Image& mask) {
    return size_t(std::ranges::count_if(mask.floats(), [](float v) { return v > 0; }));
}

Json facts_of(const Scene& scene, const Comparison& comparison, const ComparisonSettings& settings) {
    const ReferenceSettings& reference = settings.reference;
    const bool traced = reference.lighting.ambient == AmbientModel::traced;
    return {{"width", settings.width},
            {"height", settings.height},
            {"profile", scene.skin.profile},
            {"integrator", integrator_text(reference.integrator)},
            {"ambient", traced ? "traced" : "as the renderer approximates it, on both sides"},
            {"passes", comparison.reference.picture.passes},
            {"probes", reference.probes},
            {"relative_error", comparison.reference.picture.relative_error},
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

Json heat_stops() {
    Json stops = Json::array();
    for (int i = 0; i <= 10; ++i) {
        const Vec3 c = heat_color(float(i) / 10) * 255;
        stops.push_back({std::lround(c.x), std::lround(c.y), std::lround(c.z)});
    }
    return stops;
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
    const double flip_full = common_full(comparison, &Compared::flip),
                 distance_full = common_full(comparison, &Compared::distance);
    Result<Json> images = images_of(scene, comparison, flip_full, distance_full);
    if (!images) return images.error();
    const Json data = {
        {"scene", scene.name},
        {"credit", scene.credit},
        {"warnings", scene.warnings},
        {"images", std::move(*images)},
        {"rows", rows_of(comparison)},
        {"facts", facts_of(scene, comparison, settings)},
        {"heat", {{"stops", heat_stops()}, {"flip", flip_full}, {"linear error", distance_full}}}};
    // No text of the data may end the script element or start another.
    std::string json = data.dump(-1, ' ', true, Json::error_handler_t::replace);
    replace_all(json, "<", "\\u003c");
    std::string page(kReportPage);
    replace_all(page, "/*DATA*/", json);
    return page;
}

}  // namespace dermis
