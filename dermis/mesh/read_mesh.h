#pragma once
// Mesh files in, meshes in millimetres out: OBJ with MTL, glTF 2.0 and GLB.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/pose.h"

namespace dermis::inline mesh {

struct MeshOptions {
    /// Millimetres per unit of the file; none: 1000 for glTF (metres), 1 for OBJ.
    std::optional<double> unit_mm;
    /// Factor by which the caller scales the mesh later; used by the warning about its height.
    double scale_after = 1;
    /// Choose another unit, with a warning, if a mesh without unit_mm has the height of no head or person.
    bool guess_unit = false;
    /// Catmull-Clark refinements (subdivide.h); OBJ keeps its quads for them.
    int subdivision_level = 0;
    /// Do not warn about a missing MTL: the caller has its own materials.
    bool ignore_missing_materials = false;
    /// More, also by instancing, is an error before any is read.
    size_t max_vertices = 50'000'000;
    /// Most nodes of a glTF file.
    size_t max_nodes = 65'536;
    /// glTF: where the mesh is in its motion. A clip and targets that the file lacks change nothing;
    /// check_pose() finds them.
    Pose pose = {};
    /// Every vertex of the file in its order: unused ones stay, none is split, so that some lack a tangent.
    bool keep_vertices = false;
};

struct LoadedMesh {
    Mesh mesh;
    std::vector<std::string> warnings;  ///< one line each, for the user
    double unit_mm = 1;                 ///< of the file, as stated, by its format, or guessed
    Motion motion = {};                 ///< clips and morph targets of a glTF file
    /// In the pose; where meshes differ in the weight of a name, the one farther from 0.
    TargetWeights target_weights = {};
    /// The mesh file and the files beside it that it names, existing or not; maps are in the materials.
    std::vector<std::filesystem::path> files;
};

/// Reads a file that the mesh names (an MTL, a .bin) by its path relative to the mesh; never called with a
/// path that leaves the mesh's directory.
using ReadSibling = std::function<Result<std::vector<std::byte>>(const std::string& relative_path)>;

/// By its extension: .obj, .gltf or .glb.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Applies node transforms; mirrored parts keep their fronts outside. Every value of the result is finite and
/// every index in range. Normals and tangents are unit, computed where the file has none (normals.h,
/// tangents.h).
///
/// glTF: skins and morph targets in the pose of the options, else of the file's nodes and weights; where
/// targets move vertices and have no normals, normals turn as the surface does. The UV set and
/// KHR_texture_transform of each material's first texture (a warning names maps with others, which are left
/// out with their factors).
///
/// Errors (one line, naming file and place): unreadable or truncated files, no triangles, positions that are
/// not finite, indices out of range, missing buffers, URIs that leave the directory, unknown required
/// extensions, more vertices or nodes than the options allow.
///
/// Warnings: missing MTL, UDIM tiles, missing UVs, a height that no head has, skipped content.
///
/// Cost: see bench/mesh_bench.cpp; a 17,684-triangle OBJ of 3 MB takes about 30 ms on one core.
[[nodiscard]] Result<LoadedMesh> read_mesh(const std::filesystem::path& path,
                                           const MeshOptions& options = {});

enum class MeshFormat { obj, gltf, glb };

/// The same from memory. `name` is the file in messages and gives image paths their directory.
[[nodiscard]] Result<LoadedMesh> parse_mesh(std::span<const std::byte> bytes, MeshFormat format,
                                            const std::filesystem::path& name,
                                            const ReadSibling& read_sibling, const MeshOptions& options = {});

/// A relative path that stays below its directory and names a plain file: no scheme, no root, no "..", no
/// backslash.
[[nodiscard]] bool stays_inside(std::string_view relative_path);

}  // namespace dermis::inline mesh
