#pragma once
// Techniques compared with the reference of the same scene: captured share, pictures, errors, times,
// bytes.
//
// Two references can judge: random walks through the volume (what light does) and the surface integral of the
// profile (what most techniques approximate). Both start from the same picture without scattering. `surface`
// judges pictures with gain=none: the profile has no gain (technique/gain.h).
//
// Both sides share lights, shadows, GGX reflection and the renderer's approximation of the environment
// (order-2 harmonics, split sum, occlusion), so only the transport in the skin differs. With
// AmbientModel::traced the approximation counts as an error of every technique. Only pixels that are wholly
// skin count. Both sides average the same points of a pixel and read maps at the same level of detail.

#include <functional>
#include <string>
#include <vector>

#include "dermis/gpu/device.h"
#include "dermis/judge/effect_reference.h"
#include "dermis/judge/own_picture.h"
#include "dermis/judge/regions.h"
#include "dermis/judge/scores.h"
#include "dermis/judge/technique_cost.h"
#include "dermis/render/catalog.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/subject.h"
#include "dermis/technique/technique_list.h"

namespace dermis::inline judge {

struct ComparisonSettings {
    int width = 512, height = 512;
    /// The picture is made with this shadow map, so that a technique is not charged for the coarser one's
    /// bias; frames are timed with the renderer's own.
    int shadow_map_size = 4096;
    int grid = 6;         ///< both sides take grid x grid points of a pixel; grid_of_size()
    double noise = 0.25;  ///< of the effect's RMS at which the reference is fine enough
    int samples = 2048;   ///< of the reference a pixel, at most
    int probes = 12;      ///< a sample of `surface`
    int walks = 16;       ///< a sample of `walk`
    int frames = 5;       ///< timed ones, after one that compiles; 0: none are
    /// Integrator, lighting and seed of the reference. Its size is the comparison's. The defaults are
    /// for a reference that is compared with one frame without multisampling.
    ReferenceSettings reference;
    /// Another integrator that judges too, with all else as in `reference`.
    std::optional<Integrator> second;
    /// If set, the exact answer is a row after the techniques, which checks the reference.
    ExactExitance exact;
    /// Rows after the techniques; their cost is not known.
    std::vector<OwnPicture> pictures;
    /// For each, a row of every technique whose picture it changes, beside the one with all bakes made for
    /// the pose; the scene must have its rest_objects. The baseline and the reference stay.
    std::vector<RestBakes> rest_bakes;
};

/// The row's id.
inline constexpr std::string_view kExactId = "exact";

/// Side of the grid of points in a pixel, 2 to 6: about 768 points over the longer side of the picture. More
/// of them in a large picture would only make the first shares late.
[[nodiscard]] int grid_of_size(int width, int height);

/// The noise of one pixel at which shares of a picture of this size have the intervals that 0.2 gives them at
/// 128 x 128: a share's interval depends on all pixels together. 0.2 where the picture is smaller.
[[nodiscard]] double noise_of_size(int width, int height);

/// Reference settings that show what the renderer shows, at the comparison's size.
[[nodiscard]] ComparisonSettings comparison_settings(int width, int height);

/// What one reference says of a technique.
struct Judgement {
    Captured captured;
    std::vector<RegionShare> regions;  ///< in the order of kRegions
    /// Of a row with bakes of the rest pose, from that with bakes of the pose.
    std::optional<ShareChange> change;
};

struct Compared {
    Contestant contestant;              ///< with bakes of the rest pose, its settings end in "rest=normals"
    std::optional<size_t> remade = {};  ///< then: the row with all bakes of the pose
    Image radiance;                     ///< linear, RGBA; beyond the skin as drawn
    Image effect;                       ///< RGB: radiance less the baseline's
    /// With gain=none, where the technique has a gain and the second reference is `surface`.
    std::optional<Image> second_effect;
    Image flip,
        distance;  ///< one channel: FLIP of the tone-mapped pictures, largest difference of linear channels
    Judgement first;                  ///< by the integrator of ComparisonSettings::reference
    std::optional<Judgement> second;  ///< by ComparisonSettings::second
    Scores scores;                    ///< against the first
    TechniqueCost cost;

    /// The effect that the second integrator judges.
    [[nodiscard]] const Image& effect_of_second() const { return second_effect ? *second_effect : effect; }
};

struct Comparison {
    Integrator integrator = Integrator::surface;  ///< of `reference`
    EffectReference reference;
    std::optional<Integrator> second_integrator;
    std::optional<EffectReference> second;
    Image reference_radiance;  ///< mean of its halves
    SkinMasks masks;
    RegionMasks regions;
    double reference_rmse = 0;  ///< standard error of the reference over the skin: no rmse is known better
    std::vector<Compared> rows;
    /// What a technique left out or could not read, and pictures whose light or camera is not the scene's.
    std::vector<std::string> warnings;
    std::string device;
};

/// First come the samples of the first reference, the techniques' pictures and their first shares, then the
/// same of the second, then timed frames and the rest of the references, the noisier one first.
struct ComparisonHooks {
    /// The share of all the work that is done, by estimated time, and what is in work. Never falls.
    std::function<void(double done, const std::string& name)> progress;
    /// Once the techniques are drawn, and after each step of a reference: the share of each row so far.
    std::function<void(Integrator, const std::vector<Compared>& rows, const std::vector<CapturedShare>&)>
        shares;
    /// Ends references and timed frames early; what there is is judged. Set before the first reference has
    /// samples: an error; before the second has: without the second.
    const std::atomic<bool>* stop = nullptr;
    /// Ends everything with an error.
    const std::atomic<bool>* cancel = nullptr;
};

/// The scene must be complete (complete_scene). `lambert` is the technique without scattering, which every
/// effect is measured from. Errors: whatever make_effect_reference and Renderer say, no skin in sight.
[[nodiscard]] Result<Comparison> compare_techniques(gpu::Device& device, const Catalog& catalog,
                                                    const Scene& scene,
                                                    const std::vector<Contestant>& contestants,
                                                    const ComparisonSettings& settings,
                                                    const ComparisonHooks& hooks = {});
/// The same with a renderer of the scene, for several poses of it (render/move_scene.h). Its warnings so far
/// are among those of the comparison.
[[nodiscard]] Result<Comparison> compare_techniques(gpu::Device& device, Renderer& renderer,
                                                    const Catalog& catalog, const Scene& scene,
                                                    const std::vector<Contestant>& contestants,
                                                    const ComparisonSettings& settings,
                                                    const ComparisonHooks& hooks = {});

/// The judgement by `integrator`; null if that reference was not made.
[[nodiscard]] const Judgement* judgement_by(Integrator integrator, const Comparison& comparison,
                                            const Compared& row);

/// The effect that `integrator` judges; null if that reference was not made.
[[nodiscard]] const Image* judged_effect(Integrator integrator, const Comparison& comparison,
                                         const Compared& row);

/// "walk", "surface".
[[nodiscard]] std::string_view judge_name(Integrator integrator);

[[nodiscard]] std::vector<ScoreRow> score_rows(const std::string& scene, const Comparison& comparison);

/// scene,technique,settings,region,pixels and score_columns() up to reference_noise: a row for every
/// technique and region that the scene has; a share whose reference is too noisy or was not made is empty.
[[nodiscard]] std::string regions_csv(const std::string& scene, const Comparison& comparison);

}  // namespace dermis::inline judge
