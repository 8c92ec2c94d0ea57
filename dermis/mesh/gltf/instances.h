#pragma once
// Where the primitives of a glTF file are in a pose. Internal to dermis/mesh.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/material.h"
#include "dermis/mesh/gltf/node_tree.h"
#include "dermis/mesh/gltf/primitive.h"

namespace dermis::inline mesh::gltf {

/// Instance::material of a primitive without a material.
inline constexpr uint32_t kDefaultMaterial = ~0u;

/// A primitive of a node. The pointers stay valid while the Instances live, `joints` until the next pose.
struct Instance {
    std::string name;              ///< of its mesh, else of its node
    size_t placement = 0;          ///< a number that primitives of one node share
    std::optional<uint64_t> node;  ///< none in a file without nodes
    JsonView source;               ///< of the primitive
    Primitive* primitive = nullptr;
    uint32_t material = kDefaultMaterial;
    Affine world;
    std::span<const Affine> joints;  ///< empty: not skinned
    std::vector<float> morph;        ///< weights of its targets
};

/// Reads primitives once and places them in any number of poses. The document must outlive it. Errors are
/// left in its messages.
class Instances {
  public:
    /// `to_mm` comes after every root.
    Instances(Document& document, const Affine& to_mm);
    Instances(Document& document, double mm_per_unit);

    /// All that the default scene draws, in its order, or all meshes of a file without nodes.
    [[nodiscard]] std::vector<Instance> in_pose(const Pose& pose);
    /// The weights of the pose that in_pose() took last.
    [[nodiscard]] const TargetWeights& target_weights() const { return target_weights_; }
    [[nodiscard]] const Affine& to_mm() const { return to_mm_; }
    /// The nodes in that pose, and what it changes of them.
    [[nodiscard]] const NodeTree& tree() const { return tree_; }
    [[nodiscard]] const NodePoses& node_poses() const { return node_poses_; }

  private:
    struct Placement {
        std::optional<uint64_t> node;
        std::string node_name;
        Affine world;
        std::span<const Affine> joints;
        std::vector<float> morph;  // empty: the mesh's own
    };
    [[nodiscard]] bool failed() const { return document_.messages.error.has_value(); }
    [[nodiscard]] uint64_t vertices_of(uint64_t mesh);
    void check_size();
    void add_node(uint64_t index, const Pose& pose);
    void add_mesh(uint64_t index, const Placement& placement, const Pose& pose);
    [[nodiscard]] Primitive* primitive_of(uint64_t mesh, size_t index, uint32_t material, size_t joint_count);
    void note_weights(const JsonView& mesh, std::span<const float> morph);
    [[nodiscard]] uint32_t material_of(const JsonView& source);

    Document& document_;
    Affine to_mm_;
    NodePoses node_poses_;
    NodeTree tree_;
    std::vector<UvMapping> uv_mappings_;  // of every material
    std::map<uint64_t, std::vector<Affine>> joints_of_skin_;
    std::map<std::tuple<uint64_t, size_t, size_t>, std::optional<Primitive>> primitives_;  // none: skipped
    std::vector<Instance> instances_;
    TargetWeights target_weights_;
    size_t placements_ = 0;
    size_t vertices_ = 0, indices_ = 0;  // how many the instances so far have
    bool checked_ = false;
};

/// Positions, normals and tangents of an instance's vertices, appended to the mesh's: zero normals and
/// tangents where the file has none.
struct PlacedVertices {
    double determinants = 0;     ///< the sum of the transforms': negative for a mirrored instance
    bool has_unmorphed = false;  ///< targets without normals moved some
};
[[nodiscard]] PlacedVertices place_vertices(Document& document, const Instance& instance, const Affine& to_mm,
                                            Mesh& mesh, std::vector<Vec3>& unmorphed_mm);

/// Triangles of an instance whose vertices begin at `first`. A mirrored triangle shows its back; turning it
/// round keeps fronts outside.
void append_triangles(std::span<const uint32_t> triangles, size_t first, bool mirrored,
                      std::vector<uint32_t>& indices);

}  // namespace dermis::inline mesh::gltf
