#pragma once
// The reference of a scene and of the same scene without scattering, in two independent halves, made until
// its noise is small beside the effect. Kept in the disk cache and refined there.

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dermis/image/image.h"
#include "dermis/judge/captured.h"
#include "dermis/reference/picture.h"
#include "dermis/scene/subject.h"

namespace dermis::inline judge {

struct EffectReferenceSettings {
    /// Its size, grid, integrator, lighting, probes and seed; `samples`, `noise` and `filter` are not read.
    ReferenceSettings reference;
    double noise = 0.2;  ///< of the effect's RMS at which the reference is fine enough; above 0
    int samples = 2048;  ///< a pixel at most, of both halves together, in the mean of the skin; 2 or more
};

struct EffectReference {
    EffectHalves effect;
    std::array<Image, 2> halves;  ///< linear radiance, RGBA, of the skin as it is; alpha is coverage
    Image skin;                   ///< the share of the pixel that is skin; 0 beside a cut (cuts.h)
    int samples = 0;              ///< a pixel, of both halves together, in the mean of the skin
    EffectNoise noise;            ///< over whole pixels of skin
    bool reached = false;         ///< the noise that was asked for
    bool from_cache = false;      ///< nothing had to be made
    bool stopped = false;         ///< by the caller, before that noise
    double time_ms = 0;           ///< of everything that was ever made for it
    std::vector<std::string> warnings;

    /// The mean of both halves.
    [[nodiscard]] Image radiance() const;
};

struct EffectReferenceHooks {
    /// How much is done, 0 to 1: of the first samples, whose noise says how many are needed, and then of all.
    /// The second never falls by more than the estimate of all grows.
    std::function<void(double done, bool first_samples)> done;
    const std::atomic<bool>* stop = nullptr;
};

/// A reference that is refined step by step, so that others and their shares can come between. Reuses a finer
/// cached state and continues a coarser one; what it has is cached after every step.
///
/// The first samples are equally many in every pixel. From their spread at the pixels around it, never at
/// the pixel itself, a pixel gets its part of all later samples: more where the effect is noisy. A pixel's
/// samples are so independent of their number, and its mean has no bias.
class EffectReferenceMaker {
  public:
    /// With the first samples at least. The scene must outlive it. Errors: as render_reference; stopped
    /// before the first samples; no skin in sight.
    [[nodiscard]] static Result<EffectReferenceMaker> begin(const Scene& scene,
                                                            const EffectReferenceSettings& settings,
                                                            const EffectReferenceHooks& hooks = {});
    ~EffectReferenceMaker();
    EffectReferenceMaker(EffectReferenceMaker&&) noexcept;
    EffectReferenceMaker& operator=(EffectReferenceMaker&&) = delete;

    /// Fine enough, at the limit of samples, or stopped.
    [[nodiscard]] bool is_done() const;
    /// Half as many samples again as it has, or as many as it lacks.
    [[nodiscard]] Result<void> refine(const EffectReferenceHooks& hooks = {});
    /// Makes the pictures without scattering, which finish() adds the effect to. finish() calls it too; this
    /// call can show progress and be stopped.
    [[nodiscard]] Result<void> make_unscattered(const ReferenceProgress& progress,
                                                const std::atomic<bool>* stop);
    /// The halves are empty.
    [[nodiscard]] const EffectReference& so_far() const;
    /// Noise over the noise that was asked for.
    [[nodiscard]] double noise_over_wanted() const;
    /// The estimated time to the end.
    [[nodiscard]] double left_ms() const;
    /// With the halves. Before it is done it counts as stopped.
    [[nodiscard]] Result<EffectReference> finish();

  private:
    struct Work;
    explicit EffectReferenceMaker(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

/// All steps of it. Errors: as EffectReferenceMaker.
[[nodiscard]] Result<EffectReference> make_effect_reference(const Scene& scene,
                                                            const EffectReferenceSettings& settings,
                                                            const EffectReferenceHooks& hooks = {});

// The effect of scattering as a picture where a subject knows it exactly: what reference and techniques are
// both held against.

/// RGB, the effect of the key light alone: other lights must not be there. Averaged over the same grid x grid
/// points of a pixel as reference and techniques; 0 where no skin is seen. Errors: maps, profile, the ray
/// library.
[[nodiscard]] Result<Image> exact_effect(const Scene& scene, const ExactExitance& exact, int width,
                                         int height, int grid, float penumbra_mm);

}  // namespace dermis::inline judge
