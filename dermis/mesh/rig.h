#pragma once
// What moves a mesh, as glTF has it: nodes, skins, morph targets and clips, for a file that moves as its
// source does. Internal to dermis.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/gltf/sampler.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/pose.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh {

/// Lengths are in units of the source; the root's scale makes metres of them.
struct RigNode {
    std::string name;
    std::vector<uint32_t> children = {};
    std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
    std::array<double, 4> rotation = {0, 0, 0, 1};      ///< x y z w
    std::optional<std::array<double, 16>> matrix = {};  ///< instead of the three
};

struct RigSkin {
    std::vector<uint32_t> joints;  ///< nodes
    std::vector<std::array<float, 16>> inverse_binds;
};

/// Changes at weight 1, one a vertex.
struct RigTarget {
    std::string name;
    std::vector<Vec3> moves_mm, turns;  ///< of positions and of normals
};

/// What one node draws, in the node's own space or in that in which its skin was bound.
struct RigPart {
    uint32_t node = 0;
    std::optional<uint32_t> skin = {};
    Mesh mesh = {};  ///< without morph; a thousandth of its lengths is a unit of the source
    std::vector<uint32_t> vertices = {};  ///< of the whole mesh, one a vertex of `mesh`
    size_t influences = 0;                ///< of a vertex, a multiple of 4; the strongest come first
    std::vector<uint16_t> joints = {};
    std::vector<float> weights = {};
    std::vector<RigTarget> targets = {};
    std::vector<float> target_weights = {};  ///< in the pose
};

struct RigChannel {
    uint32_t node = 0;
    std::string path;  ///< of glTF: translation, rotation, scale, weights
    gltf::Keys keys;
};
struct RigClip {
    std::string name;
    std::vector<RigChannel> channels;
};

struct Rig {
    std::vector<RigNode> nodes;  ///< the first is the root; nodes and weights are in the pose
    std::vector<RigSkin> skins;
    std::vector<RigPart> parts;
    std::vector<RigClip> clips;
};

/// Cubic splines of all clips become linear keys, 60 a second, for readers that have no splines of rotations.
void make_keys_linear(Rig& rig);

/// The part of `mesh` that the submeshes make: its vertices and their attributes, without materials.
[[nodiscard]] RigPart part_of(const Mesh& mesh, std::span<const size_t> submeshes);

/// A glTF file's, whose nodes become those after `root`. `mesh` is what was read of the file in `pose` and
/// placed as `root` says (scaled to mm): Mesh::file_vertices count the file's vertices. Targets without
/// normals get those by which the surface turns. Clips that cannot be read are left out. Errors: the file,
/// other vertices than the mesh's.
[[nodiscard]] Result<Rig> read_rig(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                   const ReadSibling& read_sibling, const Mesh& mesh, const Pose& pose,
                                   const RigNode& root);

}  // namespace dermis::inline mesh
