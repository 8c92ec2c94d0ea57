#include "dermis/scene/corneas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "dermis/base/hash.h"
#include "dermis/mesh/topology.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/mesh/uv_texels.h"
#include "dermis/scene/part_words.h"

namespace dermis::inline scene {
namespace {

constexpr int kMapTexels = 512;
constexpr double kMostOverlap = 0.01;

using Members = std::vector<uint32_t>;  // first corners of triangles

struct Sphere {
    Vec3 center_mm;
    float radius_mm = 0;
    // Over the sphere, as a share of its radius.
    [[nodiscard]] float excess(Vec3 p_mm) const { return length(p_mm - center_mm) / radius_mm - 1; }
};

// Least squares for |p|^2 = 2 c.p + r^2 - |c|^2; none where the points do not span space.
std::optional<Sphere> fit_sphere(const std::vector<Vec3>& points_mm) {
    double rows[4][5] = {};
    for (const Vec3 p : points_mm) {
        const double row[5] = {2 * double(p.x), 2 * double(p.y), 2 * double(p.z), 1, double(dot(p, p))};
        for (size_t i = 0; i < 4; ++i)
            for (size_t k = 0; k < 5; ++k) rows[i][k] += row[i] * row[k];
    }
    for (size_t i = 0; i < 4; ++i) {
        size_t pivot = i;
        for (size_t k = i + 1; k < 4; ++k)
            if (std::abs(rows[k][i]) > std::abs(rows[pivot][i])) pivot = k;
        std::swap(rows[i], rows[pivot]);
        if (!(std::abs(rows[i][i]) > 1e-9)) return std::nullopt;
        for (size_t k = 0; k < 4; ++k) {
            if (k == i) continue;
            const double factor = rows[k][i] / rows[i][i];
            for (size_t c = i; c < 5; ++c) rows[k][c] -= factor * rows[i][c];
        }
    }
    double x[4];
    for (size_t i = 0; i < 4; ++i) x[i] = rows[i][4] / rows[i][i];
    const double squared = x[3] + x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    if (!(squared > 0)) return std::nullopt;
    return Sphere{{float(x[0]), float(x[1]), float(x[2])}, float(std::sqrt(squared))};
}

// Fits the sclera: each round leaves out the points that are off the previous round's sphere.
std::optional<Sphere> eyeball_of(const std::vector<Vec3>& points_mm) {
    constexpr int kRounds = 6;
    constexpr float kOff = 0.02f;
    constexpr size_t kFewest = 16;
    std::vector<Vec3> near = points_mm;
    std::optional<Sphere> sphere;
    for (int round = 0; round < kRounds && near.size() >= kFewest; ++round) {
        sphere = fit_sphere(near);
        if (!sphere) return std::nullopt;
        near.clear();
        for (const Vec3 p : points_mm)
            if (std::abs(sphere->excess(p)) < kOff) near.push_back(p);
    }
    return near.size() >= kFewest ? sphere : std::nullopt;
}

struct Cornea {
    Vec3 center_mm, axis;
    float angle_rad = 0;  // from the axis to the border
    // From the axis over the border's angle.
    [[nodiscard]] float angle_share(Vec3 p_mm) const {
        return std::acos(std::clamp(dot(normalize(p_mm - center_mm), axis), -1.0f, 1.0f)) / angle_rad;
    }
};

// A human cornea is about 12 mm wide and rises 1.3 mm over an eyeball of radius 12 mm: 30 degrees, 0.1.
std::optional<Cornea> cornea_of(const Sphere& eyeball, const std::vector<Vec3>& points_mm) {
    constexpr float kLeastBulge = 0.03f, kMostBulge = 0.4f, kPole = 0.5f;
    constexpr float kLeastAngle_rad = 0.15f, kMostAngle_rad = 0.75f;
    float most = 0;
    for (const Vec3 p : points_mm) most = std::max(most, eyeball.excess(p));
    if (most < kLeastBulge || most > kMostBulge) return std::nullopt;
    Vec3 sum;
    for (const Vec3 p : points_mm)
        if (eyeball.excess(p) > kPole * most) sum += normalize(p - eyeball.center_mm) * eyeball.excess(p);
    if (!(length(sum) > 0)) return std::nullopt;
    Cornea cornea{eyeball.center_mm, normalize(sum), 1};
    cornea.angle_rad = kMostAngle_rad;
    for (const Vec3 p : points_mm)
        if (eyeball.excess(p) <= 0)
            cornea.angle_rad = std::min(cornea.angle_rad, cornea.angle_share(p) * cornea.angle_rad);
    const bool is_in_range = cornea.angle_rad > kLeastAngle_rad && cornea.angle_rad < kMostAngle_rad;
    return is_in_range ? std::optional(cornea) : std::nullopt;
}

std::vector<Members> pieces_of(const Mesh& mesh, const Weld& weld, uint32_t material) {
    DisjointSets sets(weld.count());
    const auto each = [&](auto visit) {
        for (const Submesh& submesh : mesh.submeshes)
            if (submesh.material == material)
                for (uint32_t i = 0; i < submesh.index_count; i += 3) visit(submesh.first_index + i);
    };
    each([&](uint32_t corner) {
        for (uint32_t k = 1; k < 3; ++k)
            sets.join(weld.ids[mesh.indices[corner]], weld.ids[mesh.indices[corner + k]]);
    });
    std::map<uint32_t, Members> by_leader;
    each([&](uint32_t corner) { by_leader[sets.find(weld.ids[mesh.indices[corner]])].push_back(corner); });
    std::vector<Members> pieces;
    for (auto& [leader, members] : by_leader) pieces.push_back(std::move(members));
    return pieces;
}

std::vector<Vec3> points_of(const Mesh& mesh, const Members& members) {
    std::vector<uint32_t> vertices;
    for (const uint32_t corner : members)
        for (uint32_t k = 0; k < 3; ++k) vertices.push_back(mesh.indices[corner + k]);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Vec3> points;
    for (const uint32_t vertex : vertices) points.push_back(mesh.positions_mm[vertex]);
    return points;
}

bool encloses_iris(const Mesh& mesh, const Sphere& eyeball) {
    for (const Submesh& submesh : mesh.submeshes) {
        if (!names_iris(mesh.materials[submesh.material].name)) continue;
        for (uint32_t i = 0; i < submesh.index_count; ++i)
            if (eyeball.excess(mesh.positions_mm[mesh.indices[submesh.first_index + i]]) < 0) return true;
    }
    return false;
}

// Alpha over the UVs: a ramp across the border, so that the cut is smooth between texels.
void draw_cornea(const Mesh& mesh, const Members& members, const Cornea& cornea,
                 std::vector<std::byte>& pixels) {
    constexpr float kRamp = 4;
    for (const uint32_t corner : members) {
        std::array<std::array<double, 2>, 3> texels;
        std::array<Vec3, 3> p;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.indices[corner + k];
            p[k] = mesh.positions_mm[vertex];
            texels[k] = {double(mesh.uvs[vertex].x) * kMapTexels, double(mesh.uvs[vertex].y) * kMapTexels};
        }
        visit_texels_of(texels, {kMapTexels, kMapTexels}, [&](int x, int y, double v, double w) {
            const Vec3 at = p[0] + (p[1] - p[0]) * float(v) + (p[2] - p[0]) * float(w);
            const float alpha = std::clamp(0.5f + kRamp * (cornea.angle_share(at) - 1), 0.0f, 1.0f);
            pixels[size_t(y) * kMapTexels + size_t(x)] = std::byte(std::lround(255 * alpha));
        });
    }
}

bool may_cover_iris(const Mesh& mesh, const FoundPart& found, uint32_t number) {
    const Material& material = mesh.materials[number];
    return found.part == HeadPart::eye && !found.left_out && !names_iris(material.name) &&
           material.alpha_mode == AlphaMode::opaque && !material.base_color_map.present() &&
           analyze_uvs(mesh, number, kMapTexels).overlap <= kMostOverlap;
}

}  // namespace

