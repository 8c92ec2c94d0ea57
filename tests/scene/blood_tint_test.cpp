// Blood that follows a pose, by tension and by maps of targets, against the pigment model.

#include "dermis/scene/blood_tint.h"

#include <gmock/gmock.h>

#include <cmath>

#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/optics/tissue/pigment_table.h"
#include "dermis/optics/tissue/skin_model.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

const SkinModel kTintedSkin{.melanin = 0.04, .blood = 0.03};

BloodTint tint_of(const SkinModel& model) {
    const auto tint = BloodTint::of({.profile = skin_model_text(model), .blood_by_tension = 1});
    EXPECT_TRUE(tint) << tint.error().message;
    return **tint;
}

class TintedSheet : public ::testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(write_text_file(path(), test::moving_sheet()));
        // The sheet's left edge pales and its right edge reddens.
        Image ramp(2, 1, 1, PixelFormat::u8, Encoding::linear);
        ramp.bytes = {std::byte{51}, std::byte{255}};
        ASSERT_TRUE(write_image(map(), ramp));
    }
    std::string path() const { return (directory_.path / "sheet.gltf").string(); }
    std::string map() const { return (directory_.path / "lift_blood.png").string(); }

    Result<Scene> load(std::vector<SceneWord> words) const {
        words.push_back({"animation.clip", "nod"});
        return load_scene(path(), {.words = words});
    }
    Result<Scene> load_still(const std::vector<SceneWord>& words) const {
        return load_scene(path(), {.words = words});
    }

    static void expect_colors(const Scene& scene, float weight) {
        const auto tint = BloodTint::of(scene.skin);
        ASSERT_TRUE(tint && *tint);
        const Mesh& mesh = scene.objects[0].mesh;
        ASSERT_EQ(mesh.colors_linear.size(), mesh.uvs.size());
        for (size_t v = 0; v < mesh.uvs.size(); ++v) {
            // Texel centres are at 1/4 and 3/4.
            const float value = 0.2f + 0.8f * std::clamp(2 * mesh.uvs[v].x - 0.5f, 0.0f, 1.0f);
            const Vec3 expected = (*tint)->at(weight * std::log(std::pow(4.0f, 2 * value - 1)));
            EXPECT_NEAR(mesh.colors_linear[v].x, expected.x, 1e-4f) << v;
            EXPECT_NEAR(mesh.colors_linear[v].y, expected.y, 1e-4f) << v;
        }
    }
    TemporaryDirectory directory_;
};

}  // namespace

TEST(BloodTint, is_the_models_albedo_with_other_blood_over_that_at_rest) {
    for (const double blood : {0.005, 0.03, 0.07}) {
        SkinModel model = kTintedSkin;
        model.blood = blood;
        const BloodTint tint = tint_of(model);
        const Rgb rest = skin_albedo(model);
        for (const float change : {-7.5f, -3.7f, -1.3f, -0.45f, -0.07f, 0.0f, 0.04f, 0.31f, 0.9f, 2.7f}) {
            SkinModel changed = model;
            changed.blood = std::min(blood * std::exp(double(change)), kMostBlood);
            const Rgb expected = skin_albedo(changed);
            const Vec3 got = tint.at(change);
            EXPECT_NEAR(got.x, expected[0] / rest[0], 0.003) << blood << " " << change;
            EXPECT_NEAR(got.y, expected[1] / rest[1], 0.003) << blood << " " << change;
            EXPECT_NEAR(got.z, expected[2] / rest[2], 0.003) << blood << " " << change;
        }
    }
}

TEST(BloodTint, pales_with_less_blood_and_reddens_with_more) {
    const BloodTint tint = tint_of(kTintedSkin);
    const Vec3 less = tint.at(-0.4f), more = tint.at(0.4f);
    EXPECT_GT(less.y, 1.03f);
    EXPECT_LT(more.y, 0.97f);
    EXPECT_GT(more.x / more.y, less.x / less.y);
    EXPECT_EQ(tint.at(0), (Vec3{1, 1, 1}));
    EXPECT_EQ(tint.at(-100), tint.at(-8));
}

TEST(BloodTint, needs_a_skin_of_pigments) {
    EXPECT_FALSE(BloodTint::of({.profile = "jensen_skin1"})->has_value()) << "0 is off";
    EXPECT_EQ(
        BloodTint::of({.profile = "jensen_skin1", .blood_by_tension = 1}).error().message,
        "skin.blood_by_tension: needs a skin of pigments (skin.melanin or skin.blood, or their maps), and "
        "the skin's profile is 'jensen_skin1'");
    EXPECT_THAT(
        BloodTint::of({.profile = "jensen_skin1", .blood_by_target = {{"smile", "a.png"}}}).error().message,
        HasSubstr("skin.blood_by_target: needs a skin of pigments"));
}

TEST_F(TintedSheet, vertices_have_the_tint_of_their_tensions) {
    const auto scene =
        load({{"animation.time_s", "1.5"}, {"skin.blood", "0.03"}, {"skin.blood_by_tension", "2"}});
    ASSERT_TRUE(scene) << scene.error().message;
    const auto tint = BloodTint::of(scene->skin);
    ASSERT_TRUE(tint && *tint);
    const Mesh& mesh = scene->objects[0].mesh;
    ASSERT_EQ(mesh.colors_linear.size(), mesh.tensions.size());
    float least = 1;
    for (size_t v = 0; v < mesh.tensions.size(); ++v) {
        const Vec3 expected = (*tint)->at(-2 * mesh.tensions[v]);
        const Vec4 got = mesh.colors_linear[v];
        EXPECT_EQ((Vec4{expected.x, expected.y, expected.z, 1}), got);
        least = std::min(least, 1 / got.y);
    }
    EXPECT_LT(least, 0.99f) << "some skin pales";
    EXPECT_TRUE(load({{"skin.blood", "0.03"}})->objects[0].mesh.colors_linear.empty()) << "off";
}

