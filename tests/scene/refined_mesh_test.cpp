// Subdivision and displacement as a scene file asks for them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "dermis/image/io.h"
#include "dermis/scene/scene.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

// A square of two by two quads, 200 mm wide, with UVs.
constexpr const char* kQuads =
    "v 0 0 0\nv 100 0 0\nv 200 0 0\nv 0 100 0\nv 100 100 0\nv 200 100 0\nv 0 200 0\nv 100 200 0\nv 200 200 "
    "0\n"
    "vt 0 0\nvt .5 0\nvt 1 0\nvt 0 .5\nvt .5 .5\nvt 1 .5\nvt 0 1\nvt .5 1\nvt 1 1\n"
    "f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6 5/5\nf 4/4 5/5 8/8 7/7\nf 5/5 6/6 9/9 8/8\n";

class RefinedMesh : public testing::Test {
  protected:
    RefinedMesh() { std::ofstream(directory_.path / "quads.obj") << kQuads; }
    Result<Scene> scene(const std::string& lines) {
        const auto path = directory_.path / "scene.toml";
        std::ofstream(path) << "[[mesh]]\nfile = \"quads.obj\"\nunit_mm = 1\n" << lines;
        return load_built_in_scene(path.string());
    }
    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(RefinedMesh, every_level_of_subdivision_makes_four_times_the_triangles) {
    for (const int level : {0, 1, 2}) {
        const Result<Scene> loaded = scene("subdivision = " + std::to_string(level) + "\n");
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->objects[0].mesh.triangle_count(), size_t(8) << (2 * level));
    }
}

TEST_F(RefinedMesh, a_displacement_map_moves_vertices_along_the_normal_in_mm) {
    Image heights(8, 8, 1, PixelFormat::f32);
    std::ranges::fill(heights.floats(), 0.75f);
    ASSERT_TRUE(write_image(directory_.path / "height.exr", heights));
    const Result<Scene> loaded = scene(
        "subdivision = 1\n[maps]\ndisplacement = \"height.exr\"\n"
        "displacement_mid = 0.5\ndisplacement_amplitude_mm = 8\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (const Vec3 p : loaded->objects[0].mesh.positions_mm) EXPECT_NEAR(p.z, 2, 1e-3);
}

TEST_F(RefinedMesh, a_displacement_map_that_cannot_be_read_is_named) {
    std::ofstream(directory_.path / "height.png") << "no picture";
    const Result<Scene> loaded =
        scene("[maps]\ndisplacement = \"height.png\"\ndisplacement_amplitude_mm = 8\n");
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, testing::HasSubstr("height.png"));
}
