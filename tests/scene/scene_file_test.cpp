#include <gtest/gtest.h>

#include <cmath>

#include "dermis/scene/scene_description.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr const char* kComplete = R"(name = "Test"
credit = "nobody"
background = [0.1, 0.2, 0.3]
tone_map = "aces"
exposure_ev = -0.5
technique = "lambert"

[[mesh]]
file = "builtin:spheres"
name = "row"
scale = 2
rotate_deg = [0, 90, 0]
translate_mm = [1, 2.5, 3]
default_class = "skin"

[maps]
normal_space = "object"
dilate_texels = 8
displacement_amplitude_mm = 4.5

[material.skin]
class = "other"
roughness = 0.2
[material.skin.maps]
normal_scale = 0.5

[skin]
profile = "gpu_gems_3"
ior = 1.38

[[light]]
name = "sun"
yaw_deg = 90
intensity = 2

[[light]]
kind = "spot"
key = true
position_mm = [0, 0, 500]
target_mm = [0, 0, 0]
inner_angle_deg = 10
outer_angle_deg = 12

[environment]
kind = "studio"
intensity = 0.25
yaw_deg = 45
visible = true

[camera]
yaw_deg = 20
pitch_deg = -5
distance_mm = 300
fov_deg = 20

[settings]
wrap = 0.4
samples = 8
enabled = true
mode = "fast"
tint = [1, 0.5, 0]
)";

Result<SceneDescription> parse(const std::string& toml) {
    return parse_scene(toml, "s.toml", built_in_catalog().subjects);
}

std::string error_of(const std::string& toml) {
    const Result<SceneDescription> scene = parse(toml);
    return scene ? "" : scene.error().message;
}

const std::string kSpheresMesh = "[[mesh]]\nfile = \"builtin:spheres\"\n";

Material changed_by(const MaterialChanges& changes) {
    Material material;
    for (const auto& [key, change] : changes) change(material);
    return material;
}

}  // namespace

TEST(SceneFile, every_section_arrives_in_the_description) {
    const Result<SceneDescription> scene = parse(kComplete);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->head.name, "Test");
    EXPECT_EQ(scene->head.tone_map, ToneMap::aces);
    EXPECT_EQ(scene->head.background_linear, (Vec3{0.1f, 0.2f, 0.3f}));
    ASSERT_EQ(scene->meshes.size(), 1u);
    EXPECT_EQ(scene->meshes[0].file.line, 9);
    EXPECT_EQ(scene->meshes[0].file.key, "mesh.file");
    EXPECT_EQ(scene->meshes[0].translate_mm, (Vec3{1, 2.5f, 3}));
    EXPECT_EQ(changed_by(scene->maps.changes).normal_space, NormalSpace::object);
    EXPECT_EQ(changed_by(scene->maps.changes).dilate_texels, 8);
    EXPECT_EQ(scene->materials.at("skin").part, HeadPart::other);
    EXPECT_EQ(changed_by(scene->materials.at("skin").maps.changes).normal_scale, 0.5f);
    EXPECT_EQ(scene->skin.ior, 1.38f);
    ASSERT_EQ(scene->lights.size(), 2u);
    EXPECT_EQ(scene->lights[1].kind, LightKind::spot);
    EXPECT_EQ(scene->environment->intensity, 0.25f);
    EXPECT_EQ(scene->camera.distance_mm, 300);
    const std::map<std::string, std::string> settings = {
        {"wrap", "0.4"}, {"samples", "8"}, {"enabled", "on"}, {"mode", "fast"}, {"tint", "1,0.5,0"}};
    EXPECT_EQ(scene->settings, settings);
}

