#pragma once
// A mesh as the module holds it.

#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::python {

struct MeshObject {
    std::string name;
    Mesh mesh;
    std::vector<std::string> warnings;
    std::vector<MaterialClass> classes = {};  ///< empty: all skin
};

/// One mesh as the object of a scene, which the map bakers take.
[[nodiscard]] inline SceneObject scene_object(const MeshObject& object) {
    SceneObject made{.name = object.name, .mesh = object.mesh, .classes = object.classes};
    made.classes.resize(made.mesh.materials.size(), MaterialClass::skin);
    return made;
}

}  // namespace dermis::python
