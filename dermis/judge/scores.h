#pragma once
// One picture of skin against the reference in numbers: the captured share and the raw errors, over all
// skin and where scattering shows.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/image/tone_map.h"
#include "dermis/judge/captured.h"

namespace dermis::inline judge {

/// The band along the terminator, and how wide the band around a cast shadow's edge is.
inline constexpr float kTerminatorCosine = 0.3f;
inline constexpr float kPenumbraBandMm = 6;

/// One channel each, 1 inside. Terminator and penumbra are disjoint parts of the skin.
struct SkinMasks {
    Image skin;        ///< seen by both renderers through nothing else
    Image terminator;  ///< |n.l| of the key light below kTerminatorCosine, shading normal
    Image penumbra;    ///< n.l above that, within kPenumbraBandMm / 2 of the edge of a shadow
};

/// Sources of the masks. `light`: uv, n.l and visibility through a filter kPenumbraBandMm wide (the
/// G-buffer's gbuffer_light); `drawn`: the share of the pixel where the renderer drew a surface, one channel;
/// `skin`: the reference's share of skin. Only pixels that are wholly skin in both count.
[[nodiscard]] SkinMasks make_masks(const Image& light, const Image& drawn, const Image& skin);

/// rmse and rel_mse on linear radiance; the rest on the tone-mapped picture. The parts are missing where a
/// scene has no such pixel. Units as metrics.h has them.
struct Scores {
    double rmse = 0, rel_mse = 0, psnr_db = 0, ssim = 0, delta_e_2000 = 0, flip = 0;
    std::optional<double> terminator_rmse, penumbra_rmse;
};

/// How radiance becomes the picture that people see.
struct Display {
    ToneMap tone_map = ToneMap::hable;
    float exposure = 1;
};

/// `radiance` with the reference's pixels wherever the mask is 0, so that filters see no difference there.
[[nodiscard]] Image masked_radiance(const Image& radiance, const Image& reference, const Image& mask);

/// Errors: as metrics.h (sizes, NaN, an empty skin mask).
[[nodiscard]] Result<Scores> score(const Image& radiance, const Image& reference, const SkinMasks& masks,
                                   const Display& display);

/// One row of scores.csv.
struct ScoreRow {
    std::string scene, technique, settings;
    /// Against each reference; missing where it was not made.
    std::optional<Captured> walk, surface;
    Scores scores;  ///< against `walk` where it was made, else against `surface`
    double time_ms = 0;
    size_t bytes = 0;
    double time_ratio = 0;      ///< frame time over the baseline's in the same rounds; 0: not known
    double reference_rmse = 0;  ///< noise of the reference that the raw errors are measured with
    /// A frame over the baseline's by the model of dermis/report; missing where it was not computed.
    std::optional<double> model_ratio;
    /// Of a row with bakes of the rest pose: from the row with bakes of the pose. Not in scores.csv.
    std::optional<ShareChange> walk_change = {}, surface_change = {};
    /// Of a frame of a clip: the share of the motion since the frame before (clip_motion.h). Of a clip: of
    /// all its frames.
    std::optional<Captured> walk_motion = {}, surface_motion = {};
};

/// The share that decides: against `walk` where it was made, else against `surface`.
[[nodiscard]] const Captured& headline(const ScoreRow& row);

/// A numeric column of scores.csv. A missing value is a share whose reference is too noisy or was not made, a
/// part that the scene has not, or a cost that was not modelled.
struct ScoreColumn {
    std::string_view name;
    std::optional<double> (*get)(const ScoreRow& row);
    void (*set)(ScoreRow& row, std::optional<double> value);
    bool may_be_missing = false;
};

/// In order: the share against walk: walk_captured, walk_captured_r, walk_captured_g, walk_captured_b,
/// walk_captured_error (half of the 95 % interval of walk_captured), walk_effect_rms, walk_reference_noise;
/// the share against surface: captured, captured_r ... reference_noise, the same seven without "walk_"; rmse,
/// rel_mse, psnr_db, ssim, delta_e_2000, flip, terminator_rmse, penumbra_rmse, time_ms, bytes, time_ratio,
/// reference_rmse, model_ratio; the shares of the motion and half of their 95 % intervals: walk_motion,
/// walk_motion_error, motion, motion_error.
[[nodiscard]] std::span<const ScoreColumn> score_columns();
/// The columns of one share, those of walk first, at the beginning of score_columns().
inline constexpr size_t kShareColumns = 7;

/// scene,technique,settings and score_columns(); fields with commas are quoted, a missing value is empty.
[[nodiscard]] std::string scores_csv(const std::vector<ScoreRow>& rows);

/// The inverse. A heading may lack columns that may be missing, as files of before a column was added do.
/// Errors name line and column: another heading, too few columns, no number.
[[nodiscard]] Result<std::vector<ScoreRow>> parse_scores(std::string_view text);

}  // namespace dermis::inline judge
