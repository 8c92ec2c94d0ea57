#pragma once
// A mesh file in a pose as a file of its own: what export-mesh does with a mesh file.

#include <filesystem>
#include <string>

#include "command.h"
#include "pose_choice.h"

namespace dermis::cli {

struct MeshFileChoice {
    PoseChoice pose;
    double unit_mm = 0;  ///< 0: by the format

    void add_to(Command& command);
};

/// Errors: an output that is neither .obj nor .glb.
[[nodiscard]] Result<FileUse> files_of_posed_mesh(const std::string& mesh,
                                                  const std::filesystem::path& output);

/// Every vertex of the file in its order, in mm.
[[nodiscard]] Result<int> export_posed_mesh(const std::string& mesh, const std::filesystem::path& output,
                                            const MeshFileChoice& choice);

}  // namespace dermis::cli
