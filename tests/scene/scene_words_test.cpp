// --scene words set every key of the scene file, with the same errors.

#include "dermis/scene/scene_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dermis/base/file.h"
#include "dermis/optics/mtlx.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_hash.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

Scene spheres() {
    return *load_built_in_scene("builtin:spheres");
}

std::string error_of(Scene& scene, std::vector<SceneWord> words) {
    const Result<void> set = set_words(scene, words);
    return set ? "" : set.error().message;
}

// Another value that the key takes too.
SceneWord changed(const SceneKey& key, const SceneWord& word) {
    KeyValue value = key.value;
    for (double& number : value.numbers) number += number + 0.5 <= key.info->max ? 0.5 : -0.5;
    value.integer = value.integer ? 0 : 1;
    value.text += "x";
    return {word.key, word_text(*key.info, value)};
}

TEST(SceneWords, every_key_of_a_loaded_scene_reads_back_what_it_was_set_to) {
    const Scene scene = spheres();
    const std::vector<SceneKey> keys = keys_of(scene);
    const std::vector<SceneWord> words = words_of(scene);
    ASSERT_EQ(keys.size(), words.size());
    ASSERT_GT(words.size(), 20u);
    for (size_t i = 0; i < words.size(); ++i) {
        SceneWord word = changed(keys[i], words[i]);
        if (word.key == "skin.profile") word.value = "jensen_skin1";
        if (word.key == "light.key.key" || word.key == "light.key.outer_angle_deg" ||
            word.key == "light.key.kind" || word.key == "environment.kind")
            continue;  // changed alone they make an invalid scene, or change other keys too
        Scene other = scene;
        ASSERT_EQ(error_of(other, {word}), "") << word.key;
        EXPECT_EQ(words_of(other)[i].value, word.value) << word.key;
    }
}

// Positions are floats: their rounding must not come back as another yaw or distance each time.
TEST(SceneWords, the_text_of_a_camera_stays_when_it_is_read_and_written_again) {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) { return low + (high - low) * float(random()) / 4.3e9f; };
    int changed = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 target_mm = {uniform(-200, 200), uniform(-200, 200), uniform(-200, 200)};
        const float distance_mm = std::pow(10.0f, uniform(0, 5));
        const Vec3 direction = direction_from_yaw_pitch(uniform(-3.1f, 3.1f), uniform(-1.5f, 1.5f));
        Scene scene{.camera = {.eye_mm = target_mm + direction * distance_mm, .target_mm = target_mm}};
        std::string texts[3];
        for (std::string& text : texts) {
            text = camera_text(scene.camera);
            ASSERT_TRUE(set_section(scene, "camera", text)) << text;
        }
        changed += texts[2] != texts[1];
    }
    EXPECT_EQ(changed, 0);
}

TEST(SceneWords, the_hash_follows_every_key_but_those_of_the_display) {
    const Scene scene = spheres();
    const std::string views = hash_of_views(scene), whole = *hash_of(scene);
    const std::vector<SceneKey> keys = keys_of(scene);
    const std::vector<SceneWord> words = words_of(scene);
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& name = words[i].key;
        SceneWord word = changed(keys[i], words[i]);
        if (name == "skin.profile") word.value = "jensen_skin1";
        if (name == "light.key.key" || name == "light.key.kind" || name == "light.key.outer_angle_deg")
            continue;
        const bool display = name == "exposure_ev" || name == "tone_map" || name == "light.key.name";
        Scene other = scene;
        ASSERT_EQ(error_of(other, {word}), "") << name;
        EXPECT_EQ(hash_of_views(other) == views, display) << name;
        EXPECT_EQ(*hash_of(other) == whole, display) << name;
    }
    Scene other = scene;
    other.objects[0].mesh.positions_mm[3].x += 1;
    EXPECT_EQ(hash_of_views(other), views);
    EXPECT_NE(*hash_of(other), whole);
}

