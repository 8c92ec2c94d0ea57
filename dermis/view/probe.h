#pragma once
// Curvature and thickness under the mouse pointer, measured on the mesh with rays.

#include <optional>
#include <string>

#include "dermis/rays/ray_scene.h"
#include "dermis/scene/scene.h"

namespace dermis::view {

struct ProbeReading {
    Vec3 p_world_mm;
    float curvature_per_mm = 0;         ///< signed mean, positive where convex
    std::optional<float> thickness_mm;  ///< straight inwards to the other side; absent where there is none
    std::string material;
};

/// Keeps pointers into the scene, which must outlive it with its objects unchanged.
class Probe {
  public:
    [[nodiscard]] static Result<Probe> create(const Scene& scene);

    /// At a place of the picture, 0..1 from the top left; nothing where there is no surface. Some
    /// microseconds.
    [[nodiscard]] std::optional<ProbeReading> at(const Camera& camera, Vec2 place, float aspect) const;

  private:
    Probe(RayScene rays, const Scene& scene) : rays_(std::move(rays)), scene_(&scene) {}
    [[nodiscard]] float curvature_at(const RayHit& hit) const;

    RayScene rays_;
    const Scene* scene_;
};

/// "curvature 0.042 /mm (radius 23.8 mm)   thickness 3.1 mm   skin".
[[nodiscard]] std::string probe_text(const ProbeReading& reading);

}  // namespace dermis::view
