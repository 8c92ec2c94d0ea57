// Subjects as scenes take them: their parameters, and what they state beside their objects.

#include "dermis/scene/subject.h"

#include <gtest/gtest.h>

#include <set>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_keys.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

struct Params {
    float size_mm = 10;
    bool lit = true;
};

// One triangle; when lit, it states all that a test scene states.
Result<SubjectScene> make(const ParameterValues& values) {
    const auto params = values.as<Params>();
    if (params.size_mm == 13) return Error{"13 mm is not made"};
    SubjectScene scene;
    scene.objects.push_back({.name = "triangle", .classes = {MaterialClass::skin}});
    Mesh& mesh = scene.objects[0].mesh;
    mesh.positions_mm = {{0, 0, 0}, {params.size_mm, 0, 0}, {0, params.size_mm, 0}};
    mesh.indices = {0, 1, 2};
    mesh.materials.resize(1);
    mesh.submeshes = {{.index_count = 3}};
    if (!params.lit) return scene;
    scene.camera = Camera{.eye_mm = {1, 2, 30}, .target_mm = {1, 2, 0}};
    scene.lights = {{.name = "only", .intensity = 1, .to_light_world = {0, 0, 1}, .is_key = true}};
    scene.environment = Environment{.kind = EnvironmentKind::none};
    return scene;
}

const Subject kTriangleSubject[] = {
    {.name = "triangle",
     .summary = "for tests",
     .parameters = ParameterTableBuilder<Params>()
                       .number(&Params::size_mm, "size_mm", "mm", 1, 20, "length of both legs")
                       .toggle(&Params::lit, "lit", "states camera, light and environment")
                       .build(),
     .make = make}};

Result<Scene> load_file(const std::string& text) {
    const Result<SceneDescription> description = parse_scene(text, "s.toml", kTriangleSubject);
    return description ? build_scene(*description, kTriangleSubject) : description.error();
}

const std::string kTriangleMesh = "[[mesh]]\nfile = \"builtin:triangle\"\n";

}  // namespace

TEST(Subject, states_the_camera_the_lights_and_the_environment_of_its_scene) {
    const Result<Scene> scenes[] = {load_scene("builtin:triangle", {.subjects = kTriangleSubject}),
                                    load_file(kTriangleMesh)};
    for (const Result<Scene>& scene : scenes) {
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->camera.eye_mm, (Vec3{1, 2, 30}));
        ASSERT_EQ(scene->lights.size(), 1u);
        EXPECT_EQ(scene->key_light().name, "only");
        EXPECT_EQ(scene->environment.kind, EnvironmentKind::none);
        EXPECT_EQ(scene->exposure_ev, 0) << "the studio's exposure is of the studio's light";
    }
}

TEST(Subject, that_states_nothing_is_framed_in_the_studio) {
    const Result<Scene> scene = load_file(kTriangleMesh + "lit = false\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->camera.target_mm, scene->bounds_center_mm);
    EXPECT_EQ(scene->key_light().name, "key");
    EXPECT_EQ(scene->environment.kind, EnvironmentKind::studio);
}

TEST(Subject, is_overridden_by_the_scene_file) {
    const Result<Scene> scene = load_file(
        kTriangleMesh +
        "[camera]\neye_mm = [0, 0, 50]\n[[light]]\nname = \"mine\"\n[environment]\nkind = \"studio\"\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->camera.eye_mm, (Vec3{0, 0, 50}));
    EXPECT_EQ(scene->key_light().name, "mine");
    EXPECT_EQ(scene->environment.kind, EnvironmentKind::studio);
}

TEST(Subject, is_made_with_the_parameters_beside_its_name) {
    const Result<Scene> scene = load_file(kTriangleMesh + "size_mm = 4\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->objects[0].mesh.positions_mm[1], (Vec3{4, 0, 0}));
    EXPECT_EQ(load_file(kTriangleMesh + "size_mm = 13\n").error().message,
              "s.toml:2: mesh.file: 13 mm is not made");
    EXPECT_EQ(load_file(kTriangleMesh + "size_mm = 21\n").error().message,
              "s.toml:3: mesh.size_mm = 21: size_mm is a number from 1 to 20 (mm)");
    EXPECT_EQ(make_subject(kTriangleSubject, "triangle", {{"size_mm", "21"}}).error().message,
              "triangle: parameter 'size_mm': '21' is not in its range, 1 to 20 mm");
}

TEST(Subject, an_unknown_name_says_which_exist) {
    EXPECT_EQ(load_built_in_scene("builtin:sphere").error().message.substr(0, 65),
              "unknown built-in scene 'sphere'; did you mean 'spheres'? known: b");
}

TEST(Subject, all_built_in_ones_are_described_and_none_takes_a_name_that_a_mesh_has) {
    std::set<std::string> names;
    for (const auto& key : mesh_keys().keys()) names.insert(key.info.name);
    for (const Subject& subject : built_in_catalog().subjects) {
        EXPECT_FALSE(subject.summary.empty()) << subject.name;
        EXPECT_TRUE(subject.make) << subject.name;
        EXPECT_TRUE(ParameterValues(subject.parameters).check()) << subject.name;
        for (const Parameter& parameter : subject.parameters.parameters)
            EXPECT_FALSE(names.contains(parameter.name)) << subject.name << ": " << parameter.name;
    }
}
