#pragma once
// Wrinkle maps: normals of skin that is stretched or compressed (mesh/tension.h).

#include <string>
#include <vector>

#include "dermis/base/hash.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Whether some material has a wrinkle map.
[[nodiscard]] bool has_wrinkles(const Scene& scene);

/// Errors: a wrinkle map without a normal map in tangent space, or an empty range of tensions.
[[nodiscard]] Result<void> check_wrinkles(const Material& material);

/// Whether the scene has wrinkle maps or blood that follows tension and no mesh that moves: one line, or
/// nothing.
[[nodiscard]] std::vector<std::string> tension_warnings(const Scene& scene);

/// Adds what the tension changes of the object's normals, and nothing where it changes none, so that hashes
/// of other scenes stay. Errors: a map that cannot be read.
[[nodiscard]] Result<void> add_wrinkles(Hasher& hasher, const Mesh& mesh);

}  // namespace dermis::inline scene