TEST(SceneWords, the_hash_follows_the_content_of_a_profile_file) {
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory.path / "skin.mtlx";
    Scene scene = spheres();
    scene.skin.profile = file.string();
    ASSERT_TRUE(write_text_file(file, mtlx_text(*find_profile("openpbr_skin_1"))));
    const std::string before = *hash_of(scene);
    EXPECT_THAT(files_of(scene), testing::Contains(file));
    ASSERT_TRUE(write_text_file(file, mtlx_text(*find_profile("openpbr_skin_6"))));
    EXPECT_NE(*hash_of(scene), before);
}

// Roughness and ior are read while a scene is loaded: a word that comes later tells what it leaves.
TEST(SceneWords, a_materialx_profile_says_which_of_its_surface_is_not_used) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path / "skin.mtlx").string();
    std::string text = mtlx_text(*find_profile("openpbr_skin_1"));
    ASSERT_TRUE(write_text_file(file, text));
    Scene scene = spheres();
    ASSERT_EQ(error_of(scene, {{"skin.profile", file}}), "");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    const size_t at = text.find("<input name=\"specular_ior\"");
    text.insert(at, "<input name=\"specular_roughness\" type=\"float\" value=\"0.25\" />");
    ASSERT_TRUE(write_text_file(file, text));
    scene = spheres();
    ASSERT_EQ(error_of(scene, {{"skin.profile", file}}), "");
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0], file + ": specular_roughness 0.25 is not used: skin.roughness is 0.45");
}

TEST(SceneWords, what_no_word_names_keeps_its_bits) {
    Scene scene = spheres();
    scene.camera.eye_mm = {101.3f, 55.7f, 611.9f};
    scene.lights[0].to_light_world = normalize(Vec3{0.3f, 0.2f, 0.7f});
    scene.environment.yaw_rad = 1.2345f;
    const Scene before = scene;
    ASSERT_EQ(error_of(scene, {{"exposure_ev", "1"},
                               {"camera.fov_deg", "31"},
                               {"light.intensity", "2"},
                               {"environment.intensity", "3"}}),
              "");
    EXPECT_EQ(scene.camera.eye_mm, before.camera.eye_mm);
    EXPECT_EQ(scene.lights[0].to_light_world, before.lights[0].to_light_world);
    EXPECT_EQ(scene.environment.yaw_rad, before.environment.yaw_rad);
    EXPECT_EQ(scene.exposure_ev, 1);
    EXPECT_EQ(scene.environment.intensity, 3);
    EXPECT_EQ(scene.lights[0].intensity, 2);
}

TEST(SceneWords, errors_are_those_of_the_file_and_change_nothing) {
    Scene scene = spheres();
    const std::vector<SceneWord> before = words_of(scene);
    for (const auto& [key, value, told] :
         {std::tuple("camera.jaw_deg", "3", "unknown key in [camera]: 'jaw_deg'; did you mean 'yaw_deg'?"),
          std::tuple("environment.yaw_deg", "x",
                     "environment.yaw_deg = \"x\": yaw_deg is a number from -360 to 360 (degrees)"),
          std::tuple("camera.target_mm", "1,2", "target_mm is three numbers [x, y, z], each from"),
          std::tuple("camera.distance_mm", "nan", "distance_mm is a number from 0.1 to 1e+06 (mm)"),
          std::tuple("tone_map", "ace", "tone_map is one of \"none\", \"hable\""),
          std::tuple("light.keys.intensity", "2", "unknown light 'keys'; did you mean 'key'?"),
          std::tuple("lihgt.intensity", "2", "read while the scene is loaded"),
          std::tuple("camera.key.yaw_deg", "2", "write camera.yaw_deg"),
          std::tuple("skin.profile", "nobody", "skin.profile: unknown profile 'nobody'"),
          std::tuple("environment.file", "/nowhere.hdr", "environment.file: '/nowhere.hdr' does not exist"),
          std::tuple("light.key.key", "false", "give one of them key = true"),
          std::tuple("light.key.distance_mm", "5", "a directional light has none"),
          std::tuple("mesh.tone", "5", "mesh.tone: read while the scene is loaded")}) {
        EXPECT_THAT(error_of(scene, {{"exposure_ev", "5"}, {key, value}}), HasSubstr(told));
        EXPECT_EQ(words_of(scene), before) << key;
    }
    EXPECT_THAT(parse_scene_word("exposure_ev").error().message, HasSubstr("is no KEY=VALUE"));
    EXPECT_THAT(parse_section_words("camera", "30 5").error().message, HasSubstr("is no KEY=VALUE"));
}

