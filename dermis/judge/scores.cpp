#include "dermis/judge/scores.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/metrics.h"

namespace dermis::inline judge {
namespace {

// The mean of a pixel's points that are all skin may round below 1, as that of 12 x 12 does.
constexpr float kWhole = 1 - 1e-5f;

bool covers_anything(const Image& mask) {
    return std::ranges::any_of(mask.floats(), [](float v) { return v > 0; });
}

Result<std::optional<double>> rmse_over(const Image& radiance, const Image& reference, const Image& mask) {
    if (!covers_anything(mask)) return std::optional<double>();
    DERMIS_TRY_ASSIGN(const double value, rmse(radiance, reference, mask));
    return std::optional<double>(value);
}

}  // namespace

SkinMasks make_masks(const Image& light, const Image& drawn, const Image& skin) {
    SkinMasks masks{Image(skin.width, skin.height, 1), Image(skin.width, skin.height, 1),
                    Image(skin.width, skin.height, 1)};
    for (size_t i = 0; i < skin.pixel_count(); ++i) {
        if (drawn.floats()[i] < kWhole || skin.floats()[i] < kWhole) continue;
        masks.skin.floats()[i] = 1;
        const float n_dot_l = light.floats()[4 * i + 2], visibility = light.floats()[4 * i + 3];
        if (std::abs(n_dot_l) < kTerminatorCosine) masks.terminator.floats()[i] = 1;
        if (n_dot_l >= kTerminatorCosine && visibility > 0 && visibility < 1) masks.penumbra.floats()[i] = 1;
    }
    return masks;
}

Image masked_radiance(const Image& radiance, const Image& reference, const Image& mask) {
    Image result = to_linear_float(reference);
    const Image from = to_linear_float(radiance);
    for (size_t i = 0; i < mask.pixel_count(); ++i)
        if (mask.floats()[i] > 0)
            std::copy_n(&from.floats()[size_t(from.channels) * i], 3,
                        &result.floats()[size_t(result.channels) * i]);
    return result;
}

const Captured& headline(const ScoreRow& row) {
    static const Captured kNone;
    return row.walk ? *row.walk : row.surface ? *row.surface : kNone;
}

Result<Scores> score(const Image& radiance, const Image& reference, const SkinMasks& masks,
                     const Display& display) {
    if (radiance.width != reference.width || radiance.height != reference.height)
        return Error{"a picture of " + std::to_string(radiance.width) + "x" +
                     std::to_string(radiance.height) + " cannot be compared with one of " +
                     std::to_string(reference.width) + "x" + std::to_string(reference.height)};
    const Image light = masked_radiance(radiance, reference, masks.skin);
    const Image shown = tone_mapped(light, display.tone_map, display.exposure);
    const Image shown_reference = tone_mapped(reference, display.tone_map, display.exposure);
    Scores scores;
    const auto keep = [](double& target, const Result<double>& value) -> Result<void> {
        if (!value) return value.error();
        target = *value;
        return {};
    };
    for (const Result<void>& step :
         {keep(scores.rmse, rmse(light, reference, masks.skin)),
          keep(scores.rel_mse, rel_mse(light, reference, masks.skin)),
          keep(scores.psnr_db, psnr_db(shown, shown_reference, masks.skin)),
          keep(scores.ssim, ssim(shown, shown_reference, masks.skin)),
          keep(scores.delta_e_2000, mean_ciede2000(shown, shown_reference, masks.skin)),
          keep(scores.flip, mean_flip(shown, shown_reference, masks.skin))})
        if (!step) return step.error();
    DERMIS_TRY_ASSIGN(const std::optional<double> terminator, rmse_over(light, reference, masks.terminator));
    DERMIS_TRY_ASSIGN(const std::optional<double> penumbra, rmse_over(light, reference, masks.penumbra));
    scores.terminator_rmse = terminator;
    scores.penumbra_rmse = penumbra;
    return scores;
}

}  // namespace dermis::inline judge
