// 1. Vertices equal in position, normal and UV are one. 2. Around each, the corners of triangles with the
// same UV handedness are joined across edges. 3. Each set sums the projected u directions of its
// triangles. 4. Vertices whose corners ended in different sets are split.

#include "dermis/mesh/tangents.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

enum class Handedness : uint8_t { none, kept, mirrored };

// The texture's axes on a triangle. `u_direction` is along dP/du, of any length.
struct FaceFrame {
    Vec3 u_direction;
    Handedness handedness = Handedness::none;
};

// dP/du from P(u, v) linear over the triangle; v is taken upwards, the convention of MikkTSpace.
FaceFrame face_frame(const Mesh& mesh, size_t first) {
    const auto p = [&](size_t k) { return mesh.positions_mm[mesh.indices[first + k]]; };
    const auto uv = [&](size_t k) { return mesh.uvs[mesh.indices[first + k]]; };
    const double u1 = double(uv(1).x) - uv(0).x, v1 = double(uv(0).y) - uv(1).y;
    const double u2 = double(uv(2).x) - uv(0).x, v2 = double(uv(0).y) - uv(2).y;
    const double area = u1 * v2 - u2 * v1;  // signed, twice
    const Vec3 d1 = p(1) - p(0), d2 = p(2) - p(0);
    if (area == 0 || !std::isfinite(area) || length(cross(normalize(d1), normalize(d2))) == 0) return {};
    // Scaled by its largest part, so that the smallest and the largest UV steps stay within a float's range.
    const double largest = std::max(std::abs(v1), std::abs(v2));
    if (largest == 0) return {};
    const double side = area > 0 ? 1 : -1;
    const Vec3 u_direction = normalize(d1 * float(side * v2 / largest) - d2 * float(side * v1 / largest));
    if (u_direction == Vec3{}) return {};
    return {u_direction, area > 0 ? Handedness::kept : Handedness::mirrored};
}

Vec3 project_to_plane(Vec3 direction, Vec3 n) {
    return normalize(direction - n * dot(n, direction));
}

Vec3 any_perpendicular(Vec3 n) {
    // The axis least along the normal.
    const Vec3 axis = std::abs(n.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 t = project_to_plane(axis, n);
    return t == Vec3{} ? Vec3{1, 0, 0} : t;
}

Weld weld_vertices(const Mesh& mesh) {
    std::vector<uint32_t> words;
    words.reserve(mesh.positions_mm.size() * 8);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 p = mesh.positions_mm[i], n = mesh.normals[i];
        const Vec2 uv = mesh.uvs[i];
        for (const float value : {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}) words.push_back(weld_key(value));
    }
    return weld_records(words, 8);
}

class TangentBuilder {
  public:
    // `given`: empty, or one a vertex, zero where there is none.
    TangentBuilder(Mesh& mesh, std::vector<Vec4> given)
        : mesh_(mesh), weld_(weld_vertices(mesh)), given_(std::move(given)) {
        vertices_ = welded_indices(mesh.indices, weld_);
        for (size_t i = 0; i < mesh.indices.size(); i += 3) frames_.push_back(face_frame(mesh, i));
    }

    void run() {
        const CornerTable table(vertices_, weld_.count());
        group_of_corner_.resize(mesh_.indices.size());
        tangent_of_corner_.resize(mesh_.indices.size());
        for (uint32_t vertex = 0; vertex < weld_.count(); ++vertex) build_around(table.corners(vertex));
        if (!given_.empty()) keep_given();
        split_vertices(mesh_, group_of_corner_);
        mesh_.tangents.assign(mesh_.positions_mm.size(), Vec4{1, 0, 0, 1});
        for (size_t corner = 0; corner < mesh_.indices.size(); ++corner)
            mesh_.tangents[mesh_.indices[corner]] = tangent_of_corner_[corner];
    }

  private:
    // Joins corners that share an edge; those without a frame of their own join whatever side reaches them
    // first, those of different handedness never.
    void join(std::span<const uint32_t> corners) {
        collect_spokes(corners, vertices_, spokes_);
        sets_.reset(corners.size());
        side_.resize(corners.size());
        for (uint32_t i = 0; i < corners.size(); ++i) side_[i] = frames_[corners[i] / 3].handedness;
        // First triangles with frames, then those without, which could otherwise bridge two sides.
        for (const bool with_frames : {true, false})
            for (size_t i = 1; i < spokes_.size(); ++i)
                if (spokes_[i].far_end == spokes_[i - 1].far_end)
                    try_join(spokes_[i - 1].local, spokes_[i].local, with_frames);
    }

