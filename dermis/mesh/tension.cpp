#include "dermis/mesh/tension.h"

#include <algorithm>
#include <cmath>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

// Twice the areas, as only ratios count.
std::vector<float> areas_around(std::span<const uint32_t> place, size_t places,
                                std::span<const Vec3> positions_mm, std::span<const uint32_t> indices) {
    std::vector<float> areas(places);
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vec3 a = positions_mm[indices[i]];
        const float area = length(cross(positions_mm[indices[i + 1]] - a, positions_mm[indices[i + 2]] - a));
        for (size_t k = 0; k < 3; ++k) areas[place[indices[i + k]]] += area;
    }
    return areas;
}

// 0 for a vertex whose triangles have no area at rest.
float tension_of(float area, float at_rest) {
    if (!(at_rest > 0)) return 0;
    return std::clamp(std::log(area / at_rest), -kMostTension, kMostTension);
}

}  // namespace

RestAreas rest_areas(std::span<const Vec3> rest_positions_mm, std::span<const uint32_t> indices) {
    Weld weld = weld_positions(rest_positions_mm);
    std::vector<float> areas = areas_around(weld.ids, weld.count(), rest_positions_mm, indices);
    return {.place = std::move(weld.ids), .areas = std::move(areas)};
}

std::vector<float> compute_tensions(const RestAreas& rest, std::span<const Vec3> positions_mm,
                                    std::span<const uint32_t> indices) {
    std::vector<float> of_places = areas_around(rest.place, rest.areas.size(), positions_mm, indices);
    for (size_t i = 0; i < of_places.size(); ++i) of_places[i] = tension_of(of_places[i], rest.areas[i]);
    std::vector<float> tensions;
    tensions.reserve(rest.place.size());
    for (const uint32_t place : rest.place) tensions.push_back(of_places[place]);
    return tensions;
}

}  // namespace dermis::inline mesh
