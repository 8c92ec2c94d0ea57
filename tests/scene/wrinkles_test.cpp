// Keys of wrinkle maps, their errors and the scene's hash.

#include "dermis/scene/wrinkles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_hash.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

class WrinkleKeys : public ::testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(write_text_file(directory_.path / "sheet.gltf", test::moving_sheet()));
        ASSERT_TRUE(write_text_file(directory_.path / "still.obj",
                                    "v 0 0 0\nv 90 0 0\nv 0 90 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"));
        for (const char* name : {"flat.png", "a.png", "b.png"}) {
            Image map(4, 4, 3, PixelFormat::u8);
            for (std::byte& b : map.bytes) b = std::byte(name[0]);
            ASSERT_TRUE(write_image(directory_.path / name, map));
        }
    }

    Result<Scene> load(const std::string& maps, const std::string& mesh = "sheet.gltf",
                       const std::string& pose = "lift = 1") const {
        const auto path = directory_.path / "s.toml";
        EXPECT_TRUE(write_text_file(path, "[[mesh]]\nfile = \"" + mesh + "\"\ndefault_class = \"skin\"\n" +
                                              (pose.empty() ? "" : "[morph]\n" + pose + "\n") + "[maps]\n" +
                                              maps));
        return load_scene(path.string(), {});
    }
    std::string hash(const std::string& maps, const std::string& pose = "lift = 1") const {
        const auto scene = load(maps, "sheet.gltf", pose);
        EXPECT_TRUE(scene) << scene.error().message;
        return scene ? *hash_of(*scene) : "";
    }
    std::string error(const std::string& maps) const {
        const auto scene = load(maps);
        return scene ? "none" : scene.error().message;
    }

    TemporaryDirectory directory_;
};

const std::string kFlat = "normal = \"flat.png\"\n", kStretch = kFlat + "wrinkle_stretch = \"a.png\"\n";

}  // namespace

TEST_F(WrinkleKeys, are_read) {
    const auto scene =
        load(kStretch + "wrinkle_compress = \"b.png\"\nwrinkle_from = 0.1\nwrinkle_full = 0.3\n");
    ASSERT_TRUE(scene) << scene.error().message;
    const Material& material = scene->objects[0].mesh.materials[0];
    EXPECT_THAT(material.wrinkle_stretch_map.name, HasSubstr("a.png"));
    EXPECT_THAT(material.wrinkle_compress_map.name, HasSubstr("b.png"));
    EXPECT_EQ(material.wrinkle_from, 0.1f);
    EXPECT_EQ(material.wrinkle_full, 0.3f);
    EXPECT_TRUE(has_wrinkles(*scene));
    EXPECT_FALSE(has_wrinkles(*load(kFlat)));
}

TEST_F(WrinkleKeys, change_the_scenes_hash_in_a_pose_alone) {
    const std::string base = hash(kFlat), stretch = hash(kStretch);
    EXPECT_NE(stretch, base);
    EXPECT_NE(hash(kFlat + "wrinkle_stretch = \"b.png\"\n"), stretch);
    EXPECT_NE(hash(kFlat + "wrinkle_compress = \"a.png\"\n"), stretch);
    EXPECT_NE(hash(kStretch + "wrinkle_from = 0.06\n"), stretch);
    EXPECT_NE(hash(kStretch + "wrinkle_full = 0.5\n"), stretch);
    EXPECT_EQ(hash(kFlat + "wrinkle_full = 0.5\n"), base) << "without a map";
    EXPECT_EQ(hash(kStretch, ""), hash(kFlat, "")) << "at rest";
}

TEST_F(WrinkleKeys, may_name_a_morph_target) {
    const std::string by_target = kStretch + "wrinkle_stretch_target = \"lift\"\n";
    const auto scene = load(by_target, "sheet.gltf", "lift = 0.25");
    ASSERT_TRUE(scene) << scene.error().message;
    const SceneObject& object = scene->objects[0];
    EXPECT_EQ(wrinkle_weights(object.mesh.materials[0], object.target_weights).stretch, 0.25f);
    EXPECT_EQ(wrinkle_weights(object.mesh.materials[0], object.target_weights).compress, 0.0f);
    EXPECT_EQ(wrinkle_weights(object.mesh.materials[0], {{"lift", 7.0f}}).stretch, 1.0f);
    EXPECT_EQ(wrinkle_weights(object.mesh.materials[0], {{"lift", -1.0f}}).stretch, 0.0f);
    EXPECT_NE(hash(by_target), hash(kStretch));
    EXPECT_EQ(hash(by_target, ""), hash(kStretch, "")) << "at rest";
    EXPECT_FALSE(shows_wrinkles(load(by_target, "sheet.gltf", "")->objects[0]));
}

TEST_F(WrinkleKeys, of_a_target_that_no_mesh_has_are_refused_with_the_nearest_name) {
    EXPECT_THAT(error(kStretch + "wrinkle_stretch_target = \"lfit\"\n"),
                HasSubstr("s.toml: material 'skin': wrinkle_stretch_target: unknown morph target 'lfit'; did "
                          "you mean 'lift'"));
    const auto still = load(kStretch + "wrinkle_stretch_target = \"lift\"\n", "still.obj", "");
    ASSERT_FALSE(still);
    EXPECT_THAT(still.error().message, HasSubstr("no mesh has morph targets"));
    EXPECT_THAT(load(kStretch + "wrinkle_compress_target = \"lift\"\n")->warnings,
                ::testing::Contains(HasSubstr("wrinkle_compress_target")))
        << "without its map";
}

TEST_F(WrinkleKeys, that_are_wrong_are_refused_in_one_line) {
    EXPECT_THAT(error(kStretch + "wrinkle_from = 0.4\n"),
                HasSubstr("material 'skin': wrinkle_from is 0.4; it must be smaller than wrinkle_full, 0.4"));
    EXPECT_THAT(error(kStretch + "wrinkle_full = 0\n"), HasSubstr("must be smaller than wrinkle_full, 0"));
    EXPECT_THAT(error(kStretch + "wrinkle_from = nan\n"), HasSubstr("maps.wrinkle_from"));
    EXPECT_THAT(error(kStretch + "wrinkle_full = inf\n"), HasSubstr("maps.wrinkle_full"));
    EXPECT_THAT(error(kStretch + "wrinkle_from = -1\n"), HasSubstr("maps.wrinkle_from"));
    EXPECT_THAT(error(kFlat + "wrinkle_stretch = \"none.png\"\n"), HasSubstr("none.png"));
    EXPECT_THAT(error("wrinkle_stretch = \"a.png\"\n"),
                HasSubstr("s.toml: material 'skin': a wrinkle map is"));
    EXPECT_THAT(error(kStretch + "normal_space = \"object\"\n"), HasSubstr("in tangent space"));
}

TEST_F(WrinkleKeys, of_a_mesh_that_cannot_move_are_warned_of) {
    const auto scene = load(kStretch, "still.obj", "");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, ::testing::Contains(HasSubstr("no mesh has clips or morph targets")));
    EXPECT_THAT(load(kStretch)->warnings, ::testing::Not(::testing::Contains(HasSubstr("clips or morph"))));
}

TEST_F(WrinkleKeys, of_a_mesh_without_uvs_are_warned_of) {
    ASSERT_TRUE(write_text_file(directory_.path / "bare.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n"));
    const auto scene = load(kStretch, "bare.obj", "");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, ::testing::Contains(HasSubstr("no UVs; maps cannot be used")));
}

}  // namespace dermis