TEST_F(TintedSheet, that_is_posed_has_the_tint_of_one_loaded_in_the_pose) {
    const std::vector<SceneWord> words = {{"skin.blood", "0.03"}, {"skin.blood_by_tension", "2"}};
    std::vector<SceneWord> later = words;
    later.push_back({"animation.time_s", "1.5"});
    const auto expected = load(later);
    ASSERT_TRUE(expected);
    auto at_start = load(words), from_pose = load(later);
    for (Scene* scene : {&*at_start, &*from_pose}) {
        const auto poser = ScenePoser::create(*scene);
        ASSERT_TRUE(poser) << poser.error().message;
        ASSERT_TRUE(poser->pose({.clip = "nod", .time_s = 0.2}, *scene));
        ASSERT_TRUE(poser->pose({.clip = "nod", .time_s = 1.5}, *scene));
        const auto& got = scene->objects[0].mesh.colors_linear;
        ASSERT_EQ(got.size(), expected->objects[0].mesh.colors_linear.size());
        for (size_t v = 0; v < got.size(); ++v)
            EXPECT_NEAR(got[v].y, expected->objects[0].mesh.colors_linear[v].y, 1e-4f);
    }
}

TEST_F(TintedSheet, a_map_of_a_target_acts_with_the_weight_of_the_target) {
    const std::vector<SceneWord> words = {{"skin.blood", "0.03"}, {"skin.blood_by_target.lift", map()}};
    const auto with = [&](const SceneWord& word) {
        std::vector<SceneWord> all = words;
        all.push_back(word);
        return all;
    };
    const auto half = load_still(with({"morph.lift", "0.5"}));
    ASSERT_TRUE(half) << half.error().message;
    expect_colors(*half, 0.5f);
    const auto back = load_still(with({"morph.lift", "-1"}));
    ASSERT_TRUE(back);
    expect_colors(*back, -1);
    EXPECT_TRUE(load_still(words)->objects[0].mesh.colors_linear.empty()) << "at rest";

    const auto in_clip = load(with({"animation.time_s", "1.5"}));
    ASSERT_TRUE(in_clip);
    expect_colors(*in_clip, 0.75f);
    auto posed = load_still(with({"morph.lift", "0.9"}));
    ASSERT_TRUE(posed);
    const auto poser = ScenePoser::create(*posed);
    ASSERT_TRUE(poser) << poser.error().message;
    ASSERT_TRUE(poser->pose({.clip = "nod", .time_s = 1.5}, *posed));
    expect_colors(*posed, 0.75f);
    ASSERT_TRUE(poser->pose({}, *posed));
    expect_colors(*posed, 0);
}

TEST_F(TintedSheet, a_scene_file_names_maps_of_targets) {
    const auto scene_path = directory_.path / "scene.toml";
    const std::string start = "[[mesh]]\nfile = \"sheet.gltf\"\n[skin]\nblood = 0.03\n";
    const auto load_text = [&](const std::string& text) {
        EXPECT_TRUE(write_text_file(scene_path, start + text));
        return load_scene(scene_path.string(), {});
    };
    const auto scene = load_text("[skin.blood_by_target]\nlift = \"lift_blood.png\"\n[morph]\nlift = 0.5\n");
    ASSERT_TRUE(scene) << scene.error().message;
    expect_colors(*scene, 0.5f);
    EXPECT_THAT(files_of(*scene), ::testing::Contains(directory_.path / "lift_blood.png"));

    const auto error_of = [&](const std::string& text) { return load_text(text).error().message; };
    EXPECT_THAT(error_of("[skin.blood_by_target]\nlit = \"lift_blood.png\"\n"),
                HasSubstr("scene.toml:6: skin.blood_by_target.lit: "));
    EXPECT_THAT(error_of("[skin.blood_by_target]\nlift = \"missing.png\"\n"),
                HasSubstr("scene.toml:6: skin.blood_by_target.lift: "));
    EXPECT_THAT(error_of("[skin.blood_by_target]\nlift = \"sheet.gltf\"\n"),
                HasSubstr("scene.toml:6: skin.blood_by_target.lift: "));
    EXPECT_THAT(error_of("[skin.blood_by_target]\nlift = 0.5\n"),
                HasSubstr("scene.toml:6: skin.blood_by_target.lift = 0.5: lift is a path in a string"));
    EXPECT_THAT(error_of("blood_by_target = 1\n"),
                HasSubstr("skin.blood_by_target is an integer, not a table; write [skin.blood_by_target]"));
}

TEST_F(TintedSheet, a_words_place_in_a_scene_file_is_the_table_of_targets) {
    const auto place = file_key({"skin.blood_by_target.mouth.open", "/maps/a.png"});
    ASSERT_TRUE(place);
    EXPECT_EQ(place->table, "skin.blood_by_target");
    EXPECT_EQ(place->key, "\"mouth.open\"");
    EXPECT_EQ(place->value, "\"/maps/a.png\"");
}

TEST_F(TintedSheet, without_pigments_is_refused_in_one_line) {
    const auto scene = load({{"skin.tone", "3"}, {"skin.blood_by_tension", "1"}});
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("skin.blood_by_tension: needs a skin of pigments"));
    EXPECT_FALSE(load({{"skin.blood", "0.03"}, {"skin.blood_by_tension", "nan"}}));
    EXPECT_FALSE(load({{"skin.blood", "0.03"}, {"skin.blood_by_tension", "-1"}}));
}

}  // namespace dermis