TEST(SceneFile, a_bust_takes_the_parameters_of_its_own_table) {
    const Result<SceneDescription> scene =
        parse("[[mesh]]\nfile = \"builtin:bust\"\ntone = 5\near_length_mm = 58.5\nseed = 7\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].parameters,
              (std::map<std::string, std::string>{{"ear_length_mm", "58.5"}, {"tone", "5"}, {"seed", "7"}}));
    const Subject& bust = **find_subject(built_in_catalog().subjects, "bust");
    for (const Parameter& row : bust.parameters.parameters) {
        const std::string name = row.name, below = std::to_string(int(row.min) - 1);
        const std::string message = error_of("[[mesh]]\nfile = \"builtin:bust\"\n" + name + " = " + below);
        EXPECT_TRUE(message.starts_with("s.toml:3: mesh." + name + " = ")) << message;
    }
    EXPECT_EQ(error_of("[[mesh]]\nfile = \"builtin:bust\"\ntone = 7\n"),
              "s.toml:3: mesh.tone = 7: tone is a number from 1 to 6");
}

TEST(SceneFile, only_a_bust_takes_the_parameters_of_the_bust) {
    EXPECT_EQ(error_of("[[mesh]]\nfile = \"builtin:spheres\"\ntone = 5\n"),
              "s.toml:3: mesh.tone: only builtin:bust has it, not builtin:spheres; leave it out");
    EXPECT_NE(error_of("[[mesh]]\nfile = \"builtin:bust\"\nfrekles = 1\n").find("did you mean 'freckles'?"),
              std::string::npos);
}

TEST(SceneFile, every_prefix_fails_in_one_line_or_is_a_scene) {
    const std::string text = kComplete;
    for (size_t length = 0; length < text.size(); ++length) {
        const std::string message = error_of(text.substr(0, length));
        EXPECT_EQ(message.find('\n'), std::string::npos) << length;
        EXPECT_TRUE(message.empty() || message.starts_with("s.toml:")) << message;
    }
}

TEST(SceneFile, a_syntax_error_names_its_line) {
    EXPECT_EQ(error_of("name = \"a\"\n[mesh\n").rfind("s.toml:2: not TOML: ", 0), 0u);
    EXPECT_EQ(error_of("name = 1\nname = 2\n").rfind("s.toml:2: not TOML: ", 0), 0u);
}

TEST(SceneFile, input_that_makes_the_parser_assert_is_an_error_with_its_line) {
    EXPECT_EQ(error_of("name = \"a\"\n\n[ = 3\n" + kSpheresMesh),
              "s.toml:3: not TOML: a name in brackets or a key is malformed");
    EXPECT_EQ(error_of("[ ="), "s.toml:1: not TOML: a name in brackets or a key is malformed");
    EXPECT_EQ(error_of("# \u00e9 may stand here\nname = \u00e9\n"),
              "s.toml:2: not TOML: Error while parsing value: could not determine value type");
    EXPECT_EQ(error_of("\nname = \"\xC3(\"\n"), "s.toml:2: not TOML: bytes that are not UTF-8");
}

TEST(SceneFile, characters_beyond_ascii_are_allowed_in_strings_and_comments) {
    const Result<SceneDescription> scene =
        parse("\xEF\xBB\xBFname = \"caf\u00e9 \\\" ~41 \u00e9\" # \u00e9\ncredit = '''\n\u00e9\'\n'''\n" +
              kSpheresMesh);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->head.name, "caf\u00e9 \" ~41 \u00e9");
    EXPECT_EQ(scene->head.credit, "\u00e9\'\n");
}

TEST(SceneFile, an_unknown_key_proposes_the_one_that_was_meant) {
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nrougness = 0.4\n").substr(0, 78),
              "s.toml:4: unknown key in [skin]: 'rougness'; did you mean 'roughness'? known: ");
    EXPECT_EQ(error_of("exposure = 1\n" + kSpheresMesh).substr(0, 72),
              "s.toml:1: unknown key 'exposure'; did you mean 'exposure_ev'? known: ani");
    EXPECT_EQ(error_of(kSpheresMesh + "[material.lips.maps]\nnormals = \"a.png\"\n").substr(0, 88),
              "s.toml:4: unknown key in [material.lips.maps]: 'normals'; did you mean 'normal'? known: ");
}

