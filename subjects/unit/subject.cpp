// Scenes that test one property of a technique each, most of them with an exact answer: they explain a
// technique's captured share. `dermis compare unit` runs them all.

#include <array>
#include <cmath>
#include <limits>

#include "dermis/base/angle.h"
#include "dermis/mesh/primitives.h"
#include "dermis/scene/subject.h"
#include "subjects/unit/exact.h"
#include "subjects/unit/shapes.h"

namespace dermis {
namespace {

using namespace unit;

constexpr float kSlope = 0.05f;  // of the reliefs: its square is what their limit neglects
constexpr float kFar = 2;        // times the distance of the camera

enum class UnitScene : int32_t {};  // the number of one of kCases
struct UnitParams {
    UnitScene shape = {};
};

Vec3 light_from(float yaw_deg, float pitch_deg = 0) {
    return direction_from_yaw_pitch(yaw_deg * kRadiansPerDegree, pitch_deg * kRadiansPerDegree);
}

// Objects under one white light, seen from the front; half_mm is half the picture's height.
SubjectScene scene_of(std::vector<SceneObject> objects, Vec3 to_light, float half_mm,
                      ExactExitance exact = {}) {
    // Narrow, so that a pixel covers the same area at the border of the picture as in its middle.
    constexpr float kFovRad = 0.2f;
    SubjectScene scene{.objects = std::move(objects), .exact = std::move(exact)};
    for (SceneObject& object : scene.objects)
        object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1.0f);
    scene.camera = Camera{.eye_mm = {0, 0, half_mm / std::tan(kFovRad / 2)}, .vertical_fov_rad = kFovRad};
    scene.lights = {{.name = "key", .to_light_world = to_light, .is_key = true}};
    scene.environment = Environment{.kind = EnvironmentKind::none};
    return scene;
}

SubjectScene far(SubjectScene scene) {
    scene.camera->eye_mm = scene.camera->eye_mm * kFar;
    return scene;
}

// Around the chart is room for a gutter, which blurs over the atlas cross its seam by.
SubjectScene sphere(float radius_mm, Vec3 to_light) {
    Mesh mesh = make_sphere(radius_mm, 128);
    for (Vec2& uv : mesh.uvs) uv = Vec2{0.02f, 0.02f} + uv * 0.96f;
    return scene_of({skin_object("sphere", std::move(mesh))}, to_light, 1.1f * radius_mm,
                    exact_sphere({}, radius_mm, to_light));
}

SubjectScene cylinder() {
    constexpr float kRadiusMm = 4;
    const Vec3 to_light = light_from(-60);
    return scene_of({skin_object("cylinder", make_cylinder(kRadiusMm, 2 * kReachMm, 128))}, to_light,
                    1.1f * kRadiusMm, exact_cylinder(kRadiusMm, to_light));
}

SubjectScene saddle_scene() {
    return scene_of({skin_object("saddle", saddle(8))}, light_from(-50, 35), 5);
}

// Lit at a right angle, seen from the side that the board leaves free: light at an angle would move the edge,
// as both renderers lift the receivers of shadows.
constexpr float kEdgeViewMm = 5;
constexpr Vec3 kEdgeLight = {0, 0, 1};

SubjectScene seen_past_the_board(SubjectScene scene) {
    scene.camera->eye_mm = light_from(40) * length(scene.camera->eye_mm);
    return scene;
}

SubjectScene shadow_edge() {
    return seen_past_the_board(scene_of(
        {skin_object("plane", plane_between(-kReachMm, kReachMm)), shading_board(kEdgeLight)}, kEdgeLight,
        kEdgeViewMm, exact_shadow_edge(std::numeric_limits<float>::infinity(), kEdgeLight)));
}

SubjectScene albedo_step() {
    return seen_past_the_board(
        scene_of({two_albedos(), shading_board(kEdgeLight)}, kEdgeLight, kEdgeViewMm,
                 exact_shadow_edge(std::numeric_limits<float>::infinity(), kEdgeLight)));
}

SubjectScene strip() {
    constexpr float kHalfMm = 2;
    return seen_past_the_board(
        scene_of({skin_object("strip", plane_between(-kHalfMm, kHalfMm)),
                  black_object("left", plane_between(-kReachMm, -kHalfMm)),
                  black_object("right", plane_between(kHalfMm, kReachMm)), shading_board(kEdgeLight)},
                 kEdgeLight, 1.2f * kHalfMm, exact_shadow_edge(kHalfMm, kEdgeLight)));
}

SubjectScene slab() {
    constexpr float kThicknessMm = 2;
    const Vec3 to_light = light_from(160);
    return scene_of({skin_object("slab", make_box({2 * kReachMm, 2 * kReachMm, kThicknessMm}))}, to_light,
                    kEdgeViewMm, exact_slab(kThicknessMm, to_light));
}

template <int wavelength_um>
SubjectScene relief_scene() {
    constexpr float kWavelengthMm = wavelength_um / 1000.0f, kWavesInSight = 6;
    const Vec3 to_light = light_from(-60);
    return scene_of({skin_object("relief", relief(kWavelengthMm, kSlope))}, to_light,
                    kWavesInSight / 2 * kWavelengthMm, exact_relief(kWavelengthMm, kSlope, to_light));
}

// No exact answer: scattering reaches from one to the other across the fold.
SubjectScene touching_spheres() {
    constexpr float kRadiusMm = 4;
    std::vector<SceneObject> objects;
    for (const float side : {-1.0f, 1.0f}) {
        Mesh mesh = make_sphere(kRadiusMm, 128);
        for (Vec3& p : mesh.positions_mm) p.x += side * kRadiusMm;
        for (Vec2& uv : mesh.uvs) uv.x = (side < 0 ? 0.01f : 0.51f) + 0.48f * uv.x;
        objects.push_back(skin_object(side < 0 ? "left" : "right", std::move(mesh)));
    }
    return scene_of(std::move(objects), light_from(-20, 40), 1.1f * kRadiusMm);
}

struct Case {
    const char* name;
    SubjectScene (*make)();
};
constexpr Case kCases[] = {
    {"sphere", [] { return sphere(4, light_from(-60)); }},
    {"sphere_far", [] { return far(sphere(4, light_from(-60))); }},
    {"sphere_behind", [] { return sphere(2, light_from(-150)); }},
    {"cylinder", cylinder},
    {"saddle", saddle_scene},
    {"shadow_edge", shadow_edge},
    {"albedo_step", albedo_step},
    {"strip", strip},
    {"slab_behind", slab},
    {"relief_0.5mm", relief_scene<500>},
    {"relief_1mm", relief_scene<1000>},
    {"relief_2mm", relief_scene<2000>},
    {"relief_5mm", relief_scene<5000>},
    {"touching_spheres", touching_spheres},
};

Result<SubjectScene> make(const ParameterValues& values) {
    return kCases[size_t(values.as<UnitParams>().shape)].make();
}

}  // namespace

Subject make_unit_subject() {
    std::vector<std::string> names;
    for (const Case& one : kCases) names.emplace_back(one.name);
    return {.name = "unit",
            .summary = "small scenes that ask one thing of a technique each, most with an exact answer",
            .parameters = ParameterTableBuilder<UnitParams>()
                              .choice(&UnitParams::shape, "shape", names, "which of them")
                              .build(),
            .make = make,
            .cases = "shape"};
}

}  // namespace dermis
