// A scene's head by the shaders of Unity's and Unreal's packages, which unity_head and unreal_head draw,
// against Dermis' picture. Unreal needs python3.

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engines/head_package.h"
#include "test_paths.h"

using namespace dermis;
using namespace dermis::head_package;

namespace {

namespace fs = std::filesystem;

class DrawnHead : public HeadPackage {
  protected:
    void SetUp() override {
        if (engine() == "unreal" && !has_program("python3")) GTEST_SKIP() << "no python3 here";
    }
    void export_package() {
        const ProgramResult made =
            shell(DERMIS_PROGRAM " export --engine " + engine() + " " + scene_ + " -o " + path("package"));
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    ProgramResult draw_one(const std::string& name, const std::string& options) {
        return shell(DERMIS_DRAWN_HEADS "/" + engine() + "_head " + path("package") + " " +
                     path(name + ".exr") + " --side 48 --points 3 " + options);
    }
    Image drawn(const std::string& name, const std::string& options) {
        const ProgramResult result = draw_one(name, options);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read(name);
    }
};
class UnrealLights : public DrawnHead {};

class MovingUnityHead : public DrawnHead {
  protected:
    void SetUp() override {}
    void expect_unity_motion(const std::string& moment) {
        export_package();
        expect_motion(
            {drawn("rest", ""), drawn("rest_lambert", "--lambert"), drawn("moved", moment),
             drawn("moved_lambert", moment + " --lambert"), drawn("mistake", moment + " --mistake frames")},
            moment, 0.3);
    }
};
INSTANTIATE_TEST_SUITE_P(, DrawnHead, testing::Values("unity", "unreal"), kName);
INSTANTIATE_TEST_SUITE_P(, UnrealLights, testing::Values("unreal"), kName);
INSTANTIATE_TEST_SUITE_P(, MovingUnityHead, testing::Values("unity"), kName);

}  // namespace

TEST_P(MovingUnityHead, plays_its_clip_and_the_bakes_turn_with_the_surface) {
    use_turned_bust();
    expect_unity_motion(" --clip greet --time 1.7");
    const ProgramResult none = draw_one("none", "--clip walk --time 1");
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_NE(none.err.find("no clip 'walk'"), std::string::npos) << none.err;
}

TEST_P(MovingUnityHead, has_the_curvature_of_its_targets) {
    use_turned_bust();
    export_package();
    const std::string moment = " --clip greet --time 3.05";
    const Image followed = drawn("followed", "--gain" + moment);
    forget_curvature_of_targets();
    expect_curvature_follows(followed, drawn("kept", "--gain" + moment), moment);
}

TEST_P(MovingUnityHead, follows_its_joints_and_targets) {
    if (!fs::exists(face())) GTEST_SKIP() << face() << " is needed";
    use_face();
    expect_unity_motion(" --clip talk --time 1.2");
}

TEST_P(DrawnHead, has_the_renderers_effect_and_a_mistake_loses_it) {
    export_package();
    for (const auto& [name, options] : {std::pair("lambert", "--lambert"),
                                        {"scattering", ""},
                                        {"gain", "--gain"},
                                        {"normals", "--mistake normals"},
                                        {"curvature", "--mistake curvature"},
                                        {"srgb", "--mistake srgb"}}) {
        const ProgramResult drawn = draw_one(name, options);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    expect_effect(engine() == "unreal" ? 0.15 : 0.25);
    if (engine() != "unreal") return;
    // In another light than that of its map the head has no shadow: most of the change is there.
    const Image scattering = read("scattering"), lambert = read("lambert");
    EXPECT_GT(distance(drawn("shadow", "--mistake shadow"), scattering), 2 * distance(scattering, lambert));
}

// A point light, and a spot whose edge crosses the head: whole pictures, the effect, and what their shadows
// take.
TEST_P(UnrealLights, from_near_are_the_renderers) {
    scene_ = path("near.toml");
    std::ofstream(scene_)
        << "[[mesh]]\nfile = \"builtin:bust\"\n[environment]\nkind = \"none\"\n"
           "[[light]]\nname = \"lamp\"\nkey = true\nkind = \"point\"\nposition_mm = [-350, 200, 40]\n"
           "intensity = 0.4\n"
           "[[light]]\nname = \"spot\"\nkind = \"spot\"\nposition_mm = [450, 250, 200]\n"
           "target_mm = [60, -20, 40]\ninner_angle_deg = 5\nouter_angle_deg = 15\nintensity = 1\n";
    export_package();
    const Image lambert = drawn("lambert", "--lambert"), own = rendered("--technique lambert"),
                nothing(48, 48, 3);
    const Image effect = change(rendered(kPreintegrated + "none"), own), scattering = drawn("scattering", "");
    const auto error_of = [&](const char* name, const Image& found, const Image& expected) {
        const double error = distance(found, expected) / distance(expected, nothing);
        RecordProperty(name, std::to_string(error));
        return error;
    };
    EXPECT_LT(error_of("picture", lambert, own), 0.03);
    EXPECT_LT(error_of("effect", change(scattering, lambert), effect), 0.25);
    EXPECT_GT(error_of("without_shadows", drawn("shadow", "--lambert --mistake shadow"), own), 0.1);
}

// Of an environment that is turned, by what is missing without them; the light is too weak to see. A map that
// the script does not bind is not bound here either.
TEST_P(DrawnHead, reflects_the_environment_and_shows_a_map_that_is_left_out) {
    scene_ = path("turned.toml");
    std::ofstream(scene_) << "background = [0, 0, 0]\n[[mesh]]\nfile = \"builtin:bust\"\n[[light]]\n"
                             "kind = \"directional\"\nintensity = 1e-6\n"
                             "[environment]\nkind = \"studio\"\nintensity = 0.8\nyaw_deg = 70\n";
    export_package();
    const Image bound = drawn("bound", "--lambert"), dull = drawn("dull", "--lambert --mistake reflections");
    const Image expected = rendered("--technique lambert --view specular"), nothing(48, 48, 3);
    const double error = distance(change(bound, dull), expected) / distance(expected, nothing);
    RecordProperty("reflections", std::to_string(error));
    EXPECT_LT(error, 0.05);

    const std::string edit = engine() == "unity"
                                 ? "sed -i '/Bind(skin, \"_BaseMap\"/d' " + path("package/Head/SkinHead.cs")
                                 : "sed -i 's/(maps.get(\"albedo\"), COLOUR)/(None, COLOUR)/' " +
                                       path("package/DermisSkin/Content/Python/dermis_head.py");
    ASSERT_EQ(shell(edit).exit_code, 0);
    EXPECT_GT(distance(drawn("unbound", "--lambert"), bound), 0.3 * distance(bound, nothing));
}

// Irradiance over pi of a turned environment, by the bands of Ramamoorthi and Hanrahan, against Unity's
// polynomial.
TEST(UnityProbe, is_the_environment_turned_and_mirrored) {
    const TemporaryDirectory directory;
    const std::string folder = directory.path.string();
    std::ofstream(folder + "/turned.toml")
        << "name = \"turned\"\n[[mesh]]\nfile = \"builtin:spheres\"\n[skin]\nprofile = \"openpbr_skin_5\"\n"
           "[environment]\nkind = \"studio\"\nintensity = 0.9\nyaw_deg = 40\n";
    const ProgramResult made = run_shell(
        DERMIS_PROGRAM " export --engine unity " + folder + "/turned.toml -o " + folder + "/package", folder);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    std::ifstream file(folder + "/package/Head/scene.json");
    const auto sky = nlohmann::json::parse(file)["environment"];
    const double yaw = sky["yaw_rad"], c = std::cos(yaw), s = std::sin(yaw);
    for (const auto& [X, Y, Z] : {std::array{0.48, 0.6, 0.64}, {-0.8, 0.0, 0.6}, {0.36, -0.8, -0.48}}) {
        const double x = -c * X - s * Z, y = Y, z = -s * X + c * Z;
        const double bands[] = {0.282095,
                                0.325735 * y,
                                0.325735 * z,
                                0.325735 * x,
                                0.273137 * x * y,
                                0.273137 * y * z,
                                0.078848 * (3 * z * z - 1),
                                0.273137 * x * z,
                                0.1365685 * (x * x - y * y)};
        const double unity[] = {1, Y, Z, X, X * Y, Y * Z, 3 * Z * Z - 1, X * Z, X * X - Y * Y};
        for (size_t channel = 0; channel < 3; ++channel) {
            double expected = 0, got = 0;
            for (size_t i = 0; i < 9; ++i) {
                expected += 0.9 * bands[i] * double(sky["radiance_sh"][i][channel]);
                got += unity[i] * double(sky["ambient_probe"][3 * i + channel]);
            }
            EXPECT_NEAR(got, expected, 1e-5);
        }
    }
}
