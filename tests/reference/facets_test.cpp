#include "dermis/reference/facets.h"

#include <gmock/gmock.h>

#include "dermis/reference/picture.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

using testing::Contains;
using testing::HasSubstr;

Scene sphere_scene(int levels) {
    Scene scene;
    scene.objects.push_back(
        {.name = "sphere", .mesh = test::sphere(20, levels), .classes = {MaterialClass::skin}});
    scene.camera = {.eye_mm = {0, 0, 160}, .vertical_fov_rad = 0.3f, .near_mm = 1, .far_mm = 400};
    scene.lights.push_back({.intensity = 3, .to_light_world = Vec3{0, 0, 1}, .is_key = true});
    return scene;
}

std::vector<std::string> warnings_of(Scene scene, Integrator integrator) {
    scene.environment.kind = EnvironmentKind::none;
    const Result<ReferencePicture> picture = render_reference(
        scene, {.integrator = integrator, .width = 4, .height = 4, .samples = 2, .probes = 6}, {}, nullptr);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? picture->warnings : std::vector<std::string>{};
}

}  // namespace

// The corners of a triangle lie on a sphere of radius r, at distance c from the middle of the triangle. The
// normal of the sphere at each corner makes the angle asin(c / r) with the normal of the triangle.
TEST(Facets, angle_of_an_icosahedron_is_exact_and_halves_with_each_level) {
    const double circumradius = std::sqrt(std::numbers::phi * std::sqrt(5.0)) / 2,  // of edges of length 1
        corner = 1 / std::sqrt(3.0);
    EXPECT_NEAR(facet_angle_deg(sphere_scene(0)), std::asin(corner / circumradius) * 180 / std::numbers::pi,
                1e-3);
    const double coarse = facet_angle_deg(sphere_scene(3)), fine = facet_angle_deg(sphere_scene(4));
    EXPECT_NEAR(coarse / fine, 2, 0.02);
}

TEST(Facets, only_walks_on_coarse_skin_name_the_mend) {
    EXPECT_EQ(facets_note(sphere_scene(4)), "");
    EXPECT_THAT(facets_note(sphere_scene(3)), HasSubstr("mesh.subdivision=1 "));
    EXPECT_THAT(facets_note(sphere_scene(2)), HasSubstr("mesh.subdivision=2 "));
    Scene other = sphere_scene(1);
    other.objects[0].classes = {MaterialClass::other};
    EXPECT_EQ(facets_note(other), "");
    EXPECT_THAT(warnings_of(sphere_scene(1), Integrator::walk), Contains(HasSubstr("mesh.subdivision=2 ")));
    EXPECT_THAT(warnings_of(sphere_scene(1), Integrator::surface), testing::IsEmpty());
}

}  // namespace dermis
