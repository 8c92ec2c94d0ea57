#include "dermis/view/quality.h"

#include <cmath>
#include <iterator>

namespace dermis::view {
namespace {

// Few steps, so that images are not made again for every variation of the measured time.
constexpr float kScales[] = {1, 0.75f, 0.5f, 0.375f, 0.25f};

}  // namespace

Quality QualityLadder::moving(double megapixels, const QualityLimits& limits) const {
    const double whole_ms = ms_per_megapixel_ * megapixels;
    if (whole_ms <= limits.always_fine_ms) return {.samples = limits.samples};
    for (const float scale : kScales)
        if (whole_ms * scale * scale <= limits.moving_ms) return {.scale = scale};
    return {.scale = kScales[std::size(kScales) - 1]};
}

std::optional<Quality> QualityLadder::due(bool changed, double still_s, double megapixels,
                                          const QualityLimits& limits) const {
    if (changed || !last_) return moving(megapixels, limits);
    if (is_final(limits)) return {};
    if (last_->scale < 1) return Quality{};
    if (still_s < limits.still_s) return {};
    return Quality{.samples = limits.samples};
}

void QualityLadder::measured(Quality quality, double megapixels, double time_ms) {
    const double drawn_megapixels = megapixels * quality.scale * quality.scale;
    if (quality.samples > 1 || drawn_megapixels <= 0) return;
    const double measured = time_ms / drawn_megapixels;
    // Half of each new time, since the first drawing of a pipeline also compiles it.
    ms_per_megapixel_ = std::lerp(ms_per_megapixel_, measured, 0.5);
}

bool QualityLadder::is_final(const QualityLimits& limits) const {
    return last_ && last_->scale == 1 && last_->samples >= limits.samples;
}

}  // namespace dermis::view
