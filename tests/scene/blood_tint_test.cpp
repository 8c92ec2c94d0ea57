// Blood that follows the tension of a pose, against the pigment model.

#include "dermis/scene/blood_tint.h"

#include <gmock/gmock.h>

#include <cmath>

#include "dermis/base/file.h"
#include "dermis/mesh/tension.h"
#include "dermis/optics/tissue/pigment_table.h"
#include "dermis/optics/tissue/skin_model.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/pose_scene.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

const SkinModel kTintedSkin{.melanin = 0.04, .blood = 0.03};

BloodTint tint_of(float blood_by_tension, const SkinModel& model = kTintedSkin) {
    const auto tint =
        BloodTint::of({.profile = skin_model_text(model), .blood_by_tension = blood_by_tension});
    EXPECT_TRUE(tint) << tint.error().message;
    return **tint;
}

class TintedSheet : public ::testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(write_text_file(path(), test::moving_sheet())); }
    std::string path() const { return (directory_.path / "sheet.gltf").string(); }

    Result<Scene> load(std::vector<SceneWord> words) const {
        words.push_back({"animation.clip", "nod"});
        return load_scene(path(), {.words = words});
    }
    TemporaryDirectory directory_;
};

}  // namespace

TEST(BloodTint, is_the_models_albedo_with_less_blood_over_that_at_rest) {
    for (const float strength : {0.5f, 1.0f, 3.0f}) {
        const BloodTint tint = tint_of(strength);
        const Rgb rest = skin_albedo(kTintedSkin);
        for (const float tension : {-0.9f, -0.31f, -0.04f, 0.0f, 0.07f, 0.45f, 1.3f, 3.7f}) {
            SkinModel model = kTintedSkin;
            model.blood = std::min(model.blood * std::exp(-double(strength * tension)), kMostBlood);
            const Rgb expected = skin_albedo(model);
            const Vec3 got = tint.at(tension);
            EXPECT_NEAR(got.x, expected[0] / rest[0], 0.003) << strength << " " << tension;
            EXPECT_NEAR(got.y, expected[1] / rest[1], 0.003) << strength << " " << tension;
            EXPECT_NEAR(got.z, expected[2] / rest[2], 0.003) << strength << " " << tension;
        }
    }
}

TEST(BloodTint, pales_stretched_skin_and_reddens_compressed_skin) {
    const BloodTint tint = tint_of(1);
    const Vec3 stretched = tint.at(0.4f), compressed = tint.at(-0.4f);
    EXPECT_GT(stretched.y, 1.03f);
    EXPECT_LT(compressed.y, 0.97f);
    EXPECT_GT(compressed.x / compressed.y, stretched.x / stretched.y);
    EXPECT_EQ(tint.at(0), (Vec3{1, 1, 1}));
    EXPECT_EQ(tint.at(100), tint.at(kMostTension));
}

TEST(BloodTint, needs_a_skin_of_pigments) {
    EXPECT_FALSE(BloodTint::of({.profile = "jensen_skin1"})->has_value()) << "0 is off";
    EXPECT_EQ(
        BloodTint::of({.profile = "jensen_skin1", .blood_by_tension = 1}).error().message,
        "skin.blood_by_tension: needs a skin of pigments (skin.melanin or skin.blood, or their maps), and "
        "the skin's profile is 'jensen_skin1'");
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
        const Vec3 expected = (*tint)->at(mesh.tensions[v]);
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

TEST_F(TintedSheet, without_pigments_is_refused_in_one_line) {
    const auto scene = load({{"skin.tone", "3"}, {"skin.blood_by_tension", "1"}});
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("skin.blood_by_tension: needs a skin of pigments"));
    EXPECT_FALSE(load({{"skin.blood", "0.03"}, {"skin.blood_by_tension", "nan"}}));
    EXPECT_FALSE(load({{"skin.blood", "0.03"}, {"skin.blood_by_tension", "-1"}}));
}

}  // namespace dermis
