// A vertex in 36 bytes:
//
//     position   3 x u16 over the mesh's box, and the occlusion as a fourth
//     normal     3 x s16, and the sign of the bitangent
//     tangent    4 x s8 (the fourth is not used)
//     uv         2 x u16 over their range
//     curvature  4 x f16: along the tangent, along the bitangent, mixed, 0
//     occlusion  4 x u8: its three blurs, 0

#include "dermis/engines/web/parts.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/half.h"
#include "dermis/mesh/simplify.h"
#include "dermis/render/complete_scene.h"

namespace dermis::inline engines::web {
namespace {

struct Range {
    float low = 0, size = 1;
};

template <class T, class Value>
Range range_of(const std::vector<T>& all, Value value_of) {
    if (all.empty()) return {};
    float low = value_of(all.front()), high = low;
    for (const T& one : all) low = std::min(low, value_of(one)), high = std::max(high, value_of(one));
    return {low, std::max(high - low, 1e-6f)};
}

uint16_t unsigned_16(float value) {
    return uint16_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535));
}
int16_t signed_16(float value) {
    return int16_t(std::lround(std::clamp(value, -1.0f, 1.0f) * 32767));
}
int8_t signed_8(float value) {
    return int8_t(std::lround(std::clamp(value, -1.0f, 1.0f) * 127));
}
uint8_t unsigned_8(float value) {
    return uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
}

// Any unit vector across n.
Vec3 across(Vec3 n) {
    return normalize(cross(std::abs(n.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n));
}

struct Packer {
    const Mesh& mesh;
    std::vector<Vec3> blurred_occlusions;
    std::array<Range, 3> box;
    std::array<Range, 2> uv_range;

    void put(Binary& binary, uint32_t v) const {
        const Vec3 p = mesh.positions_mm[v];
        binary.put(unsigned_16((p.x - box[0].low) / box[0].size));
        binary.put(unsigned_16((p.y - box[1].low) / box[1].size));
        binary.put(unsigned_16((p.z - box[2].low) / box[2].size));
        binary.put(unsigned_16(mesh.occlusions.empty() ? 1.0f : mesh.occlusions[v]));
        const Vec3 n = mesh.normals[v];
        const bool has_tangent = !mesh.tangents.empty();
        const Vec4 given = has_tangent ? mesh.tangents[v] : Vec4{0, 0, 0, 1};
        Vec3 t = {given.x, given.y, given.z};
        t = t - n * dot(n, t);
        t = length(t) > 1e-3f ? normalize(t) : across(n);
        for (const float c : {n.x, n.y, n.z, given.w < 0 ? -1.0f : 1.0f}) binary.put(signed_16(c));
        for (const float c : {t.x, t.y, t.z, 0.0f}) binary.put(signed_8(c));
        const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[v];
        binary.put(unsigned_16((uv.x - uv_range[0].low) / uv_range[0].size));
        binary.put(unsigned_16((uv.y - uv_range[1].low) / uv_range[1].size));
        put_curvature(binary, v, n, t);
        const Vec3 blurred = blurred_occlusions[v];
        for (const float c : {blurred.x, blurred.y, blurred.z, 0.0f}) binary.put(unsigned_8(c));
    }

    // S n = 0: three numbers in the tangent plane are all of the tensor.
    void put_curvature(Binary& binary, uint32_t v, Vec3 n, Vec3 t) const {
        const CurvatureTensor s =
            mesh.curvatures_per_mm.empty() ? CurvatureTensor{} : mesh.curvatures_per_mm[v];
        const Vec3 b = cross(n, t);
        for (const float c : {dot(t, s * t), dot(b, s * b), dot(t, s * b), 0.0f}) binary.put(to_half(c));
    }
};

nlohmann::json ranges(std::span<const Range> all) {
    nlohmann::json low = nlohmann::json::array(), size = nlohmann::json::array();
    for (const Range& range : all) low.push_back(to_json(range.low)), size.push_back(to_json(range.size));
    return {{"low", low}, {"size", size}};
}

}  // namespace

Mesh with_tangents(Mesh mesh) {
    if (mesh.tangents.empty())
        for (const Vec3& n : mesh.normals) {
            const Vec3 t = across(n);
            mesh.tangents.push_back({t.x, t.y, t.z, 1});
        }
    return mesh;
}

Result<MeshOnPage> add_mesh(Binary& binary, const Mesh& mesh, size_t triangle_count) {
    DERMIS_TRY_ASSIGN(std::vector<Vec3> blurred, blurred_occlusions(mesh));
    const Packer packer = {.mesh = mesh,
                           .blurred_occlusions = std::move(blurred),
                           .box = {range_of(mesh.positions_mm, [](Vec3 p) { return p.x; }),
                                   range_of(mesh.positions_mm, [](Vec3 p) { return p.y; }),
                                   range_of(mesh.positions_mm, [](Vec3 p) { return p.z; })},
                           .uv_range = {range_of(mesh.uvs, [](Vec2 uv) { return uv.x; }),
                                        range_of(mesh.uvs, [](Vec2 uv) { return uv.y; })}};
    const SimplifiedTriangles triangles = simplify(mesh, triangle_count);
    // Vertices in the order in which the triangles use them, which the GPU's cache likes too.
    std::vector<uint32_t> number(mesh.positions_mm.size(), kNotOnPage), used;
    for (const uint32_t v : triangles.indices)
        if (number[v] == kNotOnPage) {
            number[v] = uint32_t(used.size());
            used.push_back(v);
        }
    nlohmann::json made;
    made["vertices"] = {{"offset", binary.begin_block()}, {"count", used.size()}};
    for (const uint32_t v : used) packer.put(binary, v);
    const bool wide = used.size() > 65535;
    made["indices"] = {
        {"offset", binary.begin_block()}, {"count", triangles.indices.size()}, {"bytes", wide ? 4 : 2}};
    for (const uint32_t v : triangles.indices) {
        if (wide)
            binary.put(number[v]);
        else
            binary.put(uint16_t(number[v]));
    }
    made["position_mm"] = ranges(packer.box);
    made["uv"] = ranges(packer.uv_range);
    made["parts"] = nlohmann::json::array();
    for (const Submesh& submesh : triangles.submeshes)
        made["parts"].push_back({{"first", submesh.first_index}, {"count", submesh.index_count}});
    return MeshOnPage{std::move(made), std::move(number)};
}

}  // namespace dermis::inline engines::web
