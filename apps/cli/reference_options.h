#pragma once
// The flags of `dermis reference` and the settings they give.

#include <string>

#include "command.h"
#include "dermis/reference/picture.h"
#include "scene_choice.h"

namespace dermis::cli {

struct ReferenceOptions {
    SceneChoice scene;
    std::string output, preview, size = "512x512", profile;
    std::string integrator = "surface", filter = "box", shadows = "scene", ambient = "traced",
                specular = "ggx";
    std::string normalisation = "area", cavities = "flesh", medium;
    int samples = 0, probes = 16;  // samples: 0 is 64, or as many as the noise takes
    uint32_t seed = 1;
    double noise = 0, width_scale = 1;
    float penumbra_mm = 2;
    bool json = false;

    void add_to(Command& command);
    [[nodiscard]] Result<ReferenceSettings> settings() const;
};

}  // namespace dermis::cli