TEST(SceneFile, a_key_in_the_wrong_section_names_the_right_one) {
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nalbedo = \"a.png\"\n"),
              "s.toml:4: unknown key in [skin]: 'albedo'; it is a key of [maps], [material.NAME]");
    EXPECT_EQ(
        error_of(kSpheresMesh + "exposure_ev = 1\n"),
        "s.toml:3: unknown key in [mesh]: 'exposure_ev'; it is a key of the file, before every section");
}

TEST(SceneFile, a_value_out_of_range_says_the_range) {
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nroughness = 2\n"),
              "s.toml:4: skin.roughness = 2: roughness is a number from 0 to 1");
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nroughness = nan\n"),
              "s.toml:4: skin.roughness = nan: roughness is a number from 0 to 1");
    EXPECT_EQ(error_of(kSpheresMesh + "subdivision = 9\n"),
              "s.toml:3: mesh.subdivision = 9: subdivision is an integer from 0 to 4 (levels)");
    EXPECT_EQ(
        error_of(kSpheresMesh + "rotate_deg = [0, 361, 0]\n"),
        "s.toml:3: mesh.rotate_deg = an array: rotate_deg is three numbers [x, y, z], each from -360 to 360 "
        "(degrees)");
}

TEST(SceneFile, a_wrong_type_says_which_is_right) {
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nroughness = \"low\"\n"),
              "s.toml:4: skin.roughness = \"low\": roughness is a number from 0 to 1");
    EXPECT_EQ(error_of(kSpheresMesh + "[skin]\nroughness = true\n"),
              "s.toml:4: skin.roughness = true: roughness is a number from 0 to 1");
    EXPECT_EQ(error_of(kSpheresMesh + "subdivision = 1.5\n"),
              "s.toml:3: mesh.subdivision = 1.5: subdivision is an integer from 0 to 4 (levels)");
    EXPECT_EQ(error_of(kSpheresMesh + "[environment]\nvisible = 1\n"),
              "s.toml:4: environment.visible = 1: visible is true or false");
    EXPECT_EQ(error_of(kSpheresMesh + "[camera]\neye_mm = [0, 1]\n"),
              "s.toml:4: camera.eye_mm = an array: eye_mm is three numbers [x, y, z], each from -1e+06 to "
              "1e+06 (mm)");
    EXPECT_EQ(error_of("name = 2021-01-01\n" + kSpheresMesh),
              "s.toml:1: name = a date or time: name is a string");
    EXPECT_EQ(error_of("[[mesh]]\nfile = \"\"\n"), "s.toml:2: mesh.file = \"\": file is a path in a string");
    EXPECT_EQ(
        error_of("tone_map = \"filmic\"\n" + kSpheresMesh),
        "s.toml:1: tone_map = \"filmic\": tone_map is one of \"none\", \"hable\", \"aces\", \"pbr_neutral\"");
    EXPECT_EQ(error_of(kSpheresMesh + "[settings]\nwrap = [1, 2]\n"),
              "s.toml:4: settings.wrap = an array: a setting is a number, true or false, a string, or three "
              "numbers");
}

TEST(SceneFile, a_section_that_is_no_table_says_how_to_write_it) {
    EXPECT_EQ(error_of("mesh = 3\n"), "s.toml:1: mesh is an integer, not a table; write [[mesh]]");
    EXPECT_EQ(error_of("light = [1]\n" + kSpheresMesh),
              "s.toml:1: light is an integer, not a table; write [[light]]");
    EXPECT_EQ(error_of("camera = true\n" + kSpheresMesh),
              "s.toml:1: camera is true or false, not a table; write [camera]");
    EXPECT_EQ(error_of(kSpheresMesh + "[material]\nskin = 1\n"),
              "s.toml:4: material.skin is an integer, not a table; write [material.skin]");
}

TEST(SceneFile, a_scene_needs_a_mesh_and_a_mesh_needs_a_file) {
    EXPECT_EQ(error_of("name = \"empty\"\n"),
              "s.toml:1: no [[mesh]]; a scene has at least one, with file = \"HEAD.obj\"");
    EXPECT_EQ(error_of("\n[[mesh]]\nscale = 2\n"),
              "s.toml:2: mesh.file is missing; give file = \"HEAD.obj\" or \"builtin:spheres\"");
}

