// What both integrators make of cavities, overlapping parts and open borders.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/reference/picture.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

// Seen and lit from +z, the light from the side.
Scene scene_of(Mesh mesh, float radius_mm) {
    Scene scene;
    scene.objects.push_back({.name = "skin", .mesh = std::move(mesh), .classes = {MaterialClass::skin}});
    scene.lights.push_back(
        {.intensity = 3, .to_light_world = normalize(Vec3{1, 0.5f, 0.5f}), .is_key = true});
    scene.camera = {
        .eye_mm = {0, 0, radius_mm * 8}, .vertical_fov_rad = 0.3f, .near_mm = 1, .far_mm = radius_mm * 20};
    scene.environment.kind = EnvironmentKind::none;
    scene.skin.profile = "jensen_skin1";
    return scene;
}

ReferenceSettings quick(Integrator integrator) {
    ReferenceSettings settings{
        .integrator = integrator, .width = 16, .height = 16, .samples = 8, .probes = 16};
    settings.lighting.specular = SpecularReflection::none;
    return settings;
}

ReferencePicture picture_of(const Scene& scene, const ReferenceSettings& settings) {
    auto picture = render_reference(scene, settings);
    EXPECT_TRUE(picture) << picture.error().message;
    return std::move(*picture);
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const float value : image.floats()) sum += value;
    return sum / double(image.floats().size());
}

class Cavity : public testing::TestWithParam<Integrator> {};

TEST_P(Cavity, a_hidden_inner_shell_changes_nothing_at_all) {
    // Skin 1 mm thick over nothing: both integrators would notice.
    const Mesh outer = test::sphere(5, 4), inner = test::inside_out(test::sphere(4, 3));
    const Scene solid = scene_of(outer, 5), shell = scene_of(test::joined(outer, inner), 5);
    ReferenceSettings settings = quick(GetParam());
    const ReferencePicture a = picture_of(solid, settings), b = picture_of(shell, settings);
    EXPECT_EQ(a.diffuse.bytes, b.diffuse.bytes);
    settings.cavities = Cavities::open;
    const ReferencePicture open = picture_of(shell, settings);
    EXPECT_LT(mean_of(open.diffuse), 0.9 * mean_of(a.diffuse));
    EXPECT_EQ(picture_of(solid, settings).diffuse.bytes, a.diffuse.bytes);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Cavity, testing::Values(Integrator::surface, Integrator::walk));

TEST(Walks, parts_that_overlap_are_one_body) {
    // One sphere has another within its skin: an ellipsoid of the same outline must not tell them apart.
    const Mesh body = test::sphere(6, 4), part = test::moved(test::sphere(3, 3), {0, 0, -3.5f});
    const Scene whole = scene_of(body, 6), overlapping = scene_of(test::joined(body, part), 6);
    const ReferencePicture a = picture_of(whole, quick(Integrator::walk));
    const ReferencePicture b = picture_of(overlapping, quick(Integrator::walk));
    EXPECT_GT(a.walks, 10'000u);
    EXPECT_LE(b.lost_walks, 1e-4 * double(b.walks));
    // The part ends 0.5 mm behind the far side, where no light that is seen goes.
    EXPECT_NEAR(mean_of(b.diffuse), mean_of(a.diffuse), 0.03 * mean_of(a.diffuse));
}

TEST(Walks, none_is_lost_where_the_skin_is_open) {
    // A sphere without its lower quarter: the cut is closed, and seen from above nothing is missing.
    Mesh cut = test::sphere(6, 4);
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < cut.indices.size(); i += 3)
        if (cut.positions_mm[cut.indices[i]].y > -3)
            kept.insert(kept.end(), &cut.indices[i], &cut.indices[i] + 3);
    cut.indices = kept;
    cut.submeshes[0].index_count = uint32_t(kept.size());
    const ReferencePicture picture = picture_of(scene_of(cut, 6), quick(Integrator::walk));
    EXPECT_GT(picture.walks, 10'000u);
    EXPECT_LE(picture.lost_walks, 1e-4 * double(picture.walks));
}

TEST(Walks, a_cut_reflects_as_if_the_flesh_went_on) {
    // Half a ball under light from everywhere along the cut's plane is half of a whole one.
    Mesh whole = test::sphere(6, 5), half = whole;
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < half.indices.size(); i += 3) {
        const uint32_t* c = &half.indices[i];
        if (half.positions_mm[c[0]].y + half.positions_mm[c[1]].y + half.positions_mm[c[2]].y > 0)
            kept.insert(kept.end(), c, c + 3);
    }
    half.indices = kept;
    half.submeshes[0].index_count = uint32_t(kept.size());
    Scene a = scene_of(whole, 6), b = scene_of(half, 6);
    for (Scene* scene : {&a, &b}) {
        scene->lights[0].to_light_world = normalize(Vec3{1, 0, 0.5f});
        scene->camera.eye_mm = {0, 2, 48};
        scene->camera.target_mm = {0, 2, 0};
        scene->camera.vertical_fov_rad = 0.02f;
    }
    ReferenceSettings settings = quick(Integrator::walk);
    settings.width = settings.height = 4;
    settings.samples = 256;
    const ReferencePicture first = picture_of(a, settings), second = picture_of(b, settings);
    // The cut of a sphere of triangles is not quite plane.
    EXPECT_NEAR(mean_of(second.diffuse), mean_of(first.diffuse), 0.02 * mean_of(first.diffuse));
}

}  // namespace
}  // namespace dermis
