#include "dermis/scene/object_checks.h"

#include <algorithm>
#include <array>

#include "dermis/mesh/topology.h"
#include "dermis/scene/toml_values.h"

namespace dermis::inline scene {
namespace {

void warn_of_materials(const SceneObject& object, std::vector<std::string>& warnings) {
    for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
        const Material& material = object.mesh.materials[i];
        const bool has_alpha = material.alpha_mode == AlphaMode::mask || is_blended(material);
        if (object.classes[i] == MaterialClass::skin && has_alpha)
            warnings.push_back("material '" + material.name +
                               "' is skin, of which alpha cuts nothing out and shows nothing behind it; "
                               "class = \"other\" under [material." +
                               toml_string(material.name) + "] of a scene file takes it into account");
    }
}

// How much of the skin that is double-sided lies in open sheets, 0 to 1: the area of each connected part as
// seen from where it is largest, 0 for a closed body and 1 for a flat sheet.
double open_share(const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    const Weld weld = weld_positions(mesh.positions_mm);
    DisjointSets parts(weld.count());
    std::vector<Vec3> facing(weld.count());
    double area = 0;
    const auto each = [&](const auto& visit) {
        for (const Submesh& submesh : mesh.submeshes)
            if (mesh.materials[submesh.material].double_sided &&
                object.classes[submesh.material] == MaterialClass::skin)
                for (uint32_t i = 0; i + 2 < submesh.index_count; i += 3)
                    visit(&mesh.indices[submesh.first_index + i]);
    };
    each([&](const uint32_t* corner) {
        parts.join(weld.ids[corner[0]], weld.ids[corner[1]]);
        parts.join(weld.ids[corner[0]], weld.ids[corner[2]]);
    });
    each([&](const uint32_t* corner) {
        const Vec3 a = mesh.positions_mm[corner[0]];
        const Vec3 twice = cross(mesh.positions_mm[corner[1]] - a, mesh.positions_mm[corner[2]] - a);
        facing[parts.find(weld.ids[corner[0]])] += twice;
        area += double(length(twice));
    });
    double open = 0;
    for (const Vec3& sum : facing) open += double(length(sum));
    return area > 0 ? open / area : 0;
}

// Skin has an inside; light on its back is not drawn.
void warn_of_back(const SceneObject& object, std::vector<std::string>& warnings) {
    constexpr double kSheet = 0.6;  // of half a sphere: 0.5
    if (open_share(object) > kSheet)
        warnings.push_back(
            "'" + object.name +
            "' has double-sided sheets that are skin, which is black from behind; class = \"other\" "
            "under [material.NAME] of a scene file lights both sides");
}

struct Side {
    Vec3 direction;
    const char* name;
    const char* rotate_deg;
};
constexpr std::array<Side, 5> kWrongSides = {{{{0, 0, -1}, "-Z", "[0, 180, 0]"},
                                              {{1, 0, 0}, "+X", "[0, -90, 0]"},
                                              {{-1, 0, 0}, "-X", "[0, 90, 0]"},
                                              {{0, -1, 0}, "-Y", "[-90, 0, 0]"},
                                              {{0, 1, 0}, "+Y", "[90, 0, 0]"}}};

// A head has its detail in the face: of the heads at hand twice as many triangles point to the front as to
// the back, and 1.4 times as many as to a side. Objects of few triangles are not heads.
void warn_of_direction(const SceneObject& object, std::vector<std::string>& warnings) {
    constexpr size_t kFewest = 2000;
    constexpr double kRatio = 1.5;
    const Mesh& mesh = object.mesh;
    if (mesh.triangle_count() < kFewest || mesh.normals.empty()) return;
    const auto count = [&](Vec3 direction) {
        size_t found = 0;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const Vec3 n = mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] +
                           mesh.normals[mesh.indices[i + 2]];
            found += dot(n, direction) > 0.5f * length(n);
        }
        return double(found);
    };
    const double front = count({0, 0, 1});
    const Side* most = nullptr;
    double highest = kRatio * front;
    for (const Side& side : kWrongSides)
        if (const double found = count(side.direction); found > highest) most = &side, highest = found;
    if (!most) return;
    warnings.push_back("'" + object.name + "' has most of its detail on its " + most->name +
                       " side; a head faces +Z, with Y up. If this one does not, turn it: rotate_deg = " +
                       most->rotate_deg + " under [[mesh]] of a scene file");
}

}  // namespace

bool is_card(const Mesh& mesh, const Material& material) {
    const auto whole = [](const Material& other) { return cutoff_of_map(other) == 0; };
    return !whole(material) && std::ranges::any_of(mesh.materials, whole);
}

std::vector<std::string> object_warnings(const SceneObject& object) {
    std::vector<std::string> warnings;
    warn_of_materials(object, warnings);
    warn_of_direction(object, warnings);
    warn_of_back(object, warnings);
    return warnings;
}

}  // namespace dermis::inline scene
