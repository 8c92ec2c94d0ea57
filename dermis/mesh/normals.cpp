// For every position: the corners there are joined across edges that are not creases; each set of joined
// corners gets the angle-weighted sum of its faces' normals.

#include "dermis/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

struct CornerNormals {
    std::vector<Vec3> normal;     // of every corner
    std::vector<uint32_t> group;  // of every corner: the lowest corner it is joined with
};

// Unit, in double: the cross product of short edges underflows in float for micrometre meshes.
Vec3 unit_face_normal(Vec3 p0, Vec3 p1, Vec3 p2) {
    const double ax = double(p1.x) - p0.x, ay = double(p1.y) - p0.y, az = double(p1.z) - p0.z;
    const double bx = double(p2.x) - p0.x, by = double(p2.y) - p0.y, bz = double(p2.z) - p0.z;
    const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    const double l = std::sqrt(x * x + y * y + z * z);
    return l > 0 && std::isfinite(l) ? Vec3{float(x / l), float(y / l), float(z / l)} : Vec3{};
}

std::vector<Vec3> unit_face_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.triangle_count());
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        normals.push_back(unit_face_normal(mesh.positions_mm[mesh.indices[i]],
                                           mesh.positions_mm[mesh.indices[i + 1]],
                                           mesh.positions_mm[mesh.indices[i + 2]]));
    return normals;
}

// Joins the corners around one position that share an edge and whose faces meet at less than the crease
// angle.
void join_across_edges(std::span<const uint32_t> corners, std::span<const uint32_t> positions,
                       std::span<const Vec3> face_normals, float cos_crease, DisjointSets& sets,
                       std::vector<Spoke>& spokes) {
    collect_spokes(corners, positions, spokes);
    sets.reset(corners.size());
    for (size_t i = 1; i < spokes.size(); ++i) {
        if (spokes[i].far_end != spokes[i - 1].far_end) continue;
        const Vec3 a = face_normals[corners[spokes[i - 1].local] / 3],
                   b = face_normals[corners[spokes[i].local] / 3];
        const bool degenerate = a == Vec3{} || b == Vec3{};
        if (degenerate || dot(a, b) >= cos_crease) sets.join(spokes[i - 1].local, spokes[i].local);
    }
}

CornerNormals corner_normals(const Mesh& mesh, const NormalOptions& options) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const std::vector<uint32_t> positions = welded_indices(mesh.indices, weld);
    const CornerTable table(positions, weld.count());
    const std::vector<Vec3> face_normals = unit_face_normals(mesh);
    // At 180 degrees rounding must not make a crease of a fold.
    const float cos_crease = options.crease_angle_deg >= 180
                                 ? -2.0f
                                 : std::cos(options.crease_angle_deg * std::numbers::pi_v<float> / 180);
    CornerNormals result{std::vector<Vec3>(mesh.indices.size()), std::vector<uint32_t>(mesh.indices.size())};
    DisjointSets sets(0);
    std::vector<Spoke> spokes;
    std::vector<Vec3> sums;
    for (uint32_t position = 0; position < weld.count(); ++position) {
        const auto corners = table.corners(position);
        join_across_edges(corners, positions, face_normals, cos_crease, sets, spokes);
        sums.assign(corners.size(), Vec3{});
        for (uint32_t i = 0; i < corners.size(); ++i)
            sums[sets.find(i)] += corner_angle_rad(mesh, corners[i]) * face_normals[corners[i] / 3];
        for (uint32_t i = 0; i < corners.size(); ++i) {
            const uint32_t leader = sets.find(i);
            const bool cancelled = length(sums[leader]) < 1e-4f;
            result.group[corners[i]] = corners[cancelled ? i : leader];
            result.normal[corners[i]] = cancelled ? face_normals[corners[i] / 3] : normalize(sums[leader]);
        }
    }
    return result;
}

bool is_usable(Vec3 n) {
    const float squared = dot(n, n);
    return std::isfinite(squared) && squared > 1e-12f;
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

void complete_normals(Mesh& mesh) {
    mesh.normals.resize(mesh.positions_mm.size());
    const bool complete = std::ranges::all_of(mesh.normals, is_usable);
    std::vector<Vec3> computed;
    if (!complete) computed = corner_normals(mesh, {}).normal;
    for (Vec3& n : mesh.normals) n = is_usable(n) ? normalize(n) : Vec3{};
    for (size_t corner = 0; corner < computed.size(); ++corner) {
        Vec3& n = mesh.normals[mesh.indices[corner]];
        if (!is_usable(n)) n = computed[corner];
    }
    for (Vec3& n : mesh.normals)
        if (!is_usable(n)) n = {0, 1, 0};
}

double fraction_facing_backwards(const Mesh& mesh) {
    const std::vector<Vec3> faces = unit_face_normals(mesh);
    size_t backwards = 0;
    for (size_t i = 0; i < faces.size(); ++i) {
        Vec3 sum;
        for (size_t k = 0; k < 3; ++k) sum += mesh.normals[mesh.indices[3 * i + k]];
        backwards += dot(sum, faces[i]) < 0;
    }
    return faces.empty() ? 0 : double(backwards) / double(faces.size());
}

}  // namespace dermis::inline mesh