TEST(SceneFile, a_built_in_mesh_takes_no_unit_and_no_refinement) {
    EXPECT_EQ(error_of(kSpheresMesh + "subdivision = 1\n"),
              "s.toml:1: mesh.subdivision: builtin:spheres is fine enough already; remove this key");
    EXPECT_EQ(error_of(kSpheresMesh + "unit_mm = 10\n"),
              "s.toml:1: mesh.unit_mm: builtin:spheres is in millimetres; use scale to resize it");
    EXPECT_EQ(error_of(kSpheresMesh + "scale = 2\n"), "");
}

TEST(SceneFile, exactly_one_light_is_the_key_light) {
    EXPECT_EQ(error_of(kSpheresMesh + "[[light]]\n[[light]]\n"),
              "s.toml:3: light.key: no light is the key light; give one of them key = true");
    EXPECT_EQ(
        error_of(kSpheresMesh + "[[light]]\nkey = true\n[[light]]\nkey = true\n"),
        "s.toml:5: light.key: the light of line 3 is the key light already; exactly one casts the shadow");
    EXPECT_EQ(error_of(kSpheresMesh + "[[light]]\nkey = false\n"),
              "s.toml:3: light.key: no light is the key light; give one of them key = true");
    const Result<SceneDescription> single = parse(kSpheresMesh + "[[light]]\nyaw_deg = 3\n");
    ASSERT_TRUE(single);
    EXPECT_EQ(single->lights[0].key, true);
}

TEST(SceneFile, lights_and_cameras_are_placed_in_one_way_only) {
    EXPECT_EQ(error_of(kSpheresMesh + "[[light]]\nposition_mm = [0, 0, 1]\n"),
              "s.toml:3: light.position_mm: a directional light has none; give yaw_deg and pitch_deg, or "
              "kind = \"point\"");
    EXPECT_EQ(error_of(kSpheresMesh + "[[light]]\nkind = \"point\"\nposition_mm = [0, 0, 1]\nyaw_deg = 3\n"),
              "s.toml:3: light.position_mm excludes yaw_deg, pitch_deg and distance_mm; remove it or those");
    EXPECT_EQ(
        error_of(kSpheresMesh + "[[light]]\nkind = \"point\"\nyaw_deg = 3\n"),
        "s.toml:3: light: a point or spot light needs position_mm, or yaw_deg, pitch_deg and distance_mm");
    EXPECT_EQ(
        error_of(kSpheresMesh + "[[light]]\nkind = \"spot\"\ndistance_mm = 300\ninner_angle_deg = 40\n"),
        "s.toml:3: light.inner_angle_deg must be smaller than outer_angle_deg");
    EXPECT_EQ(error_of(kSpheresMesh + "[camera]\neye_mm = [0, 0, 1]\nyaw_deg = 3\n"),
              "s.toml:3: camera.eye_mm excludes yaw_deg, pitch_deg and distance_mm; remove it or those");
}

TEST(SceneFile, an_environment_of_kind_file_needs_one_and_no_other_kind_takes_one) {
    EXPECT_EQ(error_of(kSpheresMesh + "[environment]\nkind = \"file\"\n"),
              "s.toml:3: environment.kind = \"file\" needs file = \"PANORAMA.hdr\"");
    EXPECT_EQ(error_of(kSpheresMesh + "[environment]\nkind = \"none\"\nfile = \"a.hdr\"\n"),
              "s.toml:5: environment.file: only for kind = \"file\"; remove kind or file");
}

TEST(SceneFile, control_characters_in_names_do_not_break_the_line) {
    EXPECT_EQ(error_of("\"a\\nb\" = 1\n" + kSpheresMesh).find('\n'), std::string::npos);
    EXPECT_EQ(error_of("name = \"a\\nb\"\ntone_map = \"x\\ny\"\n" + kSpheresMesh).find('\n'),
              std::string::npos);
}

TEST(SceneFile, a_huge_file_is_refused) {
    EXPECT_EQ(error_of(std::string(kMaxSceneBytes + 1, '#')), "s.toml:1: larger than 1 MB, so no scene file");
}
