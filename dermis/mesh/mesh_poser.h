#pragma once
// A glTF file that was read once, in one pose after another.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/pose.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh {

/// How the vertices of a file move, as lists for a device: in a pose p = sum of share * matrix * (position +
/// sum of weight * change), and normals likewise before they turn (follow_normals.h).
struct VertexMotion {
    struct Change {
        uint32_t weight = 0;  ///< index into MotionState::weights
        Vec3 change;          ///< at weight 1
    };
    struct Influence {
        uint32_t matrix = 0;  ///< index into MotionState::matrices
        float share = 1;
    };
    /// At rest, in the file's units and each primitive's own space; normals are 0 where the file has none.
    std::vector<Vec3> positions, normals;
    /// Of vertex i: changes[first_change[i] .. first_change[i + 1]), the others likewise.
    std::vector<uint32_t> first_change, first_normal_change, first_influence;
    std::vector<Change> changes, normal_changes;
    std::vector<Influence> influences;
    std::vector<uint32_t> indices;
    std::vector<uint8_t>
        has_normals;  ///< a flag for each weight: its target has normals, which then do not turn
};

/// A pose of it.
struct MotionState {
    std::vector<float> weights;
    std::vector<std::array<double, 12>> matrices;  ///< to mm; 3 rows of 4
    TargetWeights target_weights;
};

/// Movable. Keeps the file's buffers, primitives and used morph targets. Not for several threads at once.
class MeshPoser {
  public:
    /// Reads only unit_mm and the limits of the options. Errors: those of parse_mesh().
    [[nodiscard]] static Result<MeshPoser> create(std::span<const std::byte> bytes,
                                                  const std::filesystem::path& name,
                                                  const ReadSibling& read_sibling,
                                                  const MeshOptions& options);
    ~MeshPoser();
    MeshPoser(MeshPoser&&) noexcept;
    MeshPoser& operator=(MeshPoser&&) noexcept;

    /// The vertices of parse_mesh() with keep_vertices in this pose, bit for bit. Errors: those of
    /// parse_mesh().
    [[nodiscard]] Result<PosedVertices> pose(const Pose& pose) const;
    /// Reads all targets. Errors: those of parse_mesh().
    [[nodiscard]] Result<VertexMotion> motion() const;
    [[nodiscard]] Result<MotionState> state(const Pose& pose) const;

    struct State;

  private:
    explicit MeshPoser(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::inline mesh
