// A scene's head in three.js and Babylon.js, in headless Chromium on WebGL 2 and WebGPU, held against the
// reference beside Dermis' own picture; in Godot's web build, against Dermis' picture. Needs chromium, node,
// `npm ci` in tools/checks, for Godot what compile_test.cpp names; passed over without them.

#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "engines/head_package.h"
#include "engines/readme_steps.h"

using namespace dermis;
using namespace dermis::head_package;

namespace {

namespace fs = std::filesystem;

class MovingHeadPackage : public HeadPackage {
  protected:
    MovingHeadPackage() { use_turned_bust(); }
};

class FollowingHeadPackage : public MovingHeadPackage {};

class MovingFacePackage : public HeadPackage {
  protected:
    void SetUp() override {
        if (!fs::exists(face())) GTEST_SKIP() << face() << " is needed";
        use_face();
        HeadPackage::SetUp();
    }
};

class BrowserHead : public HeadPackage {};

// The head is made by the lines of the README's steps.
class GodotHead : public HeadPackage {
  protected:
    void SetUp() override {
        HeadPackage::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        const std::string page = path("package/test/head.gd");
        std::string script = *read_text_file(page), steps = script_of(readme_of("godot"));
        const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
            const size_t at = text.find(from);
            ASSERT_NE(at, std::string::npos) << from;
            text.replace(at, from.size(), to);
        };
        replace(steps, "add_child(head)\n", "\tviewport.add_child(head)\n\t");
        replace(steps, "\n    ", "\n\t\t");
        replace(script,
                "var head: Node3D = load(FOLDER + \"head/skin_head.tscn\").instantiate()\n"
                "\tviewport.add_child(head)\n",
                steps);
        ASSERT_TRUE(write_text_file(page, script));
    }
};

INSTANTIATE_TEST_SUITE_P(, BrowserHead,
                         testing::Values("three_webgl", "three_webgpu", "babylon_webgl", "babylon_webgpu"),
                         kName);
INSTANTIATE_TEST_SUITE_P(, MovingHeadPackage,
                         testing::Values("three", "three_webgpu", "babylon", "babylon_webgpu", "godot"),
                         kName);
INSTANTIATE_TEST_SUITE_P(, FollowingHeadPackage, testing::Values("three", "babylon", "godot"), kName);
INSTANTIATE_TEST_SUITE_P(, MovingFacePackage, testing::Values("godot"), kName);
INSTANTIATE_TEST_SUITE_P(, GodotHead, testing::Values("godot"), kName);

}  // namespace

TEST_P(BrowserHead, has_the_renderers_share_and_a_mistake_loses_it) {
    draw_looks({"skin", "lambert", "gain", "normals", "curvature", "levels"});
    const std::vector<Picture> pictures = {
        {"skin", "", "lambert"}, {"normals", "", "lambert"}, {"curvature", "", "lambert"}};
    const std::map<std::string, double> share = shares(pictures);
    ASSERT_EQ(share.size(), 4u);
    EXPECT_GT(share.at("skin"), 0.8 * share.at("preintegrated"));
    EXPECT_LT(share.at("normals"), share.at("skin") - 0.03);
    EXPECT_LT(share.at("curvature"), share.at("skin") - 0.03);
    const Image skin = read("skin"), nothing(48, 48, 3),
                gain = change(rendered(kPreintegrated + "curvature"), rendered(kPreintegrated + "none"));
    // Twice this where the gain's light has the visibility of the profile's.
    const double error = distance(change(read("gain"), skin), gain) / distance(gain, nothing);
    RecordProperty("gain", std::to_string(error));
    EXPECT_LT(error, 0.06);
    // Without mip levels of the baked normals a third of the effect changes: each device has the levels.
    const double lost = distance(skin, read("levels")) / distance(skin, read("lambert"));
    RecordProperty("levels", std::to_string(lost));
    EXPECT_GT(lost, 0.2);
    const ProgramResult srgb = draw({{"srgb", device() + "&mistake=srgb"}});
    EXPECT_EQ(srgb.exit_code, 1);
    EXPECT_NE(srgb.err.find("they hold directions, not colours"), std::string::npos) << srgb.err;
    for (const auto& [name, value] : share) RecordProperty(name, std::to_string(value));
}

// Where the bakes do not turn with the surface the head has light from elsewhere.
TEST_P(MovingHeadPackage, plays_its_clip_and_the_bakes_turn_with_the_surface) {
    expect_motion(draw_motion("greet", "1.7"), " --clip greet --time 1.7", 0.3);
}

TEST_P(FollowingHeadPackage, has_the_curvature_of_its_targets) {
    const std::string query = device() + "&gain&clip=greet&time=3.05";
    ProgramResult drawn = draw({{"followed", query}});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    forget_curvature_of_targets();
    drawn = draw({{"kept", query}});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    expect_curvature_follows(read("followed"), read("kept"), " --clip greet --time 3.05");
}

// Godot applies skins and targets before its shaders, without tangents.
TEST_P(MovingFacePackage, follows_its_joints_and_targets) {
    expect_motion(draw_motion("talk", "1.2"), " --clip talk --time 1.2", 0.45);
}

// shadow: without its depths the head has the engine's edges; place: its depths are those of another place.
TEST_P(GodotHead, has_the_renderers_effect_and_a_mistake_loses_it) {
    draw_looks({"scattering", "lambert", "normals", "curvature", "shadow"});
    const ProgramResult drawn =
        draw({{"gain", "gain"}, {"srgb", "mistake=srgb"}, {"place", "mistake=place"}});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;

    expect_effect(0.25, {"shadow", "place"});
    // With the engine's reflections 0.04.
    const Image own = rendered("--technique lambert");
    const double error = distance(read("lambert"), own) / distance(own, Image(48, 48, 3));
    RecordProperty("picture", std::to_string(error));
    EXPECT_LT(error, 0.03);
}
