#pragma once
// Baked normals of a scene or a mesh file, for `dermis bake normals` and Python.

#include <string>
#include <vector>

#include "dermis/rays/diffused_normals_file.h"
#include "map_layout.h"
#include "pose_choice.h"

namespace dermis::cli {

inline constexpr NumberRange kNormalsSizeRange = {16, 8192};

struct MadeNormals {
    Scene scene;  ///< with its atlas where the maps are over one
    LayoutOfMap layout;
    DiffusedNormals normals;
    DiffusedNormalsOrigin origin;  ///< without uv_file
    std::vector<std::string> warnings;
};

struct NormalsOptions {
    std::string mesh;     ///< scene or mesh file
    std::string profile;  ///< empty: the scene's
    float unit_mm = 0;    ///< of a mesh file; 0: as the file has it
    PoseChoice pose;
    int size = DiffusedNormalsRequest{}.size;

    /// Of an output: both maps with their texts, and the atlas. Errors: an extension that is not written.
    [[nodiscard]] Result<FileUse> files(const std::string& output) const;
    /// The scene may not be made of `files`. Errors as load_scene() and bake_diffused_normals().
    [[nodiscard]] Result<MadeNormals> make(const Result<FileUse>& files) const;
};

/// The files of NormalsOptions::files(), but for the atlas.
[[nodiscard]] Result<void> write_normals(const std::string& output, const MadeNormals& made);

}  // namespace dermis::cli
