// Files: dropped, and followed while they change.

#include <gmock/gmock.h>

#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/write_mesh.h"
#include "test_paths.h"
#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Image plain(int width, int height, Vec3 color) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, (&color.x)[c]);
    return image;
}

}  // namespace

TEST_F(ViewWindow, dropped_scenes_and_meshes_are_opened_and_other_files_make_a_notice) {
    Result<LoadedMesh> mesh = read_mesh(square());
    ASSERT_TRUE(mesh) << mesh.error().message;
    mesh->mesh.materials[0].base_color_map = {};
    ASSERT_TRUE(write_glb(path("square.glb"), mesh->mesh));
    ASSERT_TRUE(write_text_file(path("scene.toml"), "[[mesh]]\nfile = \"square.obj\"\n"));
    ASSERT_TRUE(write_text_file(path("broken.toml"), "[[mesh]]\nfile = 3\n"));
    std::string script;
    for (const char* name : {"square.obj", "square.glb", "scene.toml"})
        script += std::string("drop DIR/") + name + "\nsettle\nprint\n";
    const ProgramResult result =
        view(kSmall, script +
                         "drop DIR/broken.toml\nsettle\nprint\ndrop DIR/nowhere.hdr\nsettle\nprint\n"
                         "key escape\nwait 1\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const char* name : {"square.obj", "square.glb", "scene.toml"})
        EXPECT_THAT(result.out, HasSubstr("scene " + path(name) + "\n"));
    EXPECT_THAT(result.out, HasSubstr("warning " + path("square.glb") + ": no map of colour"));
    EXPECT_THAT(result.out, HasSubstr("notice " + path("broken.toml")));
    EXPECT_THAT(result.out, Not(HasSubstr("notice " + path("scene.toml"))));
    EXPECT_THAT(result.out, Not(HasSubstr("warning " + path("square.obj"))));
    EXPECT_THAT(result.out, HasSubstr("broken.toml:2: mesh.file"));
    EXPECT_THAT(result.out, HasSubstr("nowhere.hdr"));
    EXPECT_THAT(last_state(result), Not(HasSubstr("notice")));  // escape closed it
    EXPECT_THAT(last_state(result), HasSubstr("environment studio\n"));
}

TEST_F(ViewWindow, a_path_is_typed_completed_by_tab_and_opened_by_enter) {
    (void)square();
    ASSERT_TRUE(write_text_file(path("scene.toml"), "[[mesh]]\nfile = \"square.obj\"\n"));
    const ProgramResult result = view(kSmall, R"(
        settle
        key ctrl+O
        wait 2
        type DIR/sq
        key tab
        wait 1
        capture DIR/field.png
        key enter
        settle
        print
        key ctrl+O
        wait 2
        type scene.toml
        key escape
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("scene " + path("square.obj") + "\n"));
    EXPECT_EQ(result.out.find("scene " + path("scene.toml")), std::string::npos);
}

TEST_F(ViewWindow, a_script_draws_over_no_map_of_the_scene) {
    const std::string mesh = square();
    const Result<std::string> before = read_text_file(path("white.png"));
    const ProgramResult result =
        view(mesh + " --size 160x120",
             "screenshot DIR/../" + directory_.path.filename().string() + "/white.png\nquit\n");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("white.png: is an input of this command"));
    EXPECT_EQ(*read_text_file(path("white.png")), *before);
}

