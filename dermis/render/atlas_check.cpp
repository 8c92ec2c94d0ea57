#include "dermis/render/atlas_check.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/mesh/uv_report.h"

namespace dermis::inline render {
namespace {

constexpr int kFirstTile = 1001;
constexpr double kOverlapWorthSaying = 1e-3, kOverlapUnfit = 0.01;

std::string percent(double share) {
    const double rounded = std::round(share * 1000) / 10;
    return to_text(rounded > 0 ? rounded : 0.1) + " %";
}

// The warning about the UVs of one skin material; empty when they are fine.
std::string tiles_warning(const Mesh& mesh, const Submesh& submesh) {
    const uint32_t count = submesh.index_count / 3;
    const std::vector<Vec2>& uvs = atlas_uvs_of(mesh);
    std::vector<int> tiles;
    uint32_t outside = 0;
    for (uint32_t t = 0; t < count; ++t) {
        const uint32_t* corner = &mesh.indices[submesh.first_index + 3 * size_t(t)];
        const Vec2 middle = (uvs[corner[0]] + uvs[corner[1]] + uvs[corner[2]]) * (1.0f / 3);
        const int tile = udim_tile(middle);
        if (tile == kFirstTile) continue;
        ++outside;
        if (tile != 0 && std::ranges::find(tiles, tile) == tiles.end()) tiles.push_back(tile);
    }
    if (outside == 0) return {};
    std::string text = "skin material '" + mesh.materials[submesh.material].name + "': ";
    if (outside == count && !tiles.empty()) {
        text += "UDIM tile";
        for (const int tile : tiles) text += " " + std::to_string(tile);
        return text + " is skipped, the light map is tile 1001: it is lit without scattering";
    }
    return text + percent(double(outside) / count) +
           " of its triangles lie outside 0..1 in UV: they are lit without scattering";
}

void append_skin(const SceneObject& object, Mesh& all) {
    const auto base = uint32_t(all.positions_mm.size());
    all.positions_mm.insert(all.positions_mm.end(), object.mesh.positions_mm.begin(),
                            object.mesh.positions_mm.end());
    const std::vector<Vec2>& uvs = atlas_uvs_of(object.mesh);
    all.uvs.insert(all.uvs.end(), uvs.begin(), uvs.end());
    for (const Submesh& submesh : object.mesh.submeshes) {
        if (object.classes[submesh.material] != MaterialClass::skin) continue;
        for (uint32_t i = 0; i < submesh.index_count; ++i)
            all.indices.push_back(base + object.mesh.indices[submesh.first_index + i]);
    }
}

std::string name_of(const SceneObject& object, const Submesh& submesh) {
    return object.mesh.materials[submesh.material].name;
}

bool is_skin(const SceneObject& object, const Submesh& submesh) {
    return object.classes[submesh.material] == MaterialClass::skin && submesh.index_count > 0;
}

// "'head': skin material 'face' has no UVs", of the first for which that is so.
std::optional<std::string> without_uvs(const Scene& scene) {
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes)
            if (is_skin(object, submesh) &&
                atlas_uvs_of(object.mesh).size() != object.mesh.positions_mm.size())
                return "'" + object.name + "': skin material '" + name_of(object, submesh) + "' has no UVs";
    return std::nullopt;
}

// Share of the atlas's covered texels under more than one triangle. Needs UVs.
double overlap_of_skin(const Scene& scene) {
    Mesh all;
    for (const SceneObject& object : scene.objects)
        if (std::ranges::any_of(object.mesh.submeshes,
                                [&](const Submesh& submesh) { return is_skin(object, submesh); }))
            append_skin(object, all);
    if (all.indices.empty()) return 0;
    all.materials.resize(1);
    all.submeshes = {{.name = "skin", .first_index = 0, .index_count = uint32_t(all.indices.size())}};
    return analyze_uvs(all).overlap;
}

// What the layout of the atlas does for one material of an object that has atlas_uvs; empty where it only
// moves UVs.
std::string layout_warning(const SceneObject& object, const Submesh& submesh) {
    const std::string name = "skin material '" + name_of(object, submesh) + "'";
    const std::string end = " for light maps and baked maps";
    if (object.mesh.uvs.size() != object.mesh.positions_mm.size())
        return name + " has no UVs, so Dermis makes some" + end +
               "; UVs that were made for the head draw better (docs/figures.md#uvs-of-other-heads)";
    const double overlap = analyze_uvs(object.mesh, submesh.material, 512).overlap;
    if (overlap <= kOverlapUnfit) return {};
    return percent(overlap) + " of the UVs of " + name + " overlap, so Dermis spreads them" + end;
}

}  // namespace

Result<std::vector<std::string>> check_skin_atlas(const Scene& scene) {
    if (const auto missing = without_uvs(scene))
        return Error{*missing +
                     ", and this technique lights the skin in its UV atlas; add UVs to the mesh, or choose a "
                     "technique that needs no atlas"};
    std::vector<std::string> warnings, materials;
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes) {
            if (!is_skin(object, submesh)) continue;
            const std::string name = "'" + name_of(object, submesh) + "'";
            if (std::ranges::find(materials, name) == materials.end()) materials.push_back(name);
            std::string warning = object.mesh.atlas_uvs.empty() ? tiles_warning(object.mesh, submesh)
                                                                : layout_warning(object, submesh);
            if (!warning.empty() && std::ranges::find(warnings, warning) == warnings.end())
                warnings.push_back(std::move(warning));
        }
    if (const double overlap = overlap_of_skin(scene); overlap > kOverlapWorthSaying)
        warnings.push_back(
            percent(overlap) + " of the skin's atlas is covered by more than one triangle (" +
            join(materials, ", ") +
            "): these parts of the skin share texels, so that each has the light and shadows of the other");
    return warnings;
}

std::string unfit_for_baked_maps(const Scene& scene) {
    constexpr const char* kMend = "; give each place of the skin texels of its own";
    if (const std::optional<std::string> reason = without_uvs(scene)) return *reason + kMend;
    const double overlap = overlap_of_skin(scene);
    if (overlap <= kOverlapUnfit) return "";
    return percent(overlap) + " of the skin's UV atlas is covered by more than one triangle" + kMend;
}

bool has_skin_outside_atlas(const Scene& scene) {
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes) {
            if (!is_skin(object, submesh)) continue;
            for (uint32_t i = 0; i < submesh.index_count; ++i) {
                const Vec2 uv = atlas_uvs_of(object.mesh)[object.mesh.indices[submesh.first_index + i]];
                if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return true;
            }
        }
    return false;
}

}  // namespace dermis::inline render
