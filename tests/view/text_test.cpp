// The window's texts: changed scene files, views as command lines, its state file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "dermis/scene/scene_words.h"
#include "dermis/view/path_completion.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/state_file.h"
#include "dermis/view/view_line.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

namespace dermis::view {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct Viewed {
    Scene scene;
    Model model;
    Viewed()
        : model{.catalog = built_in_catalog(),
                .choices = {TechniqueChoice(built_in_catalog().techniques.front()),
                            TechniqueChoice(built_in_catalog().techniques.front())}} {
        Result<Scene> loaded = load_built_in_scene("builtin:spheres");
        EXPECT_TRUE(loaded);
        scene = std::move(*loaded);
        model.scene = &scene;
        model.scene_path = "builtin:spheres";
    }
};

TEST(EditToml, replaces_adds_and_takes_out_and_leaves_the_rest) {
    const std::string text =
        "# head\nname = \"a # b\"  # the name\n\n[[light]]\nyaw_deg = 1 # first\n[[light]]\nyaw_deg = 2\n"
        "[camera]   # eye\ntarget_mm = [1,\n  2, # two\n  3]  # end\neye_mm = [0, 0, 1]\n";
    const std::string edited = edit_toml(text, {{"", "name", "\"c\""},
                                                {"", "exposure_ev", "0.5"},
                                                {"light", "yaw_deg", "7", 1},
                                                {"camera", "target_mm", "[4, 5, 6]"},
                                                {"camera", "eye_mm", ""},
                                                {"skin", "profile", "\"x\""}});
    EXPECT_EQ(
        edited,
        "# head\nname = \"c\"  # the name\nexposure_ev = 0.5\n\n[[light]]\nyaw_deg = 1 # first\n[[light]]\n"
        "yaw_deg = 7\n[camera]   # eye\ntarget_mm = [4, 5, 6]  # end\n\n[skin]\nprofile = \"x\"\n");
}

TEST(EditToml, finds_the_section_of_a_material_however_its_name_is_quoted) {
    const std::string text =
        "[material.'M Lips']\nclass = \"skin\"\n[material.\"a.]b\" ] # x\n[material.eye]\n";
    EXPECT_EQ(edit_toml(text, {{"material.\"M Lips\"", "class", "\"mouth\""},
                               {"material.\"a.]b\"", "visible", "false"},
                               {"material.eye.maps", "albedo", "\"e.png\""}}),
              "[material.'M Lips']\nclass = \"mouth\"\n[material.\"a.]b\" ] # x\nvisible = false\n\n"
              "[material.eye]\n\n[material.eye.maps]\nalbedo = \"e.png\"\n");
}

TEST(EditToml, a_second_edit_of_the_same_changes_nothing_more) {
    const std::vector<TomlEdit> edits = {{"camera", "yaw_deg", "3"}, {"", "technique", "\"wrap\""}};
    const std::string once = edit_toml("[[mesh]]\nfile = \"a.obj\"\n", edits);
    EXPECT_EQ(edit_toml(once, edits), once);
}

TEST(SceneText, a_saved_built_in_reads_back_as_what_was_seen) {
    Viewed viewed;
    viewed.scene.exposure_ev = 0.25f;
    ASSERT_TRUE(set_section(viewed.scene, "camera", "yaw_deg=31 pitch_deg=-4 distance_mm=222"));
    viewed.scene.skin.profile = "jensen_skin2";
    const TemporaryDirectory directory;
    const Result<std::string> text = scene_text(viewed.model, directory.path);
    ASSERT_TRUE(text) << text.error().message;
    const auto file = directory.path / "saved.toml";
    ASSERT_TRUE(write_text_file(file, *text));
    const Result<Scene> again = load_built_in_scene(file.string());
    ASSERT_TRUE(again) << again.error().message << "\n" << *text;
    EXPECT_EQ(camera_text(again->camera), camera_text(viewed.scene.camera));
    EXPECT_EQ(light_text(again->key_light()), light_text(viewed.scene.key_light()));
    EXPECT_EQ(again->lights.size(), viewed.scene.lights.size());
    EXPECT_EQ(again->exposure_ev, 0.25f);
    EXPECT_EQ(again->skin.profile, "jensen_skin2");
    EXPECT_EQ(again->technique, built_in_catalog().techniques.front().id);
}

TEST(SceneText, a_saved_scene_keeps_the_tone_and_pigments_of_its_file_once) {
    const TemporaryDirectory directory;
    const auto file = directory.path / "scene.toml";
    for (const char* stated : {"tone = 5", "melanin = 0.2"}) {
        ASSERT_TRUE(write_text_file(file, "[[mesh]]\nfile = \"builtin:spheres\"\n[skin]\n" +
                                              std::string(stated) + "\nalbedo_tint = [0.5, 1, 1]\n"));
        Result<Scene> loaded = load_built_in_scene(file.string());
        ASSERT_TRUE(loaded) << loaded.error().message;
        Viewed viewed;
        viewed.model.scene = &*loaded;
        viewed.model.scene_path = file.string();
        const Result<std::string> text = scene_text(viewed.model, directory.path);
        ASSERT_TRUE(text) << text.error().message;
        EXPECT_THAT(*text, HasSubstr(std::string(stated) + "\nalbedo_tint = [0.5, 1, 1]\n"));
        ASSERT_TRUE(write_text_file(file, *text));
        const Result<Scene> again = load_built_in_scene(file.string());
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->skin.albedo_tint_linear, loaded->skin.albedo_tint_linear) << *text;
    }
}

