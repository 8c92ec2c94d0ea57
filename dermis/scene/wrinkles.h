#pragma once
// Wrinkle maps: normals of skin that is stretched or compressed (mesh/tension.h).

#include <string>
#include <vector>

#include "dermis/base/hash.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Weights of the wrinkle maps by their morph targets, 0 to 1.
struct WrinkleWeights {
    float stretch = 0, compress = 0;
};
[[nodiscard]] WrinkleWeights wrinkle_weights(const Material& material, const TargetWeights& weights);

/// Whether some material has a wrinkle map.
[[nodiscard]] bool has_wrinkles(const Scene& scene);

/// Errors: a wrinkle map without a normal map in tangent space, or an empty range of tensions.
[[nodiscard]] Result<void> check_wrinkles(const Material& material);

/// Errors: a wrinkle map's morph target that no mesh has.
[[nodiscard]] Result<void> check_wrinkle_targets(const Scene& scene);

/// Whether the object's pose may show wrinkles: it has a tension, or the target of a wrinkle map has a
/// weight.
[[nodiscard]] bool shows_wrinkles(const SceneObject& object);

/// Whether the scene has wrinkle maps or blood that follows tension and no mesh that moves: one line, or
/// nothing.
[[nodiscard]] std::vector<std::string> tension_warnings(const Scene& scene);

/// Adds what the pose changes of the object's mapped normals, and nothing where it changes none, so that
/// hashes of other scenes stay. Errors: a map that cannot be read.
[[nodiscard]] Result<void> add_wrinkles(Hasher& hasher, const SceneObject& object);

}  // namespace dermis::inline scene
