// Garland, Heckbert 1997: a vertex carries the sum of the squared distances to the planes of the triangles
// that it has replaced, as a quadratic form. A collapse u -> v costs the sum of both forms at v.

#include "dermis/mesh/simplify.h"

#include <algorithm>
#include <queue>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

// x^T A x + 2 b.x + c, weighted by area.
struct Quadric {
    double xx = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0, bx = 0, by = 0, bz = 0, c = 0;

    void add_plane(Vec3 n, double d, double weight) {
        const double x = n.x, y = n.y, z = n.z;
        xx += weight * x * x, yy += weight * y * y, zz += weight * z * z;
        yz += weight * y * z, xz += weight * x * z, xy += weight * x * y;
        bx += weight * d * x, by += weight * d * y, bz += weight * d * z, c += weight * d * d;
    }
    void add(const Quadric& q) {
        xx += q.xx, yy += q.yy, zz += q.zz, yz += q.yz, xz += q.xz, xy += q.xy;
        bx += q.bx, by += q.by, bz += q.bz, c += q.c;
    }
    [[nodiscard]] double at(Vec3 p) const {
        const double x = p.x, y = p.y, z = p.z;
        return xx * x * x + yy * y * y + zz * z * z + 2 * (yz * y * z + xz * x * z + xy * x * y) +
               2 * (bx * x + by * y + bz * z) + c;
    }
};

// `u` becomes `v`. Stale when one of them has changed since.
struct Collapse {
    double cost;
    uint32_t u, v, u_version, v_version;
    bool operator>(const Collapse& other) const {
        return cost != other.cost ? cost > other.cost : u != other.u ? u > other.u : v > other.v;
    }
};

double uv_area(Vec2 a, Vec2 b, Vec2 c) {
    const Vec2 ab = b - a, ac = c - a;
    return double(ab.x) * ac.y - double(ab.y) * ac.x;
}

class Simplifier {
  public:
    explicit Simplifier(const Mesh& mesh)
        : mesh_(mesh),
          indices_(mesh.indices),
          triangles_of_(mesh.positions_mm.size()),
          quadrics_(mesh.positions_mm.size()),
          versions_(mesh.positions_mm.size(), 0),
          locked_(mesh.positions_mm.size(), false) {
        for (uint32_t i = 0; i < indices_.size(); ++i) triangles_of_[indices_[i]].push_back(i / 3);
        lock_between_submeshes();
        lock_borders();
        for (uint32_t t = 0; t < mesh.triangle_count(); ++t) add_triangle_quadric(t);
    }

    SimplifiedTriangles run(size_t wanted) {
        alive_.assign(mesh_.triangle_count(), true);
        size_t count = mesh_.triangle_count();
        for (uint32_t v = 0; v < triangles_of_.size(); ++v) push_around(v);
        while (count > wanted && !queue_.empty()) {
            const Collapse next = queue_.top();
            queue_.pop();
            if (versions_[next.u] != next.u_version || versions_[next.v] != next.v_version) continue;
            if (!allowed(next.u, next.v)) continue;
            count -= collapse(next.u, next.v);
        }
        return result();
    }

  private:
    [[nodiscard]] Vec3 position(uint32_t v) const { return mesh_.positions_mm[v]; }

    void lock_between_submeshes() {
        std::vector<uint32_t> submesh_of(locked_.size(), ~0u);
        for (uint32_t s = 0; s < mesh_.submeshes.size(); ++s) {
            const Submesh& submesh = mesh_.submeshes[s];
            for (uint32_t i = 0; i < submesh.index_count; ++i) {
                const uint32_t v = indices_[submesh.first_index + i];
                if (submesh_of[v] != ~0u && submesh_of[v] != s) locked_[v] = true;
                submesh_of[v] = s;
            }
        }
    }

    // An edge that is not of exactly two triangles; at a UV seam the triangles' vertices differ.
    void lock_borders() {
        std::vector<uint32_t> ends;
        for (uint32_t v = 0; v < triangles_of_.size(); ++v) {
            ends.clear();
            for (const uint32_t t : triangles_of_[v])
                for (uint32_t k = 0; k < 3; ++k)
                    if (indices_[3 * t + k] != v) ends.push_back(indices_[3 * t + k]);
            std::ranges::sort(ends);
            for (const uint32_t end : ends)
                if (std::ranges::count(ends, end) != 2) locked_[v] = true;
        }
    }

    void add_triangle_quadric(uint32_t t) {
        const Vec3 a = position(indices_[3 * t]);
        const Vec3 normal = cross(position(indices_[3 * t + 1]) - a, position(indices_[3 * t + 2]) - a);
        const float twice_area = length(normal);
        if (twice_area == 0) return;
        const Vec3 n = normal * (1 / twice_area);
        for (uint32_t k = 0; k < 3; ++k)
            quadrics_[indices_[3 * t + k]].add_plane(n, -double(dot(n, a)), twice_area);
    }

