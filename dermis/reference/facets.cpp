#include "dermis/reference/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace dermis::inline reference {
namespace {

constexpr double kLargestFacetAngleDeg = 5;

struct AngleSum {
    double area_mm2 = 0, squares = 0;
};

void add_triangle(const Mesh& mesh, size_t first, AngleSum& sum) {
    const uint32_t* corners = &mesh.indices[first];
    const Vec3 p = mesh.positions_mm[corners[0]];
    const Vec3 normal = cross(mesh.positions_mm[corners[1]] - p, mesh.positions_mm[corners[2]] - p);
    const double twice_area = length(normal);
    if (twice_area == 0) return;
    for (int i = 0; i < 3; ++i) {
        const double cosine = double(dot(normal, mesh.normals[corners[i]])) / twice_area;
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        sum.squares += twice_area / 6 * angle * angle;
    }
    sum.area_mm2 += twice_area / 2;
}

}  // namespace

double facet_angle_deg(const Scene& scene) {
    AngleSum sum;
    for (const SceneObject& object : scene.objects) {
        if (object.mesh.normals.empty()) continue;
        for (const Submesh& part : object.mesh.submeshes) {
            if (object.classes[part.material] != MaterialClass::skin) continue;
            for (uint32_t i = 0; i < part.index_count; i += 3)
                add_triangle(object.mesh, part.first_index + i, sum);
        }
    }
    return sum.area_mm2 > 0 ? std::sqrt(sum.squares / sum.area_mm2) * 180 / std::numbers::pi : 0;
}

std::string facets_note(const Scene& scene) {
    const double angle_deg = facet_angle_deg(scene);
    if (angle_deg <= kLargestFacetAngleDeg) return "";
    const int levels = int(std::ceil(std::log2(angle_deg / kLargestFacetAngleDeg)));
    return fmt::format(
        "the mesh is coarse: walks see the edges between its triangles, whose planes differ from the skin's "
        "normals by {:.0f} degrees; --scene mesh.subdivision={} refines it",
        angle_deg, std::clamp(levels, 1, 4));
}

}  // namespace dermis::inline reference
