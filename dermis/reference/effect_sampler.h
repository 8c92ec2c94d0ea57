#pragma once
// The effect of scattering alone: of each sample the radiance with scattering less that without, which have
// the path from the eye and the light's random numbers in common. Each pixel takes as many samples as it is
// told, in two independent halves of equal size.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/reference/picture.h"

namespace dermis::inline reference {

class PixelSampler;

/// The samples so far.
struct EffectSamples {
    EffectSamples(int width, int height)
        : a(width, height, 3), b(width, height, 3), counts(a.pixel_count(), 0) {}

    Image a, b;                    ///< means of the halves, RGB, linear; 0 where there are no samples
    std::vector<uint32_t> counts;  ///< of a half, at each pixel
    uint64_t walks = 0, lost_walks = 0, cut_channels = 0;
};

/// Safe from any thread.
class EffectSampler {
  public:
    /// Reads all settings but `samples` and `noise`. The scene must outlive it. Errors: as render_reference.
    [[nodiscard]] static Result<EffectSampler> create(const Scene& scene, const ReferenceSettings& settings);
    ~EffectSampler();
    EffectSampler(EffectSampler&&) noexcept;
    EffectSampler& operator=(EffectSampler&&) = delete;

    /// The share of each pixel that is skin, seen through nothing: over the middles of all its cells.
    [[nodiscard]] Image skin() const;

    /// Adds samples until a pixel's half has as many as `counts` says; one that has more keeps them. Sample i
    /// of a pixel is the same however they are added. False when stopped: rows in work are complete.
    /// `progress` is called on this thread.
    [[nodiscard]] bool raise(std::span<const uint32_t> counts, EffectSamples& samples,
                             const ReferenceProgress& progress = {},
                             const std::atomic<bool>* stop = nullptr) const;

  private:
    EffectSampler(std::unique_ptr<PixelSampler> sampler, const ReferenceSettings& settings);

    std::unique_ptr<PixelSampler> sampler_;
    ReferenceSettings settings_;
};

}  // namespace dermis::inline reference
