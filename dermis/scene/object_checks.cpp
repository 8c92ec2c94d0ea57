#include "dermis/scene/object_checks.h"

#include <algorithm>
#include <array>

#include "dermis/scene/toml_values.h"

namespace dermis {
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

struct Side {
    Vec3 direction;
    const char* name;
    const char* mend;  // rotate_deg
};
constexpr std::array<Side, 5> kWrongSides = {{{{0, 0, -1}, "-Z", "[0, 180, 0]"},
                                              {{1, 0, 0}, "+X", "[0, -90, 0]"},
                                              {{-1, 0, 0}, "-X", "[0, 90, 0]"},
                                              {{0, -1, 0}, "-Y", "[-90, 0, 0]"},
                                              {{0, 1, 0}, "+Y", "[90, 0, 0]"}}};

// A head has its detail in the face: of the heads at hand twice as many triangles point to the front as to
// the back, and 1.4 times as many as to a side. Objects of few triangles are no heads.
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
                       most->mend + " under [[mesh]] of a scene file");
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
    return warnings;
}

}  // namespace dermis
