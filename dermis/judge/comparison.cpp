#include "dermis/judge/comparison.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/metrics.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/render/renderer.h"

namespace dermis {
namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Of all mips; images without a size of their own have the frame's.
size_t image_bytes(const ImageDeclaration& image, int width, int height) {
    const bool own = image.size.width > 0;
    const auto side = [&](int fixed, int frame) {
        return size_t(std::max(own ? fixed : int(std::lround(float(frame) * image.size.frame_scale)), 1));
    };
    size_t w = side(image.size.width, width), h = side(image.size.height, height), texels = 0;
    for (int mip = 0; image.mips == 0 || mip < image.mips; ++mip) {
        texels += w * h;
        if (w == 1 && h == 1) break;
        w = std::max<size_t>(w / 2, 1);
        h = std::max<size_t>(h / 2, 1);
    }
    return texels * bytes_per_texel(image.format) * size_t(image.samples);
}

Result<void> measure_bytes(const Scene& scene, const ComparisonSettings& settings, Compared& row) {
    const Technique& technique = *row.contestant.technique;
    const PassList list = technique.build(row.contestant.values, {});
    for (const ImageDeclaration& image : list.images)
        row.image_bytes += image_bytes(image, settings.width, settings.height);
    if (!technique.tables) return {};
    const Result<Profile> profile = find_profile(scene.skin.profile);
    if (!profile) return profile.error();
    const auto tables = technique.tables(row.contestant.values, {.profile = *profile,
                                                                 .gaussians = to_gaussian_sum(*profile).sum,
                                                                 .diffuse_table = scene.skin.diffuse_table});
    if (!tables) return tables.error();
    for (const TableImage& table : *tables) row.table_bytes += table.bytes.size();
    return {};
}

// Rounds over all techniques, so that a machine that is busy for a while is so for all of them.
Result<void> measure_times(Renderer& renderer, const ComparisonSettings& settings,
                           std::vector<Compared>& rows) {
    if (settings.frames == 0) return {};
    const DrawSettings draw{.width = settings.width, .height = settings.height};
    std::vector<std::vector<double>> times(rows.size());
    for (int frame = 0; frame <= settings.frames; ++frame)
        for (size_t i = 0; i < rows.size(); ++i) {
            const Contestant& contestant = rows[i].contestant;
            const auto drawn = renderer.draw(*contestant.technique, contestant.values, draw);
            if (!drawn) return Error{contestant.name() + ": " + drawn.error().message};
            if (frame > 0) times[i].push_back(drawn->frame_ms);
        }
    const auto lambert = std::ranges::find_if(
        rows, [](const Compared& row) { return row.contestant.technique->id == "lambert"; });
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].time_ms = median(times[i]);
        if (lambert == rows.end()) continue;
        std::vector<double> ratios;
        const std::vector<double>& base = times[size_t(lambert - rows.begin())];
        for (size_t frame = 0; frame < base.size(); ++frame) ratios.push_back(times[i][frame] / base[frame]);
        rows[i].time_ratio = median(ratios);
    }
    return {};
}

Result<Image> draw_radiance(Renderer& renderer, const Contestant& contestant,
                            const ComparisonSettings& settings) {
    const DrawSettings draw{.width = settings.width,
                            .height = settings.height,
                            .deep = true,
                            .shadow_map_size = settings.shadow_map_size,
                            .penumbra_mm = settings.reference.lighting.penumbra_mm};
    const auto drawn = renderer.draw(*contestant.technique, contestant.values, draw);
    if (!drawn) return Error{contestant.name() + ": " + drawn.error().message};
    Result<Image> radiance = renderer.radiance();
    if (!radiance) return radiance.error();
    return to_linear_float(*radiance);
}

Result<SkinMasks> draw_masks(Renderer& renderer, const Contestant& contestant,
                             const ComparisonSettings& settings, const Image& skin) {
    const DrawSettings draw{.width = settings.width,
                            .height = settings.height,
                            .gbuffer = true,
                            .shadow_map_size = settings.shadow_map_size,
                            .penumbra_mm = kPenumbraBandMm};
    if (const auto drawn = renderer.draw(*contestant.technique, contestant.values, draw); !drawn)
        return drawn.error();
    const Result<Image> light = renderer.read("gbuffer_light"), position = renderer.read("gbuffer_position");
    if (!light) return light.error();
    if (!position) return position.error();
    SkinMasks masks = make_masks(*light, *position, skin);
    if (std::ranges::none_of(masks.skin.floats(), [](float v) { return v > 0; }))
        return Error{"no pixel shows skin: nothing to compare (see the scene's materials and camera)"};
    return masks;
}