TEST(SceneWords, lights_are_chosen_by_name_by_number_and_as_the_key_light) {
    Scene scene = spheres();
    scene.lights = {{.name = "rim.left"}, {.name = "sun", .is_key = true}, {}};
    ASSERT_EQ(error_of(scene, {{"light.rim.left.intensity", "2"},
                               {"light.key.intensity", "3"},
                               {"light.3.color", "1,.5,[.25]"}}),
              "light.color = an array: color is three numbers [x, y, z], each from 0 to 1000 (linear)");
    ASSERT_EQ(error_of(scene, {{"light.rim.left.intensity", "2"},
                               {"light.key.intensity", "3"},
                               {"light.3.color", "[1, .5, .25]"}}),
              "");
    EXPECT_EQ(scene.lights[0].intensity, 2);
    EXPECT_EQ(scene.lights[1].intensity, 3);
    EXPECT_EQ(scene.lights[2].color_linear, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_THAT(error_of(scene, {{"light.intensity", "2"}}), HasSubstr("the scene has 3; say which"));
}

TEST(SceneWords, a_scene_file_takes_the_keys_that_are_read_while_it_is_loaded) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path / "s.toml").string();
    ASSERT_TRUE(write_text_file(file, "[[mesh]]\nfile = \"builtin:spheres\"\nname = \"row\"\n"));
    const Scene plain = *load_built_in_scene(file);
    const Result<Scene> scene = load_scene(file, {.subjects = built_in_catalog().subjects,
                                                  .words = {{"mesh.scale", "2"},
                                                            {"material.skin.albedo", "0.5,0.25,1"},
                                                            {"skin.roughness", "0.125"},
                                                            {"settings.wrap", "0.5"}}});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_NEAR(scene->bounds_radius_mm, 2 * plain.bounds_radius_mm, 1e-3);
    const Material& skin = scene->objects[0].mesh.materials[0];
    EXPECT_EQ(skin.base_color_linear, (Vec3{0.5f, 0.25f, 1}));
    EXPECT_EQ(skin.roughness, 0.125f);
    EXPECT_EQ(scene->settings.at("wrap"), "0.5");
    const auto told = [&](const std::string& name, const SceneWord& word) {
        const Result<Scene> wrong =
            load_scene(name, {.subjects = built_in_catalog().subjects, .words = {word}});
        return wrong ? "" : wrong.error().message;
    };
    EXPECT_THAT(told(file, {"mesh.scal", "2"}), HasSubstr("did you mean 'scale'?"));
    EXPECT_THAT(told(file, {"material.skim.roughness", "1"}), HasSubstr("did you mean 'skin'?"));
    EXPECT_THAT(told(file, {"maps.albedo", "no.png"}), HasSubstr("maps.albedo: '"));
    EXPECT_THAT(told(file, {"mesh.2.scale", "2"}), HasSubstr("unknown mesh '2'"));
    EXPECT_THAT(told(file, {"mesh.tone", "2"}), HasSubstr("only builtin:bust has it"));
    EXPECT_THAT(told("builtin:spheres", {"mesh.scal", "2"}), HasSubstr("did you mean 'scale'?"));
    EXPECT_THAT(told("builtin:spheres", {"mesh.scale", "2"}), HasSubstr("write a scene file with [[mesh]]"));
}

}  // namespace
}  // namespace dermis
