#pragma once
// Where the alpha map of a material lets rays pass: cards of hair and lashes. The renderer has the same rules
// (shaders/include/cut_out.glsl, shaders/renderer/standard.frag).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/rays/texture.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

/// The alpha of one material on its mesh, which must outlive it.
class CutOut {
  public:
    /// Null for a material that is whole. Errors name the map.
    [[nodiscard]] static Result<std::unique_ptr<CutOut>> load(const SceneObject& object, uint32_t material);

    /// The map's times the vertices', at the barycentric weights u and v of the second and third corner.
    [[nodiscard]] float alpha(uint32_t triangle, float u, float v) const;
    [[nodiscard]] bool passes(uint32_t triangle, float u, float v) const {
        return alpha(triangle, u, v) < cutoff_;
    }
    /// For rays that blend what they meet.
    [[nodiscard]] bool shows_nothing(uint32_t triangle, float u, float v) const {
        return is_blended_ ? alpha(triangle, u, v) == 0 : passes(triangle, u, v);
    }

  private:
    CutOut(const Mesh& mesh, float cutoff, bool is_blended, Texture alpha)
        : mesh_(&mesh), cutoff_(cutoff), is_blended_(is_blended), alpha_(std::move(alpha)) {}

    const Mesh* mesh_;
    float cutoff_;
    bool is_blended_;
    Texture alpha_;
};

}  // namespace dermis::inline rays
