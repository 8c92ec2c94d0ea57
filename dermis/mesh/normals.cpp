// For every position: the corners there are joined across edges that are not creases; each set of joined
// corners gets the angle-weighted sum of its faces' normals.

#include "dermis/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/mesh/topology.h"
#include "shaders/include/posing.h"

namespace dermis::inline mesh {
namespace {

// Unit, in double: the cross product of short edges underflows in float for micrometre meshes.
Vec3 unit_face_normal(Vec3 p0, Vec3 p1, Vec3 p2) {
    const double ax = double(p1.x) - p0.x, ay = double(p1.y) - p0.y, az = double(p1.z) - p0.z;
    const double bx = double(p2.x) - p0.x, by = double(p2.y) - p0.y, bz = double(p2.z) - p0.z;
    const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    const double l = std::sqrt(x * x + y * y + z * z);
    return l > 0 && std::isfinite(l) ? Vec3{float(x / l), float(y / l), float(z / l)} : Vec3{};
}

struct TriangleSpans {
    std::span<const Vec3> positions_mm;
    std::span<const uint32_t> indices;
};

std::vector<Vec3> unit_face_normals(const TriangleSpans& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.indices.size() / 3);
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        normals.push_back(unit_face_normal(mesh.positions_mm[mesh.indices[i]],
                                           mesh.positions_mm[mesh.indices[i + 1]],
                                           mesh.positions_mm[mesh.indices[i + 2]]));
    return normals;
}

// Joins the corners around one position that share an edge and whose faces meet at less than the crease
// angle. Without `face_normals` no edge is a crease.
void join_across_edges(std::span<const uint32_t> corners, std::span<const uint32_t> positions,
                       std::span<const Vec3> face_normals, float cos_crease, DisjointSets& sets,
                       std::vector<Spoke>& spokes) {
    collect_spokes(corners, positions, spokes);
    sets.reset(corners.size());
    for (size_t i = 1; i < spokes.size(); ++i) {
        if (spokes[i].far_end != spokes[i - 1].far_end) continue;
        if (!face_normals.empty()) {
            const Vec3 a = face_normals[corners[spokes[i - 1].local] / 3],
                       b = face_normals[corners[spokes[i].local] / 3];
            const bool degenerate = a == Vec3{} || b == Vec3{};
            if (!degenerate && dot(a, b) < cos_crease) continue;
        }
        sets.join(spokes[i - 1].local, spokes[i].local);
    }
}

JoinedCorners join_at_creases(Weld weld, std::span<const uint32_t> indices,
                              std::span<const Vec3> face_normals, float cos_crease) {
    const std::vector<uint32_t> positions = welded_indices(indices, weld);
    JoinedCorners joined{.table = CornerTable(positions, weld.count()), .leaders = {}};
    joined.leaders.reserve(indices.size());
    DisjointSets sets(0);
    std::vector<Spoke> spokes;
    for (uint32_t position = 0; position < weld.count(); ++position) {
        const auto corners = joined.table.corners(position);
        join_across_edges(corners, positions, face_normals, cos_crease, sets, spokes);
        for (uint32_t i = 0; i < corners.size(); ++i) joined.leaders.push_back(sets.find(i));
    }
    joined.weld = std::move(weld);
    return joined;
}

// Where it does, each face keeps its own normal.
bool cancels(Vec3 sum) {
    return length(sum) < posing::kShortestNormalSum;
}

// Sums over each set of joined corners.
void sum_corners(const TriangleSpans& mesh, std::span<const Vec3> face_normals,
                 std::span<const uint32_t> corners, std::span<const uint32_t> leaders,
                 std::vector<Vec3>& sums, std::span<Vec3> normals) {
    sums.assign(corners.size(), Vec3{});
    for (uint32_t i = 0; i < corners.size(); ++i)
        sums[leaders[i]] +=
            corner_angle_rad(mesh.positions_mm, mesh.indices, corners[i]) * face_normals[corners[i] / 3];
    for (uint32_t i = 0; i < corners.size(); ++i) {
        const Vec3 sum = sums[leaders[i]];
        normals[corners[i]] = cancels(sum) ? face_normals[corners[i] / 3] : normalize(sum);
    }
}

bool is_usable(Vec3 n) {
    const float squared = dot(n, n);
    return std::isfinite(squared) && squared > posing::kLeastNormalSquared;
}

struct CornerNormals {
    std::vector<Vec3> normal;     // of every corner
    std::vector<uint32_t> group;  // of every corner: the lowest corner it is joined with
};

CornerNormals corner_normals(const Mesh& mesh, const NormalOptions& options) {
    const TriangleSpans triangles = {mesh.positions_mm, mesh.indices};
    const std::vector<Vec3> face_normals = unit_face_normals(triangles);
    // At 180 degrees rounding must not make a crease of a fold.
    const bool creases = options.crease_angle_deg < 180;
    const JoinedCorners joined =
        join_at_creases(weld_positions(mesh.positions_mm), mesh.indices,
                        creases ? std::span(face_normals) : std::span<const Vec3>(),
                        std::cos(options.crease_angle_deg * std::numbers::pi_v<float> / 180));
    CornerNormals result{std::vector<Vec3>(mesh.indices.size()), std::vector<uint32_t>(mesh.indices.size())};
    std::vector<Vec3> sums;
    for (uint32_t position = 0; position < joined.weld.count(); ++position) {
        const auto corners = joined.table.corners(position), leaders = joined.leaders_around(position);
        sum_corners(triangles, face_normals, corners, leaders, sums, result.normal);
        for (uint32_t i = 0; i < corners.size(); ++i)
            result.group[corners[i]] = corners[cancels(sums[leaders[i]]) ? i : leaders[i]];
    }
    return result;
}

}  // namespace

