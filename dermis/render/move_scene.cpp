#include "dermis/render/move_scene.h"

#include "dermis/render/complete_scene.h"
#include "dermis/scene/move_objects.h"
#include "dermis/scene/rest_bakes.h"

namespace dermis::inline render {

Result<void> move_scene(double time_s, Scene& scene, Renderer& renderer) {
    scene.motion.time_s = time_s;
    DERMIS_TRY(move_objects(scene));
    DERMIS_TRY(complete_scene(scene));
    DERMIS_TRY(check_rest_objects(scene));
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    return renderer.objects_replaced();
}

}  // namespace dermis::inline render
