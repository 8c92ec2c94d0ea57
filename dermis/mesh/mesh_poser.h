#pragma once
// A glTF file that was read once, in one pose after another.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "dermis/base/result.h"
#include "dermis/mesh/pose.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh {

/// Movable. Keeps the file's buffers, primitives and used morph targets. Not for several threads at once.
class MeshPoser {
  public:
    /// Of the options unit_mm and the limits count. Errors: those of parse_mesh().
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

    struct State;

  private:
    explicit MeshPoser(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::inline mesh
