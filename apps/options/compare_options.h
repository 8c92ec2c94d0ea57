#pragma once
// The flags of `dermis compare` that say what is compared and how.

#include <string>
#include <vector>

#include "dermis/judge/comparison.h"
#include "scene_choice.h"

namespace dermis::cli {

inline constexpr NumberRange kReferenceNoiseRange = {1e-6, 1}, kTimedFramesRange = {1, 1000},
                             kClipFramesRange = {1, 1000}, kReferenceSamplesRange = {4, 1 << 20};

struct CompareChoice {
    SceneChoice scene;
    /// Empty: every technique; the size of the pictures, 512x512, or 96x96 of each of a set.
    std::string techniques, size, device;
    std::vector<std::string> pictures;  ///< parse_own_picture()
    std::string rest_bakes;             ///< lists of parse_rest_bakes(), separated by commas
    int frames = 0;                     ///< of the scene's --clip; 0: one pose
    double fps = 0;                     ///< of these frames; 0: they divide the clip
    /// "both": walk decides, surface judges too.
    std::string integrator = "both", ambient = "renderer";
    ComparisonSettings defaults;
    double noise = defaults.noise;
    int samples = defaults.samples, timed_frames = defaults.frames;
    int samples_per_pixel = 0;  ///< a square; 0: by the size, grid_of_size()

    /// Reads the pictures.
    [[nodiscard]] Result<ComparisonSettings> settings() const;
    [[nodiscard]] Result<std::vector<Contestant>> contestants() const;
    /// A complete scene, with its rest pose where rows for rest_bakes need it.
    [[nodiscard]] Result<Scene> load_scene() const;
};

/// What limits the numbers of a comparison, a line each.
[[nodiscard]] std::vector<std::string> warnings_of(const Comparison& comparison,
                                                   const ComparisonSettings& settings);

}  // namespace dermis::cli
