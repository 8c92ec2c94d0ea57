#include "map_layout.h"

#include <cstdio>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/scene/skin_atlas.h"

namespace dermis::cli {

Result<LayoutOfMap> lay_out_map(Scene& scene, const std::string& uvs) {
    if (!uvs.empty() && uvs != "file" && uvs != "atlas")
        return Error{unknown_name("--uvs", uvs, std::vector<std::string>{"file", "atlas"})};
    lay_out_skin_atlas(scene);
    const bool has_atlas = std::ranges::any_of(
        scene.objects, [](const SceneObject& object) { return !object.mesh.atlas_uvs.empty(); });
    if (uvs == "file") return LayoutOfMap{UvSet::file, "by the UVs of the file"};
    if (!has_atlas)
        return LayoutOfMap{UvSet::file, "by the UVs of the file: each place of the skin has its own texels"};
    return LayoutOfMap{UvSet::atlas, "by an atlas, as the UVs of the file share texels or leave 0..1"};
}

std::filesystem::path atlas_mesh_path(const std::filesystem::path& map) {
    return map.parent_path() / (map.stem().string() + "_atlas.glb");
}

std::string atlas_mesh_name(const LayoutOfMap& layout, const std::filesystem::path& map) {
    return layout.is_atlas() ? atlas_mesh_path(map).filename().string() : std::string();
}

Result<void> deliver_layout(const Scene& scene, const LayoutOfMap& layout, const std::filesystem::path& map) {
    std::printf("laid out %s\n", layout.reason.c_str());
    if (!layout.is_atlas()) return {};
    const std::filesystem::path path = atlas_mesh_path(map);
    DERMIS_TRY(write_glb(path, skin_with_atlas(scene)));
    std::printf("%s: the skin with the UVs of the atlas as TEXCOORD_1\n",
                printable_line(path.string()).c_str());
    return {};
}

}  // namespace dermis::cli