TEST(SceneText, comments_are_kept_and_paths_are_valid_from_another_folder) {
    const TemporaryDirectory directory;
    const auto file = directory.path / "scene.toml";
    ASSERT_TRUE(write_text_file(directory.path / "quad.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n"));
    ASSERT_TRUE(write_text_file(file, "# about this head\n[[mesh]]\nfile = \"quad.obj\" # flat\n"));
    Viewed viewed;
    viewed.model.scene_path = file.string();
    const Result<std::string> text = scene_text(viewed.model, directory.path / "elsewhere");
    ASSERT_TRUE(text) << text.error().message;
    EXPECT_THAT(*text, HasSubstr("# about this head\n"));
    EXPECT_THAT(*text, HasSubstr("\"" + (directory.path / "quad.obj").string() + "\" # flat"));
    const Result<std::string> beside = scene_text(viewed.model, directory.path);
    ASSERT_TRUE(beside);
    EXPECT_THAT(*beside, HasSubstr("file = \"quad.obj\" # flat"));
}

TEST(CompletePath, lists_folders_and_the_files_that_the_window_opens) {
    const TemporaryDirectory directory;
    const std::string folder = directory.path.string() + "/";
    std::filesystem::create_directory(directory.path / "heads");
    for (const char* name : {"head.glb", "head.OBJ", "headless.txt", "other.toml", ".head.glb"})
        ASSERT_TRUE(write_text_file(directory.path / name, ""));
    EXPECT_THAT(complete_path(folder + "he"),
                ElementsAre(folder + "heads/", folder + "head.OBJ", folder + "head.glb"));
    EXPECT_THAT(complete_path(folder), ElementsAre(folder + "heads/", folder + "head.OBJ",
                                                   folder + "head.glb", folder + "other.toml"));
    EXPECT_THAT(complete_path(folder + "."), ElementsAre(folder + ".head.glb"));
    EXPECT_TRUE(complete_path(folder + "nowhere/").empty());
    EXPECT_EQ(common_start(complete_path(folder + "he")), folder + "head");
    EXPECT_EQ(common_start({}), "");
}

const DrawSettings kSize = {.width = 640, .height = 480};

TEST(ViewLine, names_what_was_changed_of_the_look_and_nothing_else) {
    Viewed viewed;
    const Scene file = without_objects(viewed.scene);
    EXPECT_THAT(view_line(viewed.model, file, kSize), Not(HasSubstr("--scene")));
    viewed.scene.exposure_ev += 1;
    viewed.scene.skin.profile = "jensen_skin1";
    viewed.scene.environment.kind = EnvironmentKind::file;
    const TemporaryDirectory directory;
    const std::string around = (directory.path / "b c.hdr").string();
    ASSERT_TRUE(write_text_file(around, ""));
    viewed.scene.environment.file = around;
    const std::string line = view_line(viewed.model, file, {.width = 640, .height = 480, .samples = 4});
    EXPECT_THAT(line, HasSubstr(" --scene exposure_ev="));
    EXPECT_THAT(line, HasSubstr(" --scene skin.profile=jensen_skin1 --scene environment.kind=file --scene "
                                "'environment.file=" +
                                around + "' --samples 4"));
    EXPECT_THAT(line, Not(HasSubstr("tint")));
    Viewed other;
    ASSERT_TRUE(apply_view_line(other.model, line));
    EXPECT_EQ(other.scene.exposure_ev, viewed.scene.exposure_ev);
    EXPECT_EQ(other.scene.environment.file, around);
    for (size_t length = 0; length < line.size(); ++length) {
        Viewed third;
        const Result<void> taken = apply_view_line(third.model, std::string_view(line).substr(0, length));
        if (!taken) {
            EXPECT_EQ(taken.error().message.find('\n'), std::string::npos) << length;
        }
    }
}

