#pragma once
// Probable mistakes in an object of a scene, and which of its materials are not skin.

#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Cards of hair and lashes: a material that alpha cuts out, of a mesh that has whole materials too. It is no
/// skin unless a scene file says so. (Exporters mark whole heads as cut out; those stay skin.)
[[nodiscard]] bool is_card(const Mesh& mesh, const Material& material);

/// One line each, with the fix: alpha that does less than the mesh file says (skin is never cut
/// out, nothing is blended); a head that does not face +Z; double-sided sheets as skin.
[[nodiscard]] std::vector<std::string> object_warnings(const SceneObject& object);

}  // namespace dermis::inline scene
