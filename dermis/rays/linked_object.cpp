#include "dermis/rays/linked_object.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dermis/rays/uv_raster.h"

namespace dermis::inline rays {
namespace {

constexpr float kFarSpacingMm = 2;  // side of a cell

// A point of the triangle of a corner, with density falling from the corner to nothing at its edge: Dirichlet
// (2, 1, 1), by gamma variates.
std::array<float, 3> weights_near(uint32_t corner, Pcg32& random) {
    const auto exponential = [&] { return -std::log(std::max(1 - random.next_1d(), 1e-7f)); };
    const float own = exponential() + exponential(), b = exponential(), c = exponential();
    const float per_sum = 1 / (own + b + c);
    std::array<float, 3> weights;
    weights[corner % 3] = own * per_sum;
    weights[(corner + 1) % 3] = b * per_sum;
    weights[(corner + 2) % 3] = c * per_sum;
    return weights;
}

}  // namespace

LinkedObject linked_object(const SceneObject& object, const Flesh& flesh, uint32_t first_vertex) {
    const Mesh& mesh = object.mesh;
    LinkedObject made{.mesh = &mesh,
                      .first_vertex = first_vertex,
                      .weld = weld_positions(mesh.positions_mm),
                      .first_corner = {},
                      .corners = {}};
    const std::vector<bool> walked = walked_triangles(object, flesh);
    std::vector<uint32_t>& first = made.first_corner;
    first.resize(made.weld.count() + 1);
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
        if (walked[corner / 3]) ++first[made.weld.ids[mesh.indices[corner]] + 1];
    for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    made.corners.resize(first.back());
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
        if (walked[corner / 3]) made.corners[next[made.weld.ids[mesh.indices[corner]]]++] = uint32_t(corner);
    return made;
}

std::pair<const Mesh*, uint32_t> vertex_of(std::span<const LinkedObject> objects, uint32_t vertex) {
    size_t i = objects.size() - 1;
    while (vertex < objects[i].first_vertex) --i;
    return {objects[i].mesh, vertex - objects[i].first_vertex};
}

Vec3 place_mm(std::span<const LinkedObject> objects, uint32_t vertex) {
    const auto [mesh, v] = vertex_of(objects, vertex);
    return mesh->positions_mm[v];
}

std::vector<std::pair<uint32_t, float>> shares_around(const LinkedObject& object, uint32_t position) {
    const Mesh& mesh = *object.mesh;
    std::vector<std::pair<uint32_t, float>> shares;
    float area = 0;
    for (const uint32_t corner : object.around(position)) {
        const uint32_t t = corner / 3;
        const float own = triangle_area_mm2(mesh, t);
        area += own;
        for (const uint32_t k : {1u, 2u}) {
            const uint32_t beside = object.weld.ids[mesh.indices[3 * t + (corner + k) % 3]];
            const auto known = std::ranges::find(shares, beside, &std::pair<uint32_t, float>::first);
            if (known == shares.end())
                shares.emplace_back(beside, own / 2);
            else
                known->second += own / 2;
        }
    }
    for (auto& [beside, share] : shares) share /= area;
    return shares;
}

std::vector<uint32_t> coarse_vertices(std::span<const LinkedObject> objects, uint32_t vertices) {
    struct Cell {
        Vec3 sum_mm;
        float count = 0;
        uint32_t middle = 0;
        float off_mm = std::numeric_limits<float>::max();
    };
    std::map<std::array<int, 4>, Cell> cells;
    std::vector<Cell*> of_vertices(vertices);
    for (const LinkedObject& object : objects)
        for (uint32_t v = 0; v < object.mesh->positions_mm.size(); ++v) {
            const Vec3 p_mm = object.mesh->positions_mm[v], n = object.mesh->normals[v];
            const auto along = [](float x_mm) { return int(std::floor(x_mm / kFarSpacingMm)); };
            const int octant = int(n.x > 0) | int(n.y > 0) << 1 | int(n.z > 0) << 2;
            Cell& cell = cells[{along(p_mm.x), along(p_mm.y), along(p_mm.z), octant}];
            cell.sum_mm += p_mm, ++cell.count;
            of_vertices[object.first_vertex + v] = &cell;
        }
    for (uint32_t v = 0; v < vertices; ++v) {
        Cell& cell = *of_vertices[v];
        const float off_mm = length(place_mm(objects, v) - cell.sum_mm * (1 / cell.count));
        if (off_mm < cell.off_mm) cell.off_mm = off_mm, cell.middle = v;
    }
    std::vector<uint32_t> coarse(vertices);
    for (uint32_t v = 0; v < vertices; ++v) coarse[v] = of_vertices[v]->middle;
    return coarse;
}

Star::Star(const LinkedObject& object, uint32_t position)
    : mesh_(*object.mesh), corners_(object.around(position)) {
    for (const uint32_t corner : corners_)
        sums_mm2_.push_back(area_mm2_ += triangle_area_mm2(mesh_, corner / 3));
}

LinkStart Star::draw(float u, Pcg32& random) const {
    const auto found = std::ranges::upper_bound(sums_mm2_, u * area_mm2_) - sums_mm2_.begin();
    const uint32_t corner = corners_[std::min(size_t(found), corners_.size() - 1)], triangle = corner / 3;
    const auto [a, b, c] = corners_mm(mesh_, triangle);
    const auto w = weights_near(corner, random);
    return {triangle, w, a * w[0] + b * w[1] + c * w[2], face_normal(mesh_, triangle)};
}

}  // namespace dermis::inline rays