Result<void> judge(const Comparison& comparison, const Scene& scene, Compared& row) {
    const Image& truth = comparison.reference.picture.radiance;
    const Display display{scene.tone_map, std::exp2(scene.exposure_ev)};
    const Result<Scores> scores = score(row.radiance, truth, comparison.masks, display);
    if (!scores) return Error{row.contestant.name() + ": " + scores.error().message};
    row.scores = *scores;
    const Image light = masked_radiance(row.radiance, truth, comparison.masks.skin);
    Result<Image> flip = flip_map(tone_mapped(light, display.tone_map, display.exposure),
                                  tone_mapped(truth, display.tone_map, display.exposure));
    if (!flip) return flip.error();
    Result<Image> distance = abs_difference_map(light, truth);
    if (!distance) return distance.error();
    row.flip = std::move(*flip);
    row.distance = std::move(*distance);
    return {};
}

// The variances are those of the means, so their mean is the square of the error that noise alone makes.
double noise_rmse(const Image& variance, const Image& mask) {
    double sum = 0, count = 0;
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.floats()[i] <= 0) continue;
        for (size_t c = 0; c < 3; ++c) sum += variance.floats()[3 * i + c];
        count += 3;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace

ComparisonSettings comparison_settings(int width, int height) {
    ComparisonSettings settings{.width = width, .height = height};
    settings.reference = {
        .width = width, .height = height, .samples = 256, .noise = 0.01, .filter = PixelFilter::center};
    settings.reference.lighting = {.ambient = AmbientModel::renderer,
                                   .specular = SpecularReflection::ggx,
                                   .penumbra_mm = DrawSettings{}.penumbra_mm};
    return settings;
}

Result<Comparison> compare_techniques(gpu::Device& device, const Scene& scene,
                                      const std::vector<Contestant>& contestants,
                                      const ComparisonSettings& settings, const ComparisonHooks& hooks) {
    if (contestants.empty()) return Error{"no technique to compare"};
    Result<Renderer> renderer = Renderer::create(device, gpu::embedded_shaders(), scene);
    if (!renderer) return renderer.error();
    Comparison comparison{.device = device.info().name};
    // First, as it knows best what it cannot do.
    Result<CachedReference> reference =
        cached_reference(scene, settings.reference, hooks.reference, hooks.stop);
    if (!reference) return reference.error();
    comparison.reference = std::move(*reference);
    for (const Contestant& contestant : contestants) {
        if (hooks.technique) hooks.technique(contestant.name());
        Compared row{.contestant = contestant};
        Result<Image> radiance = draw_radiance(*renderer, contestant, settings);
        if (!radiance) return radiance.error();
        row.radiance = std::move(*radiance);
        if (Result<void> measured = measure_bytes(scene, settings, row); !measured) return measured.error();
        comparison.rows.push_back(std::move(row));
    }
    if (Result<void> measured = measure_times(*renderer, settings, comparison.rows); !measured)
        return measured.error();
    Result<SkinMasks> masks =
        draw_masks(*renderer, contestants.front(), settings, comparison.reference.picture.skin);
    if (!masks) return masks.error();
    comparison.masks = std::move(*masks);
    comparison.reference_rmse = noise_rmse(comparison.reference.picture.variance, comparison.masks.skin);
    for (Compared& row : comparison.rows)
        if (Result<void> judged = judge(comparison, scene, row); !judged) return judged.error();
    return comparison;
}

std::vector<ScoreRow> score_rows(const std::string& scene, const Comparison& comparison) {
    std::vector<ScoreRow> rows;
    for (const Compared& row : comparison.rows)
        rows.push_back({.scene = scene,
                        .technique = row.contestant.technique->id,
                        .settings = row.contestant.settings,
                        .scores = row.scores,
                        .time_ms = row.time_ms,
                        .bytes = row.bytes()});
    return rows;
}

}  // namespace dermis