    [[nodiscard]] std::vector<uint32_t> neighbours(uint32_t v) const {
        std::vector<uint32_t> all;
        for (const uint32_t t : triangles_of_[v])
            for (uint32_t k = 0; k < 3; ++k)
                if (indices_[3 * t + k] != v) all.push_back(indices_[3 * t + k]);
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

    // Where the shape is flat, short edges go first, so that triangles stay alike.
    void push(uint32_t u, uint32_t v) {
        if (locked_[u]) return;
        const Vec3 way = position(v) - position(u);
        Quadric sum = quadrics_[u];
        sum.add(quadrics_[v]);
        const double squared = dot(way, way);
        queue_.push({std::max(sum.at(position(v)), 0.0) + 1e-3 * squared * squared, u, v, versions_[u],
                     versions_[v]});
    }
    void push_around(uint32_t v) {
        for (const uint32_t other : neighbours(v)) {
            push(v, other);
            push(other, v);
        }
    }

    [[nodiscard]] bool turns_over(uint32_t t, uint32_t u, uint32_t v) const {
        uint32_t before[3], after[3];
        for (uint32_t k = 0; k < 3; ++k) {
            before[k] = indices_[3 * t + k];
            after[k] = before[k] == u ? v : before[k];
        }
        const auto normal = [&](const uint32_t* i) {
            return normalize(cross(position(i[1]) - position(i[0]), position(i[2]) - position(i[0])));
        };
        if (dot(normal(before), normal(after)) < 0.5f) return true;
        if (mesh_.uvs.empty()) return false;
        const auto area = [&](const uint32_t* i) {
            return uv_area(mesh_.uvs[i[0]], mesh_.uvs[i[1]], mesh_.uvs[i[2]]);
        };
        return area(before) * area(after) <= 0;
    }

    // The two ends share exactly the two vertices opposite to their edge, else a fin would be left.
    [[nodiscard]] bool allowed(uint32_t u, uint32_t v) const {
        const std::vector<uint32_t> of_u = neighbours(u), of_v = neighbours(v);
        std::vector<uint32_t> both;
        std::ranges::set_intersection(of_u, of_v, std::back_inserter(both));
        if (both.size() != 2 || !std::ranges::binary_search(of_u, v)) return false;
        return std::ranges::none_of(triangles_of_[u],
                                    [&](uint32_t t) { return !has_vertex(t, v) && turns_over(t, u, v); });
    }

    [[nodiscard]] bool has_vertex(uint32_t t, uint32_t v) const {
        return indices_[3 * t] == v || indices_[3 * t + 1] == v || indices_[3 * t + 2] == v;
    }

    size_t collapse(uint32_t u, uint32_t v) {
        size_t removed = 0;
        for (const uint32_t t : triangles_of_[u]) {
            if (has_vertex(t, v)) {
                alive_[t] = false;
                ++removed;
                for (uint32_t k = 0; k < 3; ++k)
                    if (indices_[3 * t + k] != u) std::erase(triangles_of_[indices_[3 * t + k]], t);
                continue;
            }
            for (uint32_t k = 0; k < 3; ++k)
                if (indices_[3 * t + k] == u) indices_[3 * t + k] = v;
            triangles_of_[v].push_back(t);
        }
        triangles_of_[u].clear();
        quadrics_[v].add(quadrics_[u]);
        ++versions_[u];
        ++versions_[v];
        push_around(v);
        return removed;
    }

    [[nodiscard]] SimplifiedTriangles result() const {
        SimplifiedTriangles made;
        for (Submesh submesh : mesh_.submeshes) {
            const uint32_t first = submesh.first_index / 3, count = submesh.index_count / 3;
            submesh.first_index = uint32_t(made.indices.size());
            for (uint32_t t = first; t < first + count; ++t)
                if (alive_[t])
                    made.indices.insert(made.indices.end(), indices_.begin() + 3 * t,
                                        indices_.begin() + 3 * t + 3);
            submesh.index_count = uint32_t(made.indices.size()) - submesh.first_index;
            made.submeshes.push_back(std::move(submesh));
        }
        return made;
    }

    const Mesh& mesh_;
    std::vector<uint32_t> indices_;
    std::vector<std::vector<uint32_t>> triangles_of_;
    std::vector<Quadric> quadrics_;
    std::vector<uint32_t> versions_;
    std::vector<bool> locked_, alive_;
    std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> queue_;
};

}  // namespace

SimplifiedTriangles simplify(const Mesh& mesh, size_t triangle_count) {
    if (mesh.triangle_count() <= triangle_count) return {mesh.indices, mesh.submeshes};
    return Simplifier(mesh).run(triangle_count);
}

}  // namespace dermis::inline mesh