void cut_out_corneas(Mesh& mesh, std::vector<FoundPart>& parts) {
    if (mesh.uvs.size() != mesh.positions_mm.size()) return;
    if (std::ranges::none_of(mesh.materials, [](const Material& m) { return names_iris(m.name); })) return;
    const Weld weld = weld_positions(mesh.positions_mm);
    for (uint32_t number = 0; number < mesh.materials.size(); ++number) {
        if (!may_cover_iris(mesh, parts[number], number)) continue;
        std::vector<std::byte> pixels(size_t(kMapTexels) * kMapTexels, std::byte(255));
        bool has_cornea = false;
        for (const Members& piece : pieces_of(mesh, weld, number)) {
            const std::vector<Vec3> points = points_of(mesh, piece);
            const std::optional<Sphere> eyeball = eyeball_of(points);
            if (!eyeball || !encloses_iris(mesh, *eyeball)) continue;
            const std::optional<Cornea> cornea = cornea_of(*eyeball, points);
            if (!cornea) continue;
            draw_cornea(mesh, piece, *cornea, pixels);
            has_cornea = true;
        }
        if (!has_cornea) continue;
        Material& material = mesh.materials[number];
        material.alpha_mode = AlphaMode::mask;
        material.alpha_map = {.name = "cornea-" + Hasher().add(pixels).hex(),
                              .encoded = {},
                              .width = kMapTexels,
                              .height = kMapTexels,
                              .channels = 1,
                              .pixels = std::move(pixels),
                              .named_by = {}};
        parts[number].reason += "; its cornea would cover the iris and is left out";
    }
}

}  // namespace dermis::inline scene
