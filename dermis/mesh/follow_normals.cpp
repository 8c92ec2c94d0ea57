#include "dermis/mesh/follow_normals.h"

#include "dermis/mesh/normals.h"

namespace dermis::inline mesh {
namespace {

// The computed normal of every vertex.
std::vector<Vec3> computed_normals(std::span<const Vec3> positions_mm, const Mesh& mesh) {
    Mesh bare;
    bare.positions_mm.assign(positions_mm.begin(), positions_mm.end());
    bare.indices = mesh.indices;
    complete_normals(bare);
    return bare.normals;
}

// The smallest rotation from one unit vector to another (Moller and Hughes 1999, "Efficiently Building a
// Matrix to Rotate One Vector to Another").
struct Turn {
    Vec3 axis;
    float cosine;

    Turn(Vec3 from, Vec3 to) : axis(cross(from, to)), cosine(dot(from, to)) {}
    [[nodiscard]] Vec3 operator()(Vec3 v) const {
        return cosine * v + cross(axis, v) + dot(axis, v) / (1 + cosine) * axis;
    }
};

}  // namespace

void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh) {
    constexpr float kOpposite = -0.999f;  // no smallest rotation: such a vertex keeps its normal
    const std::vector<Vec3> before = computed_normals(before_mm, mesh),
                            after = computed_normals(mesh.positions_mm, mesh);
    for (size_t i = 0; i < before.size(); ++i) {
        const Turn turn(before[i], after[i]);
        if (before[i] == after[i] || turn.cosine < kOpposite) continue;
        mesh.normals[i] = turn(mesh.normals[i]);
        Vec4& t = mesh.tangents[i];
        const Vec3 turned = turn(Vec3{t.x, t.y, t.z});
        t = {turned.x, turned.y, turned.z, t.w};
    }
}

}  // namespace dermis::inline mesh
