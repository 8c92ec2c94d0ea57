#pragma once
// The boundary of random walks in a scene's skin.

#include <cmath>

#include "dermis/rays/random_walk.h"
#include "dermis/rays/ray_scene.h"

namespace dermis::inline rays {

/// The triangles that bound the flesh. Parts that overlap (lids that cross, a nose set into a face) count as
/// one body: only a face that leads out of the last part is its boundary. Remembers the last face met, for
/// its attributes, and whether the path is at a face; one path uses one boundary.
class FleshBoundary {
  public:
    explicit FleshBoundary(const RayScene& rays)
        : rays_(rays), box_(rays.bounds(RaySet::flesh)), rounding_mm_(0.25f * rays.epsilon_mm()) {}

    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) {
        float from_mm = 0;
        while (const auto hit = rays_.closest_hit(
                   RaySet::flesh,
                   {.origin_mm = p_mm, .direction = direction, .min_mm = from_mm, .max_mm = max_mm})) {
            const float cosine = dot(hit->n_face, direction);
            if (cosine > 0 && bodies_ == 1) {
                last_ = *hit;
                return BoundaryHit{hit->distance_mm, hit->n_face, hit->object == kCapObject};
            }
            // A path that starts at a face may, by rounding, start just before it: it does not enter there.
            const bool rounding = cosine <= 0 && -cosine * hit->distance_mm < rounding_mm_;
            if (!rounding) bodies_ += cosine > 0 ? -1 : 1;
            from_mm = std::nextafter(hit->distance_mm, max_mm);
        }
        // Outside the box the path left where no face is: a boundary met from its back, which ends it
        // as lost.
        if (!inside_box(p_mm + direction * max_mm)) return BoundaryHit{max_mm, -direction};
        return std::nullopt;
    }
    [[nodiscard]] const RayHit& last() const { return last_; }

  private:
    [[nodiscard]] bool inside_box(Vec3 p) const {
        const Vec3 a = box_.min_mm, b = box_.max_mm;
        return p.x >= a.x && p.y >= a.y && p.z >= a.z && p.x <= b.x && p.y <= b.y && p.z <= b.z;
    }

    const RayScene& rays_;
    RayScene::Bounds box_;
    float rounding_mm_;
    int bodies_ = 1;
    RayHit last_;
};

}  // namespace dermis::inline rays