    void try_join(uint32_t a, uint32_t b, bool with_frames) {
        a = sets_.find(a), b = sets_.find(b);
        if (a == b) return;
        const bool both = side_[a] != Handedness::none && side_[b] != Handedness::none;
        if (with_frames != both || (both && side_[a] != side_[b])) return;
        const Handedness side = side_[a] != Handedness::none ? side_[a] : side_[b];
        sets_.join(a, b);
        side_[sets_.find(a)] = side;
    }

    void build_around(std::span<const uint32_t> corners) {
        if (corners.empty()) return;
        join(corners);
        const Vec3 n = mesh_.normals[mesh_.indices[corners[0]]];
        sums_.assign(corners.size(), Vec3{});
        for (uint32_t i = 0; i < corners.size(); ++i) {
            const FaceFrame& frame = frames_[corners[i] / 3];
            if (frame.handedness != Handedness::none)
                sums_[sets_.find(i)] +=
                    projected_angle(corners[i], n) * project_to_plane(frame.u_direction, n);
        }
        const std::optional<uint32_t> widest = widest_set(corners.size());
        for (uint32_t i = 0; i < corners.size(); ++i) {
            uint32_t set = sets_.find(i);
            // A triangle without a frame that no neighbour reached takes the one its vertex has anyway.
            if (side_[set] == Handedness::none && widest) set = *widest;
            const Vec3 t = length(sums_[set]) > 1e-6f ? normalize(sums_[set]) : any_perpendicular(n);
            group_of_corner_[corners[i]] = corners[set];
            tangent_of_corner_[corners[i]] = {t.x, t.y, t.z,
                                              side_[set] == Handedness::mirrored ? -1.0f : 1.0f};
        }
    }

    // The corners of a vertex with a tangent stay together.
    void keep_given() {
        for (size_t corner = 0; corner < mesh_.indices.size(); ++corner) {
            const Vec4 t = given_[mesh_.indices[corner]];
            if (t.w == 0) continue;
            group_of_corner_[corner] = ~0u;
            tangent_of_corner_[corner] = t;
        }
    }

    std::optional<uint32_t> widest_set(size_t count) {
        std::optional<uint32_t> widest;
        for (uint32_t i = 0; i < count; ++i)
            if (sets_.find(i) == i && side_[i] != Handedness::none &&
                (!widest || length(sums_[i]) > length(sums_[*widest])))
                widest = i;
        return widest;
    }

    // The corner's angle, of its edges projected into the normal's plane.
    float projected_angle(uint32_t corner, Vec3 n) const {
        const Vec3 p = mesh_.positions_mm[mesh_.indices[corner]];
        const Vec3 a =
            project_to_plane(normalize(mesh_.positions_mm[mesh_.indices[next_corner(corner)]] - p), n);
        const Vec3 b =
            project_to_plane(normalize(mesh_.positions_mm[mesh_.indices[previous_corner(corner)]] - p), n);
        return std::atan2(length(cross(a, b)), dot(a, b));
    }

    Mesh& mesh_;
    Weld weld_;
    std::vector<Vec4> given_;
    std::vector<uint32_t> vertices_;  // welded, of every corner
    std::vector<FaceFrame> frames_;
    std::vector<uint32_t> group_of_corner_;
    std::vector<Vec4> tangent_of_corner_;
    DisjointSets sets_{0};
    std::vector<Handedness> side_;  // of every set's leader
    std::vector<Spoke> spokes_;
    std::vector<Vec3> sums_;
};

}  // namespace

void compute_tangents(Mesh& mesh) {
    mesh.tangents.assign(mesh.positions_mm.size(), Vec4{0, 0, 0, 0});
    complete_tangents(mesh);
}

void complete_tangents(Mesh& mesh) {
    mesh.tangents.resize(mesh.positions_mm.size(), Vec4{0, 0, 0, 0});
    size_t missing = 0;
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        const Vec4 given = mesh.tangents[i];
        const Vec3 t = project_to_plane(normalize({given.x, given.y, given.z}), mesh.normals[i]);
        const bool usable = std::abs(length(t) - 1) < 1e-3f;
        missing += !usable;
        mesh.tangents[i] = usable ? Vec4{t.x, t.y, t.z, given.w < 0 ? -1.0f : 1.0f} : Vec4{0, 0, 0, 0};
    }
    if (missing == 0) return;
    if (!mesh.uvs.empty()) return TangentBuilder(mesh, std::exchange(mesh.tangents, {})).run();
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        if (mesh.tangents[i].w != 0) continue;
        const Vec3 t = any_perpendicular(mesh.normals[i]);
        mesh.tangents[i] = {t.x, t.y, t.z, 1};
    }
}

}  // namespace dermis::inline mesh
