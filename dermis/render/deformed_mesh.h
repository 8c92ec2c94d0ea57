#pragma once
// Topology and rest shape of a mesh as arrays for the shaders renderer/pose_*.comp.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dermis/mesh/mesh_poser.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::inline render {

/// The words of one array, by the name that the passes know it by.
struct DeformArray {
    std::string name;
    std::vector<uint32_t> words;
};

struct DeformArrays {
    std::vector<DeformArray> constant;  ///< what no pose changes
    uint32_t places = 0, vertices = 0;  ///< threads of the passes
    bool has_normal_changes = false;
    uint32_t targets = 0;  ///< rows of the tables of blocks, at least 1
};

/// `mesh` is the scene's, whose file_vertices count the motion's. `at_rest_mm`: all vertices of the file at
/// rest, in the scene. Element layouts: shaders/renderer/pose.glsl.
[[nodiscard]] DeformArrays deform_arrays(const VertexMotion& motion, const Mesh& mesh,
                                         const SurfaceAtRest& rest, std::span<const Vec3> at_rest_mm);

}  // namespace dermis::inline render
