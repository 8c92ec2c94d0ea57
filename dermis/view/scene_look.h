#pragma once
// What a person can change of a scene in the window, apart from what the scene is made of.

#include <map>
#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::view {

struct SceneLook {
    Camera camera;
    std::vector<Light> lights;
    Environment environment;
    Skin skin;
    ToneMap tone_map = ToneMap::hable;
    float exposure_ev = 0;
    std::string technique;  ///< with its settings: what the file asks for, not what is shown
    std::map<std::string, std::string> settings;
};

[[nodiscard]] SceneLook look_of(const Scene& scene);

/// A scene whose files were read again keeps what a person has changed since (`seen`), except where the file
/// now says something else than it did (`file_before`).
void keep_look(const SceneLook& file_before, const SceneLook& seen, Scene& fresh);

/// All of `seen`: for files that say nothing of it, such as meshes, whose new size moves the camera.
void put_look(const SceneLook& seen, Scene& fresh);

}  // namespace dermis::view
