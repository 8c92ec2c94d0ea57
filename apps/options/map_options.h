#pragma once
// The options of `dermis bake curvature` and the other maps of a mesh.

#include <string>

#include "command.h"
#include "dermis/rays/bake_map.h"
#include "map_layout.h"
#include "pose_choice.h"

namespace dermis::cli {

inline constexpr NumberRange kMapSizeRange = {16, 8192}, kMapGutterRange = {0, 256};

struct MapRequest {
    Scene scene;
    BakeMapSettings settings;
    LayoutOfMap layout;
};

struct MapChoice {
    std::string mesh, profile, material;  ///< empty profile: the scene's; empty material: all skin
    std::string uvs;                      ///< as lay_out_map() takes it
    float unit_mm = 0;                    ///< of a mesh file; 0: as its format has it
    PoseChoice pose;
    BakeMapSettings settings;

    /// The scene that `mesh` names, and the settings with their profile.
    [[nodiscard]] Result<MapRequest> request() const;
    /// The layout of the map; with a material the UVs of the file.
    [[nodiscard]] Result<LayoutOfMap> lay_out(Scene& scene) const;
    /// The settings for a scene that is there already.
    [[nodiscard]] Result<BakeMapSettings> settings_for(const std::string& scene_profile) const;
};

[[nodiscard]] BakeMapSettings usual_map_settings(MapKind kind);

}  // namespace dermis::cli