TEST(ViewLine, comes_back_by_pasting) {
    Viewed viewed;
    const Technique& wrap = built_in_technique("wrap");
    viewed.model.choices[0].choose(wrap);
    ASSERT_TRUE(viewed.model.choices[0].values().set("wrap", "0.375"));
    const Scene file = without_objects(viewed.scene);
    ASSERT_TRUE(set_section(viewed.scene, "camera", "yaw_deg=12 pitch_deg=3 distance_mm=321"));
    const std::string line = view_line(viewed.model, file, kSize);
    EXPECT_THAT(line, ::testing::StartsWith(
                          "dermis render builtin:spheres -t wrap --set wrap=0.375 --camera 'yaw_deg=12 "));
    EXPECT_THAT(line, HasSubstr("--size 640x480"));
    Viewed other;
    ASSERT_TRUE(apply_view_line(other.model, line));
    EXPECT_EQ(view_line(other.model, file, kSize), line);
}

TEST(ViewLine, what_is_wrong_changes_nothing) {
    Viewed viewed;
    const Scene file = without_objects(viewed.scene);
    const std::string before = view_line(viewed.model, file, kSize);
    for (const char* line : {"", "hello", "-t nothing", "--camera 'yaw_deg=400'", "-t wrap --set wrap=9",
                             "--camera 'yaw_deg=10 pitch_deg=1' --light 'yaw_deg=x'", "--view none",
                             "--scene exposure_ev=x", "--scene skin.profile=nobody", "--scene tone_map=red",
                             "--scene mesh.scale=2", "--scene exposure_ev=1 --view none"}) {
        EXPECT_FALSE(apply_view_line(viewed.model, line)) << line;
        EXPECT_EQ(view_line(viewed.model, file, kSize), before) << line;
    }
    const std::string told = apply_view_line(viewed.model, "--camera 'yaw_deg=\n4x0'").error().message;
    EXPECT_EQ(told.find('\n'), told.npos);
    EXPECT_TRUE(apply_view_line(
        viewed.model, "--camera 'pitch_deg=2\n yaw_deg=20'"));  // line breaks added by a mail program
    EXPECT_TRUE(apply_view_line(viewed.model, "yaw_deg=10 pitch_deg=1"));
    EXPECT_THAT(view_line(viewed.model, file, kSize), HasSubstr("yaw_deg=10 pitch_deg=1"));
}

TEST(PictureKey, follows_the_display_and_the_view) {
    Viewed viewed;
    const std::string drawn = picture_key(viewed.model, 0);
    viewed.scene.exposure_ev += 1;
    const std::string brighter = picture_key(viewed.model, 0);
    EXPECT_NE(brighter, drawn);
    viewed.model.view = "normal";
    EXPECT_NE(picture_key(viewed.model, 0), brighter);
    viewed.model.view = "final";
    EXPECT_EQ(picture_key(viewed.model, 0), brighter);
    viewed.scene.camera.eye_mm.x += 1;
    EXPECT_NE(picture_key(viewed.model, 0), brighter);
}

TEST(WindowState, round_trips_and_forgets_what_is_damaged) {
    WindowState state{.width = 640, .height = 480};
    for (int i = 0; i < 15; ++i) remember(state, "scene \"" + std::to_string(i) + "\"\\");
    remember(state, "bust");
    remember(state, "scene \"13\"\\");
    EXPECT_EQ(state.recent.size(), kMaxRecent);
    EXPECT_EQ(state.recent[0], "scene \"13\"\\");
    EXPECT_EQ(state.recent[1], "bust");
    const std::string text = state_text(state);
    const WindowState again = parse_state(text);
    EXPECT_EQ(again.width, 640);
    EXPECT_EQ(again.recent, state.recent);
    for (size_t length = 0; length < text.size(); ++length)
        EXPECT_GE(parse_state(std::string_view(text).substr(0, length)).width, 160);
    EXPECT_EQ(parse_state("width = 1\nheight = 99999999999\nrecent = [3, \"\", \"a\"]").width, 1280);
    EXPECT_THAT(parse_state("recent = [3, \"\", \"a\"]").recent, ElementsAre("a"));
}

}  // namespace
}  // namespace dermis::view
