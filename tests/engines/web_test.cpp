// The folder that `dermis export --web` writes, and its page in a browser (needs chromium and node, passed
// over without).

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/engines/web/parts.h"
#include "dermis/image/io.h"
#include "support/moving_sheet.h"
#include "support/sphere_pictures.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace fs = std::filesystem;
using namespace dermis;

namespace {

constexpr const char* kCredit = "Lee Perry-Smith";

ProgramResult run_dermis(const std::string& arguments, const fs::path& scratch) {
    return run_shell(std::string(DERMIS_PROGRAM) + " " + arguments, scratch.string());
}

std::map<std::string, std::vector<std::byte>> files_of(const fs::path& folder) {
    std::map<std::string, std::vector<std::byte>> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[fs::relative(entry.path(), folder).generic_string()] = read_file(entry.path()).value();
    return files;
}

nlohmann::json scene_of(const fs::path& folder) {
    return nlohmann::json::parse(read_text_file(folder / "scene.json").value());
}

std::string first_program(std::initializer_list<const char*> names) {
    const auto found = std::ranges::find_if(names, has_program);
    return found == names.end() ? "" : *found;
}

// EXT_texture_shared_exponent, "Decoding".
Vec3 decoded(uint32_t bits) {
    const float scale = std::ldexp(1.0f, int(bits >> 27) - 15 - 9);
    return {float(bits & 511) * scale, float(bits >> 9 & 511) * scale, float(bits >> 18 & 511) * scale};
}

class WebPageFolder : public ::testing::Test {
  protected:
    fs::path write_page(const std::string& scene) {
        const fs::path folder = directory_.path / "page";
        const ProgramResult result =
            run_dermis("export --web " + scene + " -o " + folder.string(), directory_.path);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return folder;
    }
    // The script's exit status, with what it said.
    ProgramResult run_script(const std::string& arguments) {
        const std::string chromium = first_program({"chromium", "chromium-browser", "google-chrome"});
        const std::string node = first_program({"node", "nodejs"});
        return run_shell(
            node + " " DERMIS_SOURCE_DIR "/tools/checks/web_page.mjs " + chromium + " " + arguments,
            directory_.path.string());
    }
    static bool has_browser() {
        return !first_program({"chromium", "chromium-browser", "google-chrome"}).empty() &&
               !first_program({"node", "nodejs"}).empty();
    }
    TemporaryDirectory directory_;
};

}  // namespace

TEST(SharedExponent, keeps_colours_within_a_512th_of_their_largest_channel) {
    for (const Vec3 color : {Vec3{0, 0, 0}, Vec3{1, 0.5f, 0.25f}, Vec3{0.999f, 0.01f, 0}, Vec3{7e4f, 3, 1},
                             Vec3{1e-7f, 0, 0}, Vec3{0.7f, -1, 0.3f}}) {
        const Vec3 back = decoded(web::shared_exponent(color));
        const auto held = [](float value) { return std::clamp(value, 0.0f, 65408.0f); };
        const float bound = std::max({held(color.x), held(color.y), held(color.z), 1e-4f}) / 512;
        EXPECT_NEAR(back.x, held(color.x), bound);
        EXPECT_NEAR(back.y, held(color.y), bound);
        EXPECT_NEAR(back.z, held(color.z), bound);
    }
}

TEST_F(WebPageFolder, has_all_that_it_names_and_the_same_bytes_twice) {
    const auto first = files_of(write_page("spheres"));
    for (const char* name : {"index.html", "page.js", "skin.frag", "skin.essl", "shared.glsl", "scene.json",
                             "scene.bin", "LICENSE.txt", "README.md"})
        EXPECT_TRUE(first.contains(name)) << name;
    EXPECT_EQ(files_of(write_page("spheres")), first);
    const nlohmann::json scene = scene_of(directory_.path / "page");
    EXPECT_EQ(scene["tones"].size(), 7u);
    EXPECT_EQ(scene["tones"][0]["description"], "gpu_gems_3");
    EXPECT_EQ(scene["tones"][6]["description"], "openpbr_skin_6");
    EXPECT_EQ(scene["credit"], "");
    for (const auto& object : scene["objects"])
        for (const auto& part : object["parts"])
            for (const auto& [name, path] : part["material"]["maps"].items())
                EXPECT_TRUE(first.contains(path.get<std::string>())) << path;
}

