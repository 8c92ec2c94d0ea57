#pragma once
// The flags of `dermis reference` and the settings they give.

#include <optional>
#include <string>

#include "command.h"
#include "dermis/jobs/picture_file.h"
#include "dermis/reference/picture_sums.h"
#include "scene_choice.h"

namespace dermis::cli {

struct ReferenceOptions {
    SceneChoice scene;
    std::string output, preview, size = "512x512", profile, sample_range;
    std::string integrator = "surface", filter = "box", shadows = "scene", ambient = "traced",
                specular = "ggx";
    std::string normalisation = "area", cavities = "flesh", medium;
    int samples = 0, probes = 0;  // 0: 64 samples or as many as the noise takes; 3 probes or 16 walks
    uint32_t seed = 1;
    double noise = 0, width_scale = 1;
    float penumbra_mm = 2;
    bool json = false;

    void add_to(Command& command);
    /// Picture and preview.
    [[nodiscard]] Result<FileUse> files() const;
    [[nodiscard]] Result<ReferenceSettings> settings() const;
    /// Of --sample-range; nothing when it is absent.
    [[nodiscard]] Result<std::optional<SampleRange>> range(const ReferenceSettings& settings) const;
    /// What pictures and parts state of the scene and these options.
    [[nodiscard]] PictureFacts facts(const ReferenceSettings& settings, const Scene& loaded) const;
    /// The scene, ready to be rendered.
    [[nodiscard]] Result<Scene> load_scene() const;
};

/// The hash of all that the picture depends on but the number of its samples.
[[nodiscard]] Result<std::string> content_hash(const Scene& scene, ReferenceSettings settings);

}  // namespace dermis::cli
