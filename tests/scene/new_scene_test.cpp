#include "dermis/scene/new_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

struct MeshDirectory : TemporaryDirectory {
    void put(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_text_file(path / name, text));
    }
    [[nodiscard]] std::string file(const char* name) const { return (path / name).string(); }
};

// A head of three materials in centimetres; the lashes have no alpha.
constexpr const char* kHead =
    "v 0 0 0\nv 20 0 0\nv 0 30 0\nv 0 20 9\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "usemtl Face\nf 1/1 2/2 3/3\nusemtl Eye \"L\"\nf 1/1 3/2 4/3\nusemtl Lashes\nf 1/1 2/2 4/3\n";

}  // namespace

TEST(NewScene, is_complete_and_loads_without_a_warning_about_classes) {
    const MeshDirectory dir;
    dir.put("head.obj", kHead);
    const auto bare = load_scene(dir.file("head.obj"), {.mesh_unit_mm = 10});
    ASSERT_TRUE(bare) << bare.error().message;
    const auto made = new_scene(*bare, dir.file("head.obj"), dir.file("head.toml"));
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_THAT(made->toml, HasSubstr("file = \"head.obj\"\nunit_mm = 10"));
    EXPECT_THAT(made->toml, HasSubstr("credit = \"\""));
    EXPECT_THAT(made->toml, HasSubstr("class = \"hair\"  # 'lashes' in its name\nvisible = false"));
    dir.put("head.toml", made->toml);
    const auto scene = load_built_in_scene(dir.file("head.toml"));
    ASSERT_TRUE(scene) << scene.error().message << "\n" << made->toml;
    EXPECT_EQ(scene->objects[0].classes, bare->objects[0].classes);
    EXPECT_EQ(scene->objects[0].mesh.triangle_count(), 2u);
    EXPECT_EQ(scene->lights.size(), 3u);
    for (const std::string& warning : scene->warnings)
        EXPECT_EQ(warning.find("classes found by name"), std::string::npos) << warning;
}

TEST(NewScene, finds_images_of_the_skin_by_their_names) {
    const MeshDirectory dir;
    dir.put("head.obj", kHead);
    for (const char* name : {"Head_Normal.png", "eye_color.png", "notes.png", "T_Face_Roughness.png"})
        dir.put(name, "");
    const auto bare = load_scene(dir.file("head.obj"), {.mesh_unit_mm = 10});
    ASSERT_TRUE(bare) << bare.error().message;
    const auto made = new_scene(*bare, dir.file("head.obj"), dir.file("head.toml"));
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_THAT(made->toml,
                HasSubstr("[maps]\nnormal = \"Head_Normal.png\"\nroughness = \"T_Face_Roughness.png\"\n"));
    EXPECT_EQ(made->toml.find("eye_color"), std::string::npos) << made->toml;
}