TEST_F(WebPageFolder, has_the_profile_that_was_asked_for) {
    const fs::path folder = directory_.path / "page";
    const ProgramResult result =
        run_dermis("export --web spheres --profile openpbr_skin_5 -o " + folder.string(), directory_.path);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(scene_of(folder)["tones"][0]["description"], "openpbr_skin_5");
}

TEST_F(WebPageFolder, carries_the_credit_of_a_scan) {
    const std::string help =
        run_dermis("render head_scan_1k --size 8x8 -o " + directory_.path.string() + "/a.png",
                   directory_.path)
            .err;
    if (help.find("get_head") != std::string::npos) GTEST_SKIP() << "no head scan here";
    const std::string credit = scene_of(write_page("head_scan_1k"))["credit"];
    EXPECT_NE(credit.find(kCredit), std::string::npos) << credit;
}

// What an image has beyond its edges; maps that are packed into one picture have to agree.
TEST_F(WebPageFolder, keeps_the_wrap_modes_of_maps_and_refuses_those_that_it_cannot) {
    const fs::path folder = directory_.path;
    Image image(8, 8, 3, PixelFormat::u8);
    ASSERT_TRUE(write_image(folder / "map.png", image));
    ASSERT_TRUE(
        write_text_file(folder / "quad.obj",
                        "mtllib quad.mtl\nv -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nvt 0 0\nvt 2 0\nvt 2 2\n"
                        "vt 0 2\nvn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"));
    const auto write_material = [&](const std::string& lines) {
        ASSERT_TRUE(write_text_file(folder / "quad.mtl", "newmtl skin\n" + lines));
    };
    ASSERT_TRUE(
        write_text_file(folder / "quad.toml",
                        "[[mesh]]\nfile = \"quad.obj\"\nunit_mm = 1\n[skin]\nprofile = \"gpu_gems_3\"\n"
                        "[[light]]\nyaw_deg = 20\n"));
    write_material("map_Kd -clamp on map.png\nmap_Pr map.png\n");
    const nlohmann::json material =
        scene_of(write_page((folder / "quad.toml").string()))["objects"][0]["parts"][0]["material"];
    EXPECT_EQ(material["wraps"], (nlohmann::json{{"albedo", {"clamp", "clamp"}}}));
    EXPECT_TRUE(material["maps"].contains("surface"));

    write_material("map_Pr -clamp on map.png\nmap_Ks map.png\n");
    const ProgramResult refused = run_dermis(
        "export --web " + (folder / "quad.toml").string() + " -o " + (folder / "b").string(), folder);
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_NE(refused.err.find("do not wrap alike"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder / "b/index.html"));
}

TEST_F(WebPageFolder, refuses_a_skin_whose_reflection_takes_from_its_diffuse_light) {
    const fs::path folder = directory_.path / "page";
    const ProgramResult refused =
        run_dermis("export --web spheres --scene skin.specular_reduces_diffuse=true -o " + folder.string(),
                   directory_.path);
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_NE(refused.err.find("skin.specular_reduces_diffuse=false"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder / "index.html"));
}

TEST_F(WebPageFolder, a_folder_that_cannot_be_written_is_refused_before_any_work) {
    const fs::path file = directory_.path / "file";
    ASSERT_TRUE(write_text_file(file, "in the way"));
    const ProgramResult result =
        run_dermis("export --web no_such_scene -o " + file.string(), directory_.path);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_NE(result.err.find(file.string()), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("no_such_scene"), std::string::npos) << result.err;
}