void compute_normals(Mesh& mesh, const NormalOptions& options) {
    mesh.normals.clear();
    mesh.tangents.clear();
    mesh.curvatures_per_mm.clear();
    const CornerNormals corners = corner_normals(mesh, options);
    split_vertices(mesh, corners.group);
    mesh.normals.assign(mesh.positions_mm.size(), Vec3{0, 1, 0});
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
        if (is_usable(corners.normal[corner])) mesh.normals[mesh.indices[corner]] = corners.normal[corner];
}

JoinedCorners join_corners(Weld weld, std::span<const uint32_t> indices) {
    return join_at_creases(std::move(weld), indices, {}, 0);
}

// Work on triangles and corners is split into blocks of this many.
constexpr size_t kBlock = 4096;

std::vector<Vec3> SmoothNormals::of_vertices(std::span<const Vec3> positions_mm, Weld weld,
                                             std::span<const uint8_t> wanted) {
    if (!joined_ || joined_->weld.ids != weld.ids) joined_ = join_corners(std::move(weld), indices_);
    const TriangleSpans mesh = {positions_mm, indices_};
    const std::vector<uint32_t>& places = joined_->weld.ids;
    std::vector<uint8_t> is_wanted(joined_->weld.count(), wanted.empty());
    for (size_t v = 0; v < wanted.size(); ++v) is_wanted[places[v]] |= wanted[v];
    std::vector<Vec3> face_normals(indices_.size() / 3), corner_normals(indices_.size());
    parallel_for(face_normals.size(), kBlock, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t* v = &indices_[3 * i];
            if (is_wanted[places[v[0]]] | is_wanted[places[v[1]]] | is_wanted[places[v[2]]])
                face_normals[i] =
                    unit_face_normal(positions_mm[v[0]], positions_mm[v[1]], positions_mm[v[2]]);
        }
    });
    parallel_for(is_wanted.size(), kBlock, [&](size_t begin, size_t end) {
        std::vector<Vec3> sums;
        for (auto position = uint32_t(begin); position < end; ++position)
            if (is_wanted[position])
                sum_corners(mesh, face_normals, joined_->table.corners(position),
                            joined_->leaders_around(position), sums, corner_normals);
    });
    std::vector<Vec3> normals(positions_mm.size());
    for (size_t corner = 0; corner < indices_.size(); ++corner) {
        Vec3& n = normals[indices_[corner]];
        if (n == Vec3{} && is_usable(corner_normals[corner])) n = corner_normals[corner];
    }
    for (size_t v = 0; v < normals.size(); ++v)
        if (normals[v] == Vec3{} && is_wanted[places[v]]) normals[v] = {0, 1, 0};
    return normals;
}

void complete_normals(Mesh& mesh, SmoothNormals* smooth) {
    mesh.normals.resize(mesh.positions_mm.size());
    std::vector<uint8_t> missing;
    for (const Vec3 n : mesh.normals) missing.push_back(!is_usable(n));
    std::vector<Vec3> computed;
    if (std::ranges::find(missing, 1) != missing.end()) {
        SmoothNormals fresh(mesh.indices);
        computed = (smooth ? *smooth : fresh)
                       .of_vertices(mesh.positions_mm, weld_positions(mesh.positions_mm), missing);
    }
    for (size_t v = 0; v < missing.size(); ++v)
        mesh.normals[v] = missing[v] ? computed[v] : normalize(mesh.normals[v]);
}

double fraction_facing_backwards(const Mesh& mesh) {
    const std::vector<Vec3> faces = unit_face_normals({mesh.positions_mm, mesh.indices});
    size_t backwards = 0;
    for (size_t i = 0; i < faces.size(); ++i) {
        Vec3 sum;
        for (size_t k = 0; k < 3; ++k) sum += mesh.normals[mesh.indices[3 * i + k]];
        backwards += dot(sum, faces[i]) < 0;
    }
    return faces.empty() ? 0 : double(backwards) / double(faces.size());
}

}  // namespace dermis::inline mesh
