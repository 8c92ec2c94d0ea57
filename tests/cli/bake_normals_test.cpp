// dermis bake normals, as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/image/io.h"
#include "dermis/optics/preintegration.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

constexpr double kRadiusMm = 4;  // of the unit scene

class BakeNormals : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(directory_.path / "sphere.toml")
            << "[[mesh]]\nfile = \"builtin:unit\"\nshape = \"sphere\"\n"
               "[skin]\nprofile = \"gpu_gems_3\"\n";
    }
    ProgramResult bake(const std::string& arguments) {
        return run_shell(
            "cd " + directory_.path.string() + " && " + DERMIS_PROGRAM + " bake normals " + arguments,
            directory_.path.string());
    }
    Image picture(const std::string& name) {
        auto loaded = read_image(directory_.path / name, ImageUse::data);
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? std::move(loaded->image) : Image();
    }
    nlohmann::json sidecar(const std::string& name) {
        return nlohmann::json::parse(slurp((directory_.path / name).string()), nullptr, false);
    }

    TemporaryDirectory directory_;
};

Vec3 normal_at(const Image& map, int x, int y) {
    return {map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)};
}

}  // namespace

// Exact: on a sphere the mean normal is as long as the profile's mean cosine on it.
TEST_F(BakeNormals, of_a_sphere_are_as_long_as_the_profiles_mean_cosine) {
    const ProgramResult result = bake("sphere.toml --size 256 -o maps/n.exr");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out,
                testing::StartsWith("maps/n_red.exr\nmaps/n_green.exr\nlaid out by the UVs of the file"));
    const Rgb expected = preintegrated_mean_cosine(gpu_gems_3_skin(), kRadiusMm);
    for (const auto& [name, channel] : {std::pair{"red", 0}, std::pair{"green", 1}}) {
        const std::string file = std::string("maps/n_") + name + ".exr";
        const nlohmann::json said = sidecar(file + ".json");
        ASSERT_TRUE(said.is_object());
        const float own = said["own_normal_weight"][name];
        const Image map = picture(file);
        ASSERT_EQ(map.width, 256);
        // Along the equator; the stored normal has the direction of the point's own.
        for (int x = 20; x < 240; x += 20) {
            const float stored = length(normal_at(map, x, 128));
            EXPECT_NEAR(own + (1 - own) * stored, expected[size_t(channel)], 0.003) << name << " at " << x;
        }
    }
}

TEST_F(BakeNormals, say_what_their_numbers_are) {
    ASSERT_EQ(bake("sphere.toml --size 64 --profile jensen_skin1 -o n.png").exit_code, 0);
    const nlohmann::json red = sidecar("n_red.png.json"), green = sidecar("n_green.png.json");
    ASSERT_TRUE(red.is_object() && green.is_object());
    EXPECT_EQ(red["kind"], "normals");
    EXPECT_EQ(red["channel"], "red");
    EXPECT_EQ(green["channel"], "green");
    EXPECT_EQ(red["profile"], "jensen_skin1");
    EXPECT_EQ(red["encoding"], "x * 0.5 + 0.5");
    EXPECT_EQ(red["width"], 64);
    EXPECT_TRUE(green["own_normal_weight"].contains("blue"));
    ASSERT_EQ(bake("sphere.toml --size 64 --profile jensen_skin1 -o n.exr").exit_code, 0);
    EXPECT_EQ(sidecar("n_red.exr.json")["encoding"], "linear");
    const Image png = picture("n_red.png"), exr = picture("n_red.exr");
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(2 * png.at(30, 30, c) - 1, exr.at(30, 30, c), 1e-4) << c;
}

TEST_F(BakeNormals, are_all_written_or_none) {
    fs::create_directory(directory_.path / "n_green.exr.json");
    const ProgramResult result = bake("sphere.toml --size 64 -o n.exr");
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("n_green.exr.json"));
    for (const char* name : {"n_red.exr", "n_green.exr", "n_red.exr.json"})
        EXPECT_FALSE(fs::exists(directory_.path / name)) << name;
}

TEST_F(BakeNormals, refuse_other_formats_and_sizes) {
    EXPECT_THAT(bake("sphere.toml --size 64 -o n.jpg").err, HasSubstr(".exr or .png"));
    EXPECT_THAT(bake("sphere.toml --size 8 -o n.exr").err, HasSubstr("16 to 8192"));
    EXPECT_NE(bake("sphere.toml --size 8 -o n.exr").exit_code, 0);
}