TEST_F(WebPageFolder, unknown_scenes_and_profiles_leave_nothing_behind) {
    const fs::path folder = directory_.path / "page";
    for (const char* wrong : {"no_such_scene", "spheres --profile no_such_profile"}) {
        const ProgramResult result =
            run_dermis("export --web " + std::string(wrong) + " -o " + folder.string(), directory_.path);
        EXPECT_NE(result.exit_code, 0);
        EXPECT_NE(result.err.find("no_such"), std::string::npos) << result.err;
        EXPECT_FALSE(fs::exists(folder / "index.html"));
    }
    const ProgramResult both =
        run_dermis("export --web --language hlsl -o " + folder.string(), directory_.path);
    EXPECT_NE(both.exit_code, 0);
}

TEST_F(WebPageFolder, of_the_bust_is_below_two_megabytes) {
    size_t bytes = 0, motion_bytes = 0;
    for (const auto& [path, content] : files_of(write_page("bust")))
        (path == "motion.bin" ? motion_bytes : bytes) += content.size();
    EXPECT_LT(bytes, 2'000'000u);
    EXPECT_LT(motion_bytes, 400'000u);
    EXPECT_GT(bytes, 1'000'000u);
}

TEST_F(WebPageFolder, in_a_browser_its_controls_change_the_picture) {
    if (!has_browser()) GTEST_SKIP() << "no chromium or no node here";
    const fs::path folder = write_page("spheres");
    const ProgramResult good = run_script("drive " + folder.string());
    EXPECT_EQ(good.exit_code, 0) << good.err;
    // The check can fail: a page that forgets the wipe.
    const std::string renderer = read_text_file(folder / "renderer.js").value();
    std::string broken = renderer;
    const std::string wipe = "wipe * canvas.width";
    ASSERT_NE(broken.find(wipe), std::string::npos);
    broken.replace(broken.find(wipe), wipe.size(), "0.5 * canvas.width");
    ASSERT_TRUE(write_text_file(folder / "renderer.js", broken));
    const ProgramResult bad = run_script("drive " + folder.string());
    EXPECT_EQ(bad.exit_code, 1) << bad.err;
    EXPECT_NE(bad.err.find("wipe"), std::string::npos) << bad.err;
}

TEST_F(WebPageFolder, in_a_browser_a_sphere_of_8_mm_is_the_renderers_own) {
    if (!has_browser()) GTEST_SKIP() << "no chromium or no node here";
    constexpr int kSphereSide = 320, kBound = 2;
    const fs::path folder = write_page(DERMIS_SOURCE_DIR "/tests/engines/web_sphere_8mm.toml");
    const fs::path ours = directory_.path / "ours.png", theirs = directory_.path / "theirs.png";
    const std::string size = std::to_string(kSphereSide) + "x" + std::to_string(kSphereSide);
    const ProgramResult drawn = run_dermis(
        "render " DERMIS_SOURCE_DIR
        "/tests/engines/web_sphere_8mm.toml --technique preintegrated --set specular=two_lobe_ggx --set "
        "transmission=none --size " +
            size + " -o " + ours.string(),
        directory_.path);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const ProgramResult shot =
        run_script("shot " + folder.string() + " " + std::to_string(kSphereSide) + " " + theirs.string());
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    const Image a = read_image(ours, ImageUse::color)->image, b = read_image(theirs, ImageUse::color)->image;
    ASSERT_EQ(b.width, kSphereSide);
    const SphereDifference difference = sphere_difference(a, b);
    EXPECT_GT(difference.pixels, 30'000);
    EXPECT_LE(difference.largest_level, kBound);
}

// A light and a camera of its own, so that no pose changes the view.
class MovingPage : public WebPageFolder {
  protected:
    fs::path write_scene(const std::string& mesh, const std::string& camera) {
        const fs::path file = directory_.path / "moving.toml";
        EXPECT_TRUE(
            write_text_file(file, "[[mesh]]\nfile = \"" + mesh +
                                      "\"\n[skin]\nprofile = \"openpbr_skin_3\"\nroughness = 1\n[[light]]\n"
                                      "yaw_deg = 40\npitch_deg = 30\n[camera]\n" +
                                      camera + "\n"));
        return file;
    }
    Image ours(const fs::path& scene, const std::string& pose) {
        const fs::path path = directory_.path / "ours.png";
        const ProgramResult drawn = run_dermis(
            "render " + scene.string() + " " + pose +
                " --technique preintegrated --set specular=two_lobe_ggx --set transmission=none --set "
                "normals=blended --size 256x256 -o " +
                path.string(),
            directory_.path);
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return read_image(path, ImageUse::color)->image;
    }
    std::vector<Image> theirs(const fs::path& folder, const std::vector<std::string>& queries) {
        std::vector<fs::path> paths;
        std::string arguments = "shot " + folder.string() + " 256";
        for (const std::string& query : queries) {
            paths.push_back(directory_.path / ("theirs_" + std::to_string(paths.size()) + ".png"));
            arguments += " '" + paths.back().string() + "?" + query + "'";
        }
        const ProgramResult shot = run_script(arguments);
        EXPECT_EQ(shot.exit_code, 0) << shot.err;
        std::vector<Image> images;
        for (const fs::path& path : paths) images.push_back(read_image(path, ImageUse::color)->image);
        return images;
    }
    // The part of the change from `rest` to `posed` that another renderer does not draw: 0 the same, 1
    // nothing moves.
    static double missed(const Image& rest, const Image& posed, const Image& other_rest,
                         const Image& other_posed) {
        double error = 0, change = 0;
        for (int y = 0; y < rest.height; ++y)
            for (int x = 0; x < rest.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const float ours = posed.at(x, y, c) - rest.at(x, y, c);
                    error += std::abs(other_posed.at(x, y, c) - other_rest.at(x, y, c) - ours);
                    change += std::abs(ours);
                }
        return error / change;
    }
};

TEST_F(MovingPage, in_a_browser_a_pose_of_a_clip_is_the_renderers) {
    if (!has_browser()) GTEST_SKIP() << "no chromium or no node here";
    ASSERT_TRUE(write_text_file(directory_.path / "sheet.gltf", test::moving_sheet()));
    for (const auto& [clip, mesh, camera] :
         {std::tuple{"nod", "sheet.gltf", "eye_mm = [60, 40, 500]\ntarget_mm = [0, 0, 20]"},
          {"greet", "builtin:bust", "eye_mm = [150, 20, 500]\ntarget_mm = [0, -20, 40]"}}) {
        const fs::path scene = write_scene(mesh, camera), folder = write_page(scene.string());
        const std::vector<Image> pictures = theirs(folder, {"", std::string("clip=") + clip + "&time=1.7"});
        const Image &rest = pictures[0], &posed = pictures[1];
        ASSERT_EQ(posed.width, 256);
        const Image our_rest = ours(scene, ""),
                    our_posed = ours(scene, std::string("--clip ") + clip + " --time 1.7");
        // The page's bust has fewer triangles and smaller maps than the scene's.
        EXPECT_LT(missed(our_rest, our_posed, rest, posed), mesh == std::string("builtin:bust") ? 0.45 : 0.2)
            << clip;
        EXPECT_GT(missed(our_rest, our_posed, rest, rest), 0.9) << clip << ": a page that stays";
    }
}

TEST_F(MovingPage, in_a_browser_has_the_curvature_of_its_targets) {
    if (!has_browser()) GTEST_SKIP() << "no chromium or no node here";
    ASSERT_TRUE(write_text_file(directory_.path / "sheet.gltf", test::moving_sheet()));
    const fs::path scene = write_scene("sheet.gltf", "eye_mm = [60, 40, 500]\ntarget_mm = [0, 0, 20]"),
                   folder = write_page(scene.string());
    const std::string moment = "clip=nod&time=1.7", ours_then = "--clip nod --time 1.7";
    const Image followed = theirs(folder, {moment})[0];
    auto json = scene_of(folder);
    auto& target = json["objects"][0]["motion"]["meshes"][0]["primitives"][0]["targets"][0];
    EXPECT_EQ(target.erase("CURVATURE"), 1u);
    ASSERT_TRUE(write_text_file(folder / "scene.json", json.dump()));
    const Image kept = theirs(folder, {moment})[0];
    const Image our_kept = ours(scene, ours_then + " --scene animation.rest_bakes=curvature"),
                our_posed = ours(scene, ours_then);
    const double error = missed(our_kept, our_posed, kept, followed);
    RecordProperty("error", std::to_string(error));
    // Less would be missed where the curvatures in all directions change alike: the page has the change of
    // their mean.
    EXPECT_LT(error, 0.85) << "1 where the curvature stays";
}

TEST_F(MovingPage, in_a_browser_plays_and_pauses_its_clips) {
    if (!has_browser()) GTEST_SKIP() << "no chromium or no node here";
    ASSERT_TRUE(write_text_file(directory_.path / "sheet.gltf", test::moving_sheet()));
    const fs::path folder = write_page((directory_.path / "sheet.gltf").string());
    const ProgramResult good = run_script("clips " + folder.string());
    EXPECT_EQ(good.exit_code, 0) << good.err;
    // The check can fail: a page that forgets the pose.
    std::string motion = read_text_file(folder / "motion.js").value();
    const std::string pose = "one.pose(name, time_s)";
    ASSERT_NE(motion.find(pose), std::string::npos);
    motion.replace(motion.find(pose), pose.size(), "one.pose(name, 0)");
    ASSERT_TRUE(write_text_file(folder / "motion.js", motion));
    EXPECT_EQ(run_script("clips " + folder.string()).exit_code, 1);
}

TEST_F(MovingPage, has_motion_only_of_what_moves) {
    const fs::path folder = write_page("spheres");
    EXPECT_FALSE(fs::exists(folder / "motion.bin"));
    for (const auto& object : scene_of(folder)["objects"]) EXPECT_FALSE(object.contains("motion"));
    fs::remove_all(folder);
    const nlohmann::json motion = scene_of(write_page("bust"))["objects"][0]["motion"];
    EXPECT_EQ(motion["animations"][0]["name"], "greet");
    EXPECT_TRUE(fs::exists(folder / "motion.bin"));
}

// The sheet with so many copies of its target that two megabytes do not hold them.
TEST_F(MovingPage, keeps_the_scenes_pose_where_the_motion_is_too_large) {
    constexpr int kTargets = 2400;
    nlohmann::json sheet = nlohmann::json::parse(test::moving_sheet());
    nlohmann::json& mesh = sheet["meshes"][0];
    mesh["primitives"][0]["targets"] =
        nlohmann::json(kTargets, nlohmann::json(mesh["primitives"][0]["targets"][0]));
    mesh["weights"] = nlohmann::json(kTargets, nlohmann::json(0.001));
    mesh.erase("extras");
    sheet["animations"][0]["channels"].erase(0);
    ASSERT_TRUE(write_text_file(directory_.path / "large.gltf", sheet.dump()));
    const fs::path folder = directory_.path / "page";
    const ProgramResult made =
        run_dermis("export --web " + (directory_.path / "large.gltf").string() + " -o " + folder.string(),
                   directory_.path);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.err.find("the page shows the scene's pose alone: its clips would take "),
              std::string::npos)
        << made.err;
    EXPECT_FALSE(fs::exists(folder / "motion.bin"));
    EXPECT_FALSE(scene_of(folder)["objects"][0].contains("motion"));
}
