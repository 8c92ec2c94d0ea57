#pragma once
// Where the alpha map of a material lets rays pass: cards of hair and lashes. The renderer has the same rule
// (shaders/include/cut_out.glsl).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/rays/texture.h"
#include "dermis/scene/scene.h"

namespace dermis {

/// The alpha of one material on its mesh, which must outlive it.
class CutOut {
  public:
    /// Null for a material that is whole. Errors name the map.
    [[nodiscard]] static Result<std::unique_ptr<CutOut>> load(const SceneObject& object, uint32_t material);

    /// At the barycentric weights u and v of the second and third corner.
    [[nodiscard]] bool passes(uint32_t triangle, float u, float v) const;

  private:
    CutOut(const Mesh& mesh, float cutoff, Texture alpha)
        : mesh_(&mesh), cutoff_(cutoff), alpha_(std::move(alpha)) {}

    const Mesh* mesh_;
    float cutoff_;
    Texture alpha_;
};

}  // namespace dermis
