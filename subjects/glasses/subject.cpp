// A pair of glasses that casts coloured shadows: an opaque frame and tinted lenses, fitted to builtin:bust
// (mm, origin between the ears); for other heads the scene's keys move it. Each lens is a single surface, so
// that light is tinted once; its UVs run over 0..1.
//
// Rims, bridge and temples are tubes swept along curves, the lenses surfaces stretched over the rims' curve.
// All of it lies on one gently curved front, which wraps back towards the temples and leans in below.

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/tangents.h"
#include "dermis/scene/subject.h"

namespace dermis {
namespace {

constexpr int kRimSteps = 64, kTubeSides = 10, kLensRings = 8, kTintSide = 64;
constexpr Vec2 kLensCenterMm = {36, 20}, kLensHalfMm = {26, 21};
constexpr float kRimRadiusMm = 1.9f, kTempleRadiusMm = 1.7f;

float power(float x, float exponent) {
    return std::copysign(std::pow(std::abs(x), exponent), x);
}

// A superellipse (Lamé 1818) of exponent 2.6: between an oval and a box, as lenses are.
Vec2 outline(float angle_rad) {
    constexpr float kExponent = 2 / 2.6f;
    return {kLensHalfMm.x * power(std::cos(angle_rad), kExponent),
            kLensHalfMm.y * power(std::sin(angle_rad), kExponent)};
}

Vec3 on_front(Vec2 p) {
    constexpr float kWrapPerMm = 0.0026f, kLean = 0.14f;
    return {p.x, p.y, 114 - kWrapPerMm * p.x * p.x + kLean * (p.y - kLensCenterMm.y)};
}

// Quads between the rings of a tube; `closed` joins its ends, open ends get caps.
void add_tube(Mesh& mesh, const std::vector<Vec3>& path, float radius_mm, bool closed) {
    const auto count = uint32_t(path.size());
    const auto first = uint32_t(mesh.positions_mm.size());
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 before = path[i > 0 ? i - 1 : closed ? count - 1 : 0];
        const Vec3 after = path[i + 1 < count ? i + 1 : closed ? 0 : count - 1];
        const Vec3 along = normalize(after - before);
        const Vec3 side = normalize(cross(std::abs(along.z) < 0.9f ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, along));
        const Vec3 over = cross(along, side);
        for (int k = 0; k < kTubeSides; ++k) {
            const float a = 2 * kPi * float(k) / kTubeSides;
            mesh.positions_mm.push_back(path[i] + (side * std::cos(a) + over * std::sin(a)) * radius_mm);
            mesh.uvs.push_back({float(i) / float(count), float(k) / kTubeSides});
        }
    }
    for (uint32_t i = 0; i + (closed ? 0 : 1) < count; ++i)
        for (uint32_t k = 0; k < kTubeSides; ++k) {
            const uint32_t next = (i + 1) % count, turn = (k + 1) % kTubeSides;
            const uint32_t a = first + i * kTubeSides + k, b = first + i * kTubeSides + turn,
                           c = first + next * kTubeSides + turn, d = first + next * kTubeSides + k;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    if (closed) return;
    for (uint32_t k = 1; k + 1 < kTubeSides; ++k) {
        const uint32_t last = first + (count - 1) * kTubeSides;
        mesh.indices.insert(mesh.indices.end(),
                            {first, first + k + 1, first + k, last, last + k, last + k + 1});
    }
}

// `side` is -1 or 1.
void add_half_frame(Mesh& mesh, float side) {
    std::vector<Vec3> rim;
    for (int i = 0; i < kRimSteps; ++i) {
        const Vec2 p = outline(2 * kPi * float(i) / kRimSteps);
        rim.push_back(on_front({side * (kLensCenterMm.x + p.x), kLensCenterMm.y + p.y}));
    }
    add_tube(mesh, rim, kRimRadiusMm, true);
    // Hinge, then back to the top of the ear and down behind it.
    const Vec3 hinge = on_front({side * (kLensCenterMm.x + kLensHalfMm.x), 30});
    const Vec3 corners[] = {hinge,
                            {side * 70, 31, hinge.z - 4},
                            {side * 76, 32, 60},
                            {side * 81.5f, 33, 20},
                            {side * 82, 31, 2},
                            {side * 81, 22, -9},
                            {side * 79.5f, 10, -15}};
    std::vector<Vec3> temple;
    for (size_t i = 0; i + 1 < std::size(corners); ++i)
        for (int k = 0; k < 6; ++k)
            temple.push_back(corners[i] + (corners[i + 1] - corners[i]) * (float(k) / 6));
    temple.push_back(corners[std::size(corners) - 1]);
    add_tube(mesh, temple, kTempleRadiusMm, false);
}

void add_bridge(Mesh& mesh) {
    const float inner_mm = kLensCenterMm.x - kLensHalfMm.x;
    std::vector<Vec3> bridge;
    for (int i = 0; i <= 12; ++i) {
        const float t = float(i) / 6 - 1;
        Vec3 p = on_front({t * (inner_mm + 0.5f), 27 + 5 * (1 - t * t)});
        p.z += 2 * (1 - t * t);
        bridge.push_back(p);
    }
    add_tube(mesh, bridge, kRimRadiusMm, false);
}

void add_lens(Mesh& mesh, float side) {
    const auto first = uint32_t(mesh.positions_mm.size());
    const auto add = [&](Vec2 p) {
        mesh.positions_mm.push_back(on_front({side * (kLensCenterMm.x + p.x), kLensCenterMm.y + p.y}));
        mesh.uvs.push_back({0.5f + 0.5f * p.x / kLensHalfMm.x, 0.5f - 0.5f * p.y / kLensHalfMm.y});
    };
    add({});
    for (int ring = 1; ring <= kLensRings; ++ring)
        for (int i = 0; i < kRimSteps; ++i)
            add(outline(2 * kPi * float(i) / kRimSteps) * (float(ring) / kLensRings));
    const auto corner = [&](int ring, int i) {
        return ring == 0 ? first : first + 1 + uint32_t((ring - 1) * kRimSteps + i % kRimSteps);
    };
    const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
        if (side < 0) std::swap(b, c);
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (int ring = 0; ring < kLensRings; ++ring)
        for (int i = 0; i < kRimSteps; ++i) {
            face(corner(ring, i), corner(ring + 1, i), corner(ring + 1, i + 1));
            if (ring > 0) face(corner(ring, i), corner(ring + 1, i + 1), corner(ring, i + 1));
        }
}

// Transmittance, sRGB codes: dark violet at the brow, nearly clear at the cheek.
ImageSource lens_tint() {
    constexpr float kTop[3] = {118, 62, 140}, kBottom[3] = {238, 205, 240};
    std::vector<std::byte> pixels;
    for (int y = 0; y < kTintSide; ++y)
        for (int x = 0; x < kTintSide; ++x)
            for (int c = 0; c < 3; ++c) {
                const float t = std::clamp(1.6f * float(y) / (kTintSide - 1) - 0.3f, 0.0f, 1.0f);
                pixels.push_back(std::byte(std::lround(kTop[c] + (kBottom[c] - kTop[c]) * t)));
            }
    return {.name = "builtin:glasses tint",
            .width = kTintSide,
            .height = kTintSide,
            .channels = 3,
            .pixels = std::move(pixels)};
}

Result<SubjectScene> make(const ParameterValues&) {
    SceneObject object{.name = "glasses", .classes = {MaterialClass::other, MaterialClass::translucent}};
    Mesh& mesh = object.mesh;
    for (const float side : {-1.0f, 1.0f}) add_half_frame(mesh, side);
    add_bridge(mesh);
    const auto frame_indices = uint32_t(mesh.indices.size());
    for (const float side : {-1.0f, 1.0f}) add_lens(mesh, side);
    mesh.submeshes = {{.name = "frame", .first_index = 0, .index_count = frame_indices, .material = 0},
                      {.name = "lens",
                       .first_index = frame_indices,
                       .index_count = uint32_t(mesh.indices.size()) - frame_indices,
                       .material = 1}};
    compute_normals(mesh);
    compute_tangents(mesh);
    Material frame{.name = "frame", .base_color_linear = {0.012f, 0.010f, 0.010f}, .roughness = 0.25f};
    Material lens{.name = "lens", .base_color_linear = {0, 0, 0}, .opacity = 0, .roughness = 0.06f};
    lens.alpha_mode = AlphaMode::blend;
    lens.double_sided = true;
    lens.opacity_map = lens_tint();
    mesh.materials = {std::move(frame), std::move(lens)};
    SubjectScene scene;
    scene.objects.push_back(std::move(object));
    return scene;
}

}  // namespace

Subject make_glasses_subject() {
    return {
        .name = "glasses", .summary = "an opaque frame with tinted lenses, for builtin:bust", .make = make};
}

}  // namespace dermis
