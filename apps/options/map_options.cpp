#include "map_options.h"

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/load_scene.h"

namespace dermis::cli {

BakeMapSettings usual_map_settings(MapKind kind) {
    BakeMapSettings settings{.kind = kind};
    if (kind == MapKind::occlusion) settings.max_mm = 0;
    if (kind == MapKind::curvature) settings.smoothing_mm = kCurvatureSmoothingMm;
    return settings;
}

Result<BakeMapSettings> MapChoice::settings_for(const std::string& scene_profile) const {
    BakeMapSettings chosen = settings;
    for (const Result<void>& in_range : {check_number("--size", chosen.size, kMapSizeRange),
                                         check_number("--gutter", chosen.gutter_texels, kMapGutterRange)})
        if (!in_range) return in_range.error();
    if (!material.empty()) chosen.material = material;
    if (chosen.kind == MapKind::kernel_size || chosen.kind == MapKind::gain) {
        DERMIS_TRY_ASSIGN(Profile found, find_profile(profile.empty() ? scene_profile : profile));
        chosen.profile = std::move(found);
    }
    return chosen;
}

Result<LayoutOfMap> MapChoice::lay_out(Scene& scene) const {
    return lay_out_map(scene, uvs.empty() && !material.empty() ? "file" : uvs);
}

Result<MapRequest> MapChoice::request() const {
    SceneOptions options = {.subjects = built_in_catalog().subjects};
    if (unit_mm != 0) {
        DERMIS_TRY(check_number("--unit-mm", unit_mm, kUnitRangeMm));
        if (!is_mesh_file(mesh))
            return Error{"--unit-mm is for mesh files; " + mesh + " states the unit of each of its meshes"};
        options.mesh_unit_mm = unit_mm;
    }
    DERMIS_TRY_ASSIGN(options.words, pose.words());
    DERMIS_TRY_ASSIGN(Scene scene, load_scene(mesh, options));
    DERMIS_TRY_ASSIGN(BakeMapSettings chosen, settings_for(scene.skin.profile));
    DERMIS_TRY_ASSIGN(LayoutOfMap layout, lay_out(scene));
    chosen.uvs = layout.uvs;
    return MapRequest{std::move(scene), std::move(chosen), std::move(layout)};
}

}  // namespace dermis::cli
