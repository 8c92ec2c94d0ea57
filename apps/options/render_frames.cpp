#include "render_frames.h"

#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/render/move_scene.h"

namespace dermis::cli {

void turn_camera(Scene& scene, const Camera& start, double angle_rad) {
    const Vec3 offset = start.eye_mm - start.target_mm;
    const float c = float(std::cos(angle_rad)), s = float(std::sin(angle_rad));
    scene.camera = start;
    scene.camera.eye_mm =
        start.target_mm + Vec3{c * offset.x + s * offset.z, offset.y, c * offset.z - s * offset.x};
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
}

Result<void> show_frame(const RenderFrames& frames, int frame, const Scene& start, Scene& scene,
                        Renderer& renderer) {
    const double time_s = start.motion.time_s + (frames.fps > 0 ? frame / frames.fps : 0);
    if (scene.motion.time_s != time_s) DERMIS_TRY(move_scene(time_s, scene, renderer));
    turn_camera(scene, start.camera, frames.turn_deg * 3.14159265358979 / 180 * frame / frames.count);
    return {};
}

}  // namespace dermis::cli
