#pragma once
// Techniques held against the ground truth of the same scene: pictures, errors, times, bytes.
//
// All show the same: skin's diffuse transport, direct lights with the key light's shadow, specular reflection
// by GGX, the environment as the renderer approximates it (order-2 harmonics, split sum, occlusion). The
// ground truth takes these over as they are, so that what differs is the transport within the skin; with
// AmbientModel::traced the environment is traced instead, and its approximation counts as error of every
// technique. Pixels that are not skin do not count. Pixels are sampled in their middle on both sides; maps
// are read at the same level of detail.

#include <functional>
#include <string>
#include <vector>

#include "dermis/gpu/device.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/judge/scores.h"
#include "dermis/judge/technique_list.h"

namespace dermis {

struct ComparisonSettings {
    int width = 512, height = 512;
    /// The picture is made with this shadow map, so that a technique is not charged for the coarser one's
    /// bias; frames are timed with the renderer's own.
    int shadow_map_size = 4096;
    int frames = 5;  ///< timed ones, after one that compiles; 0: none are
    ReferenceSettings reference;
};

/// Reference settings that show what the renderer shows, at the comparison's size.
[[nodiscard]] ComparisonSettings comparison_settings(int width, int height);

struct Compared {
    Contestant contestant;
    Image radiance;  ///< linear, RGBA; beyond the skin as drawn
    Image flip,
        distance;  ///< one channel: FLIP of the tone-mapped pictures, largest difference of linear channels
    Scores scores;
    double time_ms = 0;      ///< median of whole frames
    double time_ratio = 0;   ///< median over frames of time / lambert's in the same round; 0 without lambert
    size_t table_bytes = 0;  ///< tables baked for it
    size_t image_bytes = 0;  ///< images that only its own passes use
    [[nodiscard]] size_t bytes() const { return table_bytes + image_bytes; }
};

struct Comparison {
    CachedReference reference;
    SkinMasks masks;
    double reference_rmse = 0;  ///< standard error of the ground truth over the skin: no rmse is known better
    std::vector<Compared> rows;
    std::string device;
};

struct ComparisonHooks {
    ReferenceProgress reference;
    std::function<void(const std::string& name)> technique;  ///< before each is drawn
    const std::atomic<bool>* stop = nullptr;
};

/// The scene must be complete (complete_scene). Errors: whatever render_reference and Renderer say, no skin
/// in sight.
[[nodiscard]] Result<Comparison> compare_techniques(gpu::Device& device, const Scene& scene,
                                                    const std::vector<Contestant>& contestants,
                                                    const ComparisonSettings& settings,
                                                    const ComparisonHooks& hooks = {});

[[nodiscard]] std::vector<ScoreRow> score_rows(const std::string& scene, const Comparison& comparison);

}  // namespace dermis
