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

/// Which morph targets change which blocks of posing::kPoseBlock places or vertices.
struct ChangedBlocks {
    uint32_t blocks = 0;
    /// By target, then block: the block's first change, or kUnchanged.
    std::vector<uint32_t> firsts = {};
    /// Likewise, of vertices: whether the target moves a place around one of them. Empty for places.
    std::vector<bool> moves_around = {};

    static constexpr uint32_t kUnchanged = ~0u;
};

struct DeformArrays {
    std::vector<DeformArray> constant;  ///< what no pose changes
    uint32_t places = 0, vertices = 0;  ///< threads of the passes
    bool has_normal_changes = false;
    ChangedBlocks of_places, of_vertices;
};

/// Lists of active targets by block, as shaders/renderer/pose.glsl has them. `has_normals`: as VertexMotion
/// has it; without it the targets' weights are also those before normals turn.
[[nodiscard]] std::vector<uint32_t> active_targets(const ChangedBlocks& changed,
                                                   std::span<const float> weights,
                                                   std::span<const uint8_t> has_normals);

/// `mesh` is the scene's, whose file_vertices count the motion's. `at_rest_mm`: all vertices of the file at
/// rest, in the scene. Element layouts: shaders/renderer/pose.glsl.
[[nodiscard]] DeformArrays deform_arrays(const VertexMotion& motion, const Mesh& mesh,
                                         const SurfaceAtRest& rest, std::span<const Vec3> at_rest_mm);

}  // namespace dermis::inline render
