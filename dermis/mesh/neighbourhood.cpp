#include "dermis/mesh/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

namespace dermis::inline mesh {
namespace {

constexpr size_t kMaxNeighbours = 1500;

void add_edges(WeldedSurface& surface, std::span<const uint32_t> positions) {
    const size_t count = surface.positions_mm.size();
    const CornerTable table(positions, count);
    std::vector<uint32_t> ring;
    for (uint32_t i = 0; i < count; ++i) {
        surface.first.push_back(uint32_t(surface.neighbours.size()));
        ring.clear();
        for (const uint32_t corner : table.corners(i))
            for (const uint32_t other : {positions[next_corner(corner)], positions[previous_corner(corner)]})
                if (other != i) ring.push_back(other);
        std::ranges::sort(ring);
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        surface.neighbours.insert(surface.neighbours.end(), ring.begin(), ring.end());
    }
    surface.first.push_back(uint32_t(surface.neighbours.size()));
}

}  // namespace

WeldedSurface::WeldedSurface(const Mesh& mesh, const Weld& weld)
    : normals(weld.count()), areas_mm2(weld.count()) {
    for (const uint32_t vertex : weld.first) positions_mm.push_back(mesh.positions_mm[vertex]);
    for (size_t i = 0; i < mesh.normals.size(); ++i) normals[weld.ids[i]] += mesh.normals[i];
    for (Vec3& n : normals) n = normalize(n);
    const std::vector<uint32_t> corners = welded_indices(mesh.indices, weld);
    for (size_t i = 0; i < corners.size(); i += 3) {
        const Vec3 a = positions_mm[corners[i]];
        const float area =
            length(cross(positions_mm[corners[i + 1]] - a, positions_mm[corners[i + 2]] - a)) / 6;
        for (size_t k = 0; k < 3; ++k) areas_mm2[corners[i + k]] += area;
    }
    add_edges(*this, corners);
}

FitFrame::FitFrame(const WeldedSurface& surface, uint32_t centre, std::span<const Neighbour> neighbours,
                   double sigma)
    : origin_mm(surface.positions_mm[centre]), n(surface.normals[centre]), sigma_mm(sigma) {
    x_axis = normalize(cross(std::abs(n.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n));
    y_axis = cross(n, x_axis);
    for (const Neighbour& other : neighbours)
        scale_mm = std::max(scale_mm, double(length(surface.positions_mm[other.position] - origin_mm)));
}

double FitFrame::weight(const WeldedSurface& surface, const Neighbour& neighbour) const {
    const double t = neighbour.distance_mm / (sigma_mm > 0 ? sigma_mm : 0.7 * scale_mm);
    return std::exp(-t * t / 2) * (sigma_mm > 0 ? surface.areas_mm2[neighbour.position] : 1);
}

Neighbourhood NeighbourWalker::around(uint32_t centre, double smoothing_mm) {
    constexpr size_t kFewest = 12;
    if (smoothing_mm > 0)
        if (const auto found = within(centre, float(2 * smoothing_mm)); found.size() >= kFewest)
            return {found, smoothing_mm};
    return {rings(centre, 2), 0};
}

std::span<const Neighbour> NeighbourWalker::rings(uint32_t centre, int count) {
    start(centre);
    size_t begin = 0;
    for (int ring = 0; ring < count; ++ring) {
        const size_t end = found_.size();
        for (size_t i = begin; i < end && found_.size() < kMaxNeighbours; ++i)
            for (const uint32_t next : surface_.around(found_[i].position))
                if (visit(centre, next))
                    found_.push_back(
                        {next, length(surface_.positions_mm[next] - surface_.positions_mm[centre])});
        begin = end;
    }
    return found_;
}

// Dijkstra over edges up to the radius.
std::span<const Neighbour> NeighbourWalker::within(uint32_t centre, float radius_mm) {
    start(centre);
    found_.clear();
    std::priority_queue<std::pair<float, uint32_t>, std::vector<std::pair<float, uint32_t>>, std::greater<>>
        open;
    open.push({0, centre});
    ++generation_;
    while (!open.empty() && found_.size() < kMaxNeighbours) {
        const auto [distance, at] = open.top();
        open.pop();
        if (mark_[at] == generation_) continue;
        mark_[at] = generation_;
        if (!same_side(centre, at)) continue;
        found_.push_back({at, distance});
        for (const uint32_t next : surface_.around(at)) {
            const float there = distance + length(surface_.positions_mm[next] - surface_.positions_mm[at]);
            if (there <= radius_mm && mark_[next] != generation_) open.push({there, next});
        }
    }
    return found_;
}

void NeighbourWalker::start(uint32_t centre) {
    ++generation_;
    mark_[centre] = generation_;
    found_ = {{centre, 0}};
}

// Behind a fold the surface is not a height field over this plane.
bool NeighbourWalker::same_side(uint32_t centre, uint32_t at) const {
    return at == centre || dot(surface_.normals[centre], surface_.normals[at]) > 0;
}

bool NeighbourWalker::visit(uint32_t centre, uint32_t at) {
    if (mark_[at] == generation_) return false;
    mark_[at] = generation_;
    return same_side(centre, at);
}

}  // namespace dermis::inline mesh
