#pragma once
// Meshes to files: GLB and OBJ.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

struct Rig;  // dermis/mesh/rig.h

/// A PNG or JPEG to embed for every material map of that name.
struct NamedImage {
    std::string name;                ///< as in ImageSource::name
    std::vector<std::byte> encoded;  ///< the file's bytes
};

/// glTF 2.0 in metres with all its attributes, one node, one primitive per submesh; atlas_uvs are the second
/// set of UVs. Materials have metallic-roughness and, where set, KHR_materials_volume, _diffuse_transmission,
/// _volume_scatter, _scatter, _specular, _ior, none of them required. Maps are embedded from `images` by
/// name, or from the material's own bytes. `extras` is the JSON of the materials' `extras`, in their order;
/// empty: none. Errors: a map without bytes or neither PNG nor JPEG, extras that are not JSON, more than 4
/// GiB, an unwritable file. read_mesh() reads everything but extras.
///
/// glTF does not hold curvature and occlusion, object-space normal maps, maps of roughness alone,
/// displacement, opacity, kernel size and curvature.
[[nodiscard]] Result<void> write_glb(const std::filesystem::path& path, const Mesh& mesh,
                                     std::span<const NamedImage> images = {},
                                     std::span<const std::string> extras = {});

/// The bytes that write_glb() writes. `more_uvs`, each with one entry a position, become TEXCOORD_2 and on in
/// one interleaved view: numbers of the vertices that every engine reads. With a rig, which is of this mesh,
/// the file has the rig's nodes, shapes and clips.
[[nodiscard]] Result<std::vector<std::byte>> glb_bytes(const Mesh& mesh,
                                                       std::span<const NamedImage> images = {},
                                                       std::span<const std::string> extras = {},
                                                       std::span<const std::vector<Vec2>> more_uvs = {},
                                                       const Rig* rig = nullptr);

/// Positions in millimetres, normals, UVs (origin bottom-left, as OBJ has it), `usemtl` by name; an MTL of
/// the same name beside it, with map paths as in the materials.
[[nodiscard]] Result<void> write_obj(const std::filesystem::path& path, const Mesh& mesh);

/// The texts that write_obj() writes to mtl_path(path) and to `path`.
struct ObjTexts {
    std::string mtl, obj;
};
[[nodiscard]] ObjTexts obj_texts(const std::filesystem::path& path, const Mesh& mesh);
[[nodiscard]] std::filesystem::path mtl_path(const std::filesystem::path& obj_path);

}  // namespace dermis::inline mesh