TEST_F(ViewWindow, dropped_panoramas_become_the_environment_and_other_pictures_the_right_side) {
    ASSERT_TRUE(write_image(path("red.hdr"), plain(16, 8, {2, 0, 0})));
    ASSERT_TRUE(write_image(path("green.exr"), plain(16, 8, {0, 2, 0})));
    ASSERT_TRUE(write_image(path("reference.exr"), plain(16, 16, {0.5f, 0.5f, 0.5f})));
    ASSERT_TRUE(write_text_file(path("torn.exr"), "no picture"));
    const ProgramResult result = view(square() + " --size 560x320 --samples 1 -t lambert", R"(
        drop DIR/red.hdr
        settle
        screenshot DIR/red.png
        drop DIR/green.exr
        settle
        screenshot DIR/green.png
        drop DIR/torn.exr
        settle
        print
        drop DIR/reference.exr
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Image red = image("red.png"), green = image("green.png");
    const int x = red.width / 2, y = red.height / 2;
    EXPECT_GT(red.at(x, y, 0), green.at(x, y, 0) + 0.05f);
    EXPECT_LT(red.at(x, y, 1), green.at(x, y, 1) - 0.05f);
    EXPECT_EQ(value_of(result, "environment"), path("green.exr"));
    EXPECT_THAT(value_of(result, "notice"), HasSubstr("torn.exr"));
    EXPECT_THAT(last_state(result), HasSubstr("right " + path("reference.exr") + "\n"));
    EXPECT_THAT(last_state(result), HasSubstr("environment " + path("green.exr") + "\n"));
}

TEST_F(ViewWindow, a_broken_shader_is_reported_and_the_last_good_one_stays_until_it_is_corrected) {
    const std::string source = DERMIS_SOURCE_DIR;
    ASSERT_EQ(shell("mkdir " + path("root") + " && cp -r " + source + "/shaders " + source + "/techniques " +
                    path("root"))
                  .exit_code,
              0);
    ASSERT_TRUE(write_text_file(path("broken.frag"), "#version 460\nvoid main() { colour = 1; }\n"));
    // Compiles, but does not fit its pass.
    ASSERT_TRUE(write_text_file(path("alien.frag"),
                                "#version 460\nlayout(location = 0) in vec4 nobody;\n"
                                "layout(location = 0) out vec4 c;\nvoid main() { c = nobody; }\n"));
    Result<std::string> good = read_text_file(source + "/shaders/renderer/tone_map.frag");
    ASSERT_TRUE(good);
    const size_t alpha = good->rfind("1.0)");
    ASSERT_NE(alpha, std::string::npos);
    const std::string target = path("root") + "/shaders/renderer/tone_map.frag";
    ASSERT_TRUE(write_text_file(path("red.frag"), good->replace(alpha, 4, "1.0) * vec4(1, 0, 0, 1)")));
    const ProgramResult result =
        view(square() + " --size 560x320 --samples 1 -t lambert --shaders " + path("root"),
             "settle\nscreenshot DIR/before.png\ncopy DIR/broken.frag " + target +
                 "\nwait 14\nprint\ndrag left 90 90 99 90\nsettle\n"
                 "screenshot DIR/still.png\ncopy DIR/alien.frag " +
                 target + "\nwait 14\nsettle\nscreenshot DIR/alien.png\ncopy DIR/red.frag " + target +
                 "\nwait 14\nsettle\nscreenshot DIR/red.png\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(value_of(result, "notice"), HasSubstr("tone_map.frag:2"));
    EXPECT_NE(image("before.png").bytes, image("still.png").bytes);  // the drag was drawn
    EXPECT_EQ(image("still.png").bytes, image("alien.png").bytes);
    const Image red = image("red.png");
    EXPECT_GT(red.at(5, 5, 0), 0);
    EXPECT_EQ(red.at(5, 5, 1), 0);
    EXPECT_THAT(last_state(result), Not(HasSubstr("notice")));
}

TEST_F(ViewWindow, a_scene_file_is_followed_and_saved_with_what_was_changed) {
    ASSERT_TRUE(
        write_text_file(path("a.toml"), "name = \"A\" # first\n[[mesh]]\nfile = \"builtin:spheres\"\n"));
    ASSERT_TRUE(write_text_file(path("b.toml"), "exposure_ev = 2\n[[mesh]]\nfile = \"builtin:spheres\"\n"));
    ASSERT_TRUE(write_text_file(path("c.toml"), "exposure_ev = \n"));
    const ProgramResult result = view(path("a.toml") + " --size 560x320 --samples 1 -t wrap", R"(
        set wrap=0.125
        drag left 90 90 120 80
        save DIR/saved.toml
        copy DIR/c.toml DIR/a.toml
        wait 14
        print
        copy DIR/b.toml DIR/a.toml
        wait 14
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("a.toml:1: not TOML"));
    const std::string last = last_state(result);
    EXPECT_THAT(last, HasSubstr("exposure_ev 2\n"));
    EXPECT_THAT(last, Not(HasSubstr("not TOML")));
    EXPECT_THAT(last, HasSubstr("camera " + value_of(result, "camera")));  // the view stayed
    const Result<std::string> saved = read_text_file(path("saved.toml"));
    ASSERT_TRUE(saved);
    EXPECT_THAT(*saved, HasSubstr("name = \"A\" # first"));
    EXPECT_THAT(*saved, HasSubstr("wrap = 0.125"));
    EXPECT_TRUE(std::filesystem::exists(path("state") + "/dermis/view.toml"));
}

TEST_F(ViewWindow, meshes_maps_and_environments_are_followed_and_the_last_good_ones_stay) {
    const Result<std::string> whole = read_text_file(square());
    ASSERT_TRUE(whole);
    std::string smaller = *whole;
    for (size_t at; (at = smaller.find("100")) != smaller.npos;) smaller.replace(at, 3, "80");
    ASSERT_TRUE(write_text_file(path("smaller.obj"), smaller));
    ASSERT_TRUE(write_text_file(path("torn.obj"), "v 0 0\n"));
    ASSERT_TRUE(write_image(path("skin.png"), plain(4, 4, {0.6f, 0.3f, 0.3f})));
    ASSERT_TRUE(write_image(path("blue.png"), plain(4, 4, {0.1f, 0.1f, 0.8f})));
    ASSERT_TRUE(write_text_file(path("torn.png"), "no picture"));
    ASSERT_TRUE(write_image(path("around.hdr"), plain(16, 8, {0.2f, 0.2f, 0.2f})));
    ASSERT_TRUE(write_image(path("green.hdr"), plain(16, 8, {0, 6, 0})));
    ASSERT_TRUE(write_text_file(path("scene.toml"),
                                "[[mesh]]\nfile = \"square.obj\"\n[maps]\nalbedo = \"skin.png\"\n"
                                "[environment]\nfile = \"around.hdr\"\n"));
    const ProgramResult result = view(path("scene.toml") + " --size 560x320 --samples 1 -t lambert", R"(
        drag left 90 90 94 90
        key ]
        settle
        screenshot DIR/first.png
        copy DIR/torn.obj DIR/square.obj
        wait 14
        settle
        print
        screenshot DIR/torn_mesh.png
        copy DIR/smaller.obj DIR/square.obj
        wait 14
        settle
        screenshot DIR/smaller.png
        copy DIR/torn.png DIR/skin.png
        wait 14
        settle
        print
        copy DIR/blue.png DIR/skin.png
        wait 14
        settle
        screenshot DIR/blue.png
        copy DIR/green.hdr DIR/around.hdr
        wait 14
        settle
        screenshot DIR/green.png
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(value_of(result, "notice"), HasSubstr("square.obj:1"));
    EXPECT_THAT(result.out, HasSubstr("skin.png: no known image format"));
    EXPECT_THAT(last_state(result), Not(HasSubstr("notice")));
    const Image first = image("first.png"), torn = image("torn_mesh.png"), small = image("smaller.png"),
                blue = image("blue.png"), green = image("green.png");
    EXPECT_TRUE(first.bytes == torn.bytes);
    const int x = first.width / 2, y = first.height / 2, edge = first.height * 19 / 100;
    EXPECT_GT(first.at(x, edge, 0), small.at(x, edge, 0) + 0.1f);  // there it is the background
    EXPECT_GT(small.at(x, y, 0), small.at(x, y, 2));
    EXPECT_LT(blue.at(x, y, 0), blue.at(x, y, 2));
    EXPECT_GT(green.at(x, y, 1), blue.at(x, y, 1) + 0.05f);
    // What was changed by hand stayed.
    EXPECT_THAT(last_state(result), HasSubstr("camera " + value_of(result, "camera")));
    EXPECT_THAT(last_state(result), HasSubstr("exposure_ev 0.33"));
}

}  // namespace dermis
