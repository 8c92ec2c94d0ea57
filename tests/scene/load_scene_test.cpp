#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_files.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;
namespace fs = std::filesystem;

namespace {

// Two triangles with two materials, named in the file alone.
constexpr const char* kTwoMaterials =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "usemtl face\nf 1/1 2/2 3/3\nusemtl eyes\nf 1/1 3/2 4/3\n";

struct SceneDirectory : TemporaryDirectory {
    SceneDirectory() { put("two.obj", kTwoMaterials); }
    void put(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_text_file(path / name, text));
    }
    Result<Scene> load(const std::string& toml) const {
        put("s.toml", toml);
        return load_built_in_scene((path / "s.toml").string());
    }
    std::string error(const std::string& toml) const {
        const Result<Scene> scene = load(toml);
        return scene ? "" : scene.error().message;
    }
    std::string file(const char* name) const { return (path / name).string(); }
};

std::string all_warnings(const Scene& scene) {
    std::string all;
    for (const std::string& warning : scene.warnings) all += warning + "\n";
    return all;
}

// The environment variables of asset lookup, restored at the end.
struct Variable {
    std::string name;
    std::optional<std::string> before;

    Variable(const char* variable, const std::string& value) : name(variable) {
        if (const char* old = std::getenv(variable)) before = old;
        ::setenv(variable, value.c_str(), 1);
    }
    ~Variable() {
        if (before)
            ::setenv(name.c_str(), before->c_str(), 1);
        else
            ::unsetenv(name.c_str());
    }
};

const std::string kMesh = "[[mesh]]\nfile = \"two.obj\"\nunit_mm = 100\n";

}  // namespace

TEST(LoadScene, a_materialx_profile_brings_roughness_and_ior_where_the_scene_has_none) {
    const SceneDirectory dir;
    dir.put("skin.mtlx",
            "<materialx version=\"1.39\"><open_pbr_surface name=\"s\" type=\"surfaceshader\">"
            "<input name=\"subsurface_weight\" type=\"float\" value=\"1\" />"
            "<input name=\"specular_roughness\" type=\"float\" value=\"0.25\" />"
            "<input name=\"specular_ior\" type=\"float\" value=\"1.55\" />"
            "</open_pbr_surface></materialx>");
    const std::string toml = "[[mesh]]\nfile = \"two.obj\"\n[skin]\nprofile = \"skin.mtlx\"\n";
    const Result<Scene> both = dir.load(toml);
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_FLOAT_EQ(both->objects[0].mesh.materials[0].roughness, 0.25f);
    EXPECT_FLOAT_EQ(both->objects[0].mesh.materials[0].ior, 1.55f);
    EXPECT_EQ(all_warnings(*both).find("specular"), std::string::npos);
    const Result<Scene> own = dir.load(toml + "roughness = 0.6\n");
    ASSERT_TRUE(own) << own.error().message;
    EXPECT_FLOAT_EQ(own->objects[0].mesh.materials[0].roughness, 0.6f);
    EXPECT_FLOAT_EQ(own->objects[0].mesh.materials[0].ior, 1.55f);
    EXPECT_NE(all_warnings(*own).find("specular_roughness 0.25 is not used: skin.roughness is 0.6"),
              std::string::npos);
}

TEST(LoadScene, keys_without_effect_are_named) {
    const SceneDirectory directory;
    const auto warnings = [&](const std::string& maps) {
        const auto scene = directory.load("[mesh]\nfile = \"two.obj\"\nunit_mm = 200\n[maps]\n" + maps);
        EXPECT_TRUE(scene) << scene.error().message;
        std::string all;
        if (scene)
            for (const std::string& warning : scene->warnings) all += warning + "\n";
        return all;
    };
    directory.put("a.png", "");
    EXPECT_EQ(warnings("").find("no effect"), std::string::npos);
    for (const char* key : {"normal_scale", "thickness_scale_mm", "displacement_amplitude_mm"})
        EXPECT_NE(warnings(std::string(key) + " = 1\n").find(std::string("maps.") + key + " has no effect"),
                  std::string::npos);
    EXPECT_EQ(warnings("thickness = \"a.png\"\nthickness_scale_mm = 1\n").find("no effect"),
              std::string::npos);
    EXPECT_NE(warnings("displacement = \"a.png\"\n").find("without displacement_amplitude_mm"),
              std::string::npos);
    const std::string light = "[[light]]\nyaw_deg = 10\ninner_angle_deg = 10\n";
    EXPECT_NE(warnings(light).find("inner_angle_deg and outer_angle_deg have no effect"), std::string::npos);
    EXPECT_EQ(warnings(light + "kind = \"spot\"\ndistance_mm = 500\n").find("no effect"), std::string::npos);
    const std::string none = "[environment]\nkind = \"none\"\n";
    EXPECT_EQ(warnings(none).find("no effect"), std::string::npos);
    for (const char* key : {"yaw_deg = 5\n", "intensity = 2\n", "visible = true\n"})
        EXPECT_NE(warnings(none + key).find("keys of [environment] have no effect"), std::string::npos)
            << key;
    const std::string metal = "[material.face]\nmetallic = 1\n";
    EXPECT_NE(warnings(metal).find("material.face.metallic has no effect"), std::string::npos);
    EXPECT_EQ(warnings(metal + "class = \"other\"\n").find("no effect"), std::string::npos);
}

TEST(LoadScene, warnings_of_many_meshes_and_lights_come_once_with_their_number) {
    const SceneDirectory dir;
    std::string toml;
    for (int i = 0; i < 500; ++i) toml += "[[mesh]]\nfile = \"two.obj\"\n";
    for (int i = 0; i < 40; ++i)
        toml += "[[light]]\nkind = \"point\"\nposition_mm = [0, 0, 9]\ninner_angle_deg = 1\nkey = " +
                std::string(i == 0 ? "true\n" : "false\n");
    const Result<Scene> scene = dir.load(toml);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_LT(scene->warnings.size(), 10u) << all_warnings(*scene);
    EXPECT_NE(
        all_warnings(*scene).find("1 mm tall; a head is 150 to 500 mm; OBJ has no unit: state unit_mm under "
                                  "[[mesh]] of a scene file (500 times)"),
        std::string::npos)
        << all_warnings(*scene);
    EXPECT_NE(all_warnings(*scene).find("they are for kind = \"spot\" (40 times)"), std::string::npos);
    EXPECT_NE(all_warnings(*scene).find("light 4 and 36 more cast no shadow: shadow_maps = 3"),
              std::string::npos)
        << all_warnings(*scene);
}

TEST(LoadScene, materials_that_alpha_cuts_out_are_not_skin) {
    const SceneDirectory directory;
    directory.put("two.obj", std::string("mtllib two.mtl\n") + kTwoMaterials);
    directory.put("two.mtl", "newmtl face\nnewmtl eyes\nmap_d lashes.png\n");
    const std::string mesh = "[mesh]\nfile = \"two.obj\"\nunit_mm = 100\n";
    const auto scene = directory.load(mesh);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->objects[0].classes, (std::vector{MaterialClass::skin, MaterialClass::other}));
    const auto told = directory.load(mesh + "[material.eyes]\nclass = \"skin\"\n");
    ASSERT_TRUE(told) << told.error().message;
    EXPECT_EQ(told->objects[0].classes, (std::vector{MaterialClass::skin, MaterialClass::skin}));
    EXPECT_NE(std::ranges::find_if(
                  told->warnings,
                  [](const std::string& w) { return w.find("'eyes' is skin, of which alpha") != w.npos; }),
              told->warnings.end());
    const auto bare = load_built_in_scene(directory.file("two.obj"));
    ASSERT_TRUE(bare) << bare.error().message;
    EXPECT_EQ(bare->objects[0].classes, (std::vector{MaterialClass::skin, MaterialClass::other}));
    // Exporters mark whole heads so: without another material it is the skin.
    directory.put("two.mtl", "newmtl face\nmap_d a.png\nnewmtl eyes\nmap_d a.png\n");
    const auto all = directory.load(mesh + "default_class = \"skin\"\n");
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_EQ(all->objects[0].classes, (std::vector{MaterialClass::skin, MaterialClass::skin}));
}

TEST(PlaceMesh, scales_then_turns_about_x_y_z_then_moves) {
    Mesh mesh{.positions_mm = {{1, 0, 0}, {0, 0, 1}},
              .normals = {{1, 0, 0}, {0, 0, 1}},
              // The second point bends along X alone.
              .curvatures_per_mm = {isotropic_curvature(0.5f, {1, 0, 0}), {{1, 0, 0}, {}}}};
    place_mesh(mesh, {.scale = 2,
                      .rotation_rad = {std::numbers::pi_v<float> / 2, 0, std::numbers::pi_v<float> / 2},
                      .translation_mm = {10, 0, 0}});
    // +X stays under X, then turns to +Y about Z; +Z turns to -Y about X, then to +X about Z.
    EXPECT_LT(length(mesh.positions_mm[0] - Vec3{10, 2, 0}), 1e-5f);
    EXPECT_LT(length(mesh.positions_mm[1] - Vec3{12, 0, 0}), 1e-5f);
    EXPECT_LT(length(mesh.normals[1] - Vec3{1, 0, 0}), 1e-6f);
    const CurvatureTensor& turned = mesh.curvatures_per_mm[0];
    EXPECT_LT(length(turned * Vec3{0, 1, 0}), 1e-6f);
    EXPECT_LT(length(turned * Vec3{1, 2, 3} - Vec3{0.25f, 0, 0.75f}), 1e-6f);
    // X turns to +Y.
    EXPECT_LT(length(mesh.curvatures_per_mm[1] * Vec3{1, 1, 1} - Vec3{0, 0.5f, 0}), 1e-6f);
}

TEST(PlaceMesh, half_a_turn_about_y_takes_a_head_from_minus_z_to_plus_z) {
    Mesh mesh{.positions_mm = {{1, 2, -3}}, .tangents = {{1, 0, 0, -1}}};
    place_mesh(mesh, {.rotation_rad = {0, std::numbers::pi_v<float>, 0}});
    EXPECT_LT(length(mesh.positions_mm[0] - Vec3{-1, 2, 3}), 1e-5f);
    EXPECT_NEAR(mesh.tangents[0].x, -1, 1e-6);
    EXPECT_EQ(mesh.tangents[0].w, -1);
}

TEST(LoadScene, a_mesh_is_read_in_its_unit_and_placed) {
    const SceneDirectory dir;
    const Result<Scene> scene = dir.load(kMesh + "rotate_deg = [0, 180, 0]\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name, "s");
    float lowest_x = 0;
    for (const Vec3 p : scene->objects[0].mesh.positions_mm) lowest_x = std::min(lowest_x, p.x);
    EXPECT_NEAR(lowest_x, -100, 1e-3);
}

TEST(LoadScene, materials_take_class_constants_and_maps_from_the_file) {
    const SceneDirectory dir;
    dir.put("a.png", "x"), dir.put("b.png", "x");
    const Result<Scene> scene =
        dir.load(kMesh +
                 "[maps]\nalbedo = \"a.png\"\nspecular = \"a.png\"\n"
                 "[skin]\nroughness = 0.3\n"
                 "[material.face.maps]\nspecular = \"b.png\"\n"
                 "[material.eyes]\nclass = \"other\"\nroughness = 0.05\nalbedo = [1, 0, 0]\n");
    ASSERT_TRUE(scene) << scene.error().message;
    const SceneObject& object = scene->objects[0];
    ASSERT_EQ(object.mesh.materials.size(), 2u);
    const Material &face = object.mesh.materials[0], &eyes = object.mesh.materials[1];
    EXPECT_EQ(object.classes[0], MaterialClass::skin);
    EXPECT_EQ(face.base_color_map.name, dir.file("a.png"));
    EXPECT_EQ(face.specular_map.name, dir.file("b.png"));
    EXPECT_EQ(face.base_color_linear, (Vec3{1, 1, 1}));
    EXPECT_EQ(face.roughness, 0.3f);
    EXPECT_EQ(object.classes[1], MaterialClass::other);
    EXPECT_FALSE(eyes.base_color_map.present());
    EXPECT_EQ(eyes.roughness, 0.05f);
    EXPECT_EQ(eyes.base_color_linear, (Vec3{1, 0, 0}));
}

TEST(LoadScene, an_invisible_material_loses_its_triangles_and_the_others_keep_theirs) {
    const SceneDirectory dir;
    const Result<Scene> scene = dir.load(kMesh + "[material.face]\nvisible = false\n");
    ASSERT_TRUE(scene) << scene.error().message;
    const Mesh& mesh = scene->objects[0].mesh;
    ASSERT_EQ(mesh.submeshes.size(), 1u);
    EXPECT_EQ(mesh.submeshes[0].first_index, 0u);
    EXPECT_EQ(mesh.materials[mesh.submeshes[0].material].name, "eyes");
    ASSERT_EQ(mesh.indices.size(), 3u);
    float highest_z = 0;
    for (const uint32_t i : mesh.indices) highest_z = std::max(highest_z, mesh.positions_mm[i].z);
    EXPECT_NEAR(highest_z, 100, 1e-3);
}

TEST(LoadScene, a_material_that_no_mesh_has_is_an_error) {
    const SceneDirectory dir;
    EXPECT_EQ(dir.error(kMesh + "[material.eye]\nclass = \"other\"\n"),
              dir.file("s.toml") +
                  ":4: [material.eye]: unknown material 'eye'; did you mean 'eyes'? known: face, eyes");
}

TEST(LoadScene, a_missing_file_names_the_line_and_key_that_asked_for_it) {
    const SceneDirectory dir;
    EXPECT_EQ(dir.error("[[mesh]]\nfile = \"none.obj\"\n"),
              dir.file("s.toml") + ":2: mesh.file: '" + dir.file("none.obj") +
                  "' does not exist; paths are relative to the scene file");
    EXPECT_EQ(dir.error(kMesh + "[maps]\n\nalbedo = \"none.png\"\n"),
              dir.file("s.toml") + ":6: maps.albedo: '" + dir.file("none.png") +
                  "' does not exist; paths are relative to the scene file");
    EXPECT_EQ(dir.error(kMesh + "[environment]\nfile = \".\"\n"),
              dir.file("s.toml") + ":5: environment.file: '" + dir.file("") + "' is a directory, not a file");
}

TEST(LoadScene, a_bad_mesh_names_the_scene_and_the_mesh) {
    const SceneDirectory dir;
    dir.put("bad.obj", "v 1 2\n");
    const std::string message = dir.error("[[mesh]]\nfile = \"bad.obj\"\n");
    EXPECT_EQ(message.rfind(dir.file("s.toml") + ":2: mesh.file: " + dir.file("bad.obj"), 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(LoadScene, assets_are_looked_for_in_three_places_in_order) {
    const SceneDirectory dir;
    const Variable assets("DERMIS_ASSETS", dir.file("mine")), data("XDG_DATA_HOME", dir.file("data"));
    const std::vector<fs::path> directories = asset_directories();
    ASSERT_EQ(directories.size(), 3u);
    EXPECT_EQ(directories[0], dir.path / "mine");
    EXPECT_EQ(directories[2], dir.path / "data" / "dermis");

    dir.put("data/dermis/test_asset/a.obj", kTwoMaterials);
    const Result<fs::path> from_data = resolve_path("assets:test_asset/a.obj", dir.path / "s.toml");
    ASSERT_TRUE(from_data) << from_data.error().message;
    EXPECT_EQ(*from_data, dir.path / "data/dermis/test_asset/a.obj");
    dir.put("mine/test_asset/a.obj", kTwoMaterials);
    EXPECT_EQ(*resolve_path("assets:test_asset/a.obj", dir.path / "s.toml"),
              dir.path / "mine/test_asset/a.obj");
}

TEST(LoadScene, a_missing_asset_says_where_it_was_looked_for_and_how_to_get_it) {
    const SceneDirectory dir;
    const Variable assets("DERMIS_ASSETS", dir.file("mine")), data("XDG_DATA_HOME", dir.file("data"));
    EXPECT_EQ(dir.error("[[mesh]]\nfile = \"assets:nobody/head.obj\"\n"),
              dir.file("s.toml") + ":2: mesh.file: asset 'nobody/head.obj' is in none of " +
                  dir.file("mine") + ", " + asset_directories()[1].string() + ", " + dir.file("data/dermis") +
                  "; run tools/get_head, or set DERMIS_ASSETS to the directory that holds it");
}

TEST(LoadScene, a_scene_that_lacks_an_asset_draws_the_one_it_names_and_says_so) {
    const SceneDirectory dir;
    const Variable assets("DERMIS_ASSETS", dir.file("mine")), data("XDG_DATA_HOME", dir.file("data"));
    dir.put("plain.toml", "name = \"Plain\"\n" + kMesh);
    const std::string maps = "[maps]\nnormal = \"assets:nobody/normal.jpg\"\n";
    const std::string head = "name = \"Full\"\nwithout_assets = \"plain\"\n";
    const Result<Scene> scene = dir.load(head + kMesh + maps);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name, "Plain");
    ASSERT_FALSE(scene->warnings.empty());
    EXPECT_NE(scene->warnings[0].find("s.toml:7: maps.normal: asset 'nobody/normal.jpg' is in none of"),
              std::string::npos)
        << scene->warnings[0];
    EXPECT_NE(scene->warnings[0].find("drawing scene 'plain' instead"), std::string::npos);

    // Any other mistake is its own error, and so is a replacement scene that fails too.
    EXPECT_NE(dir.error(head + kMesh + "[skin]\nior = 9\n").find("ior"), std::string::npos);
    EXPECT_NE(dir.error("without_assets = \"nothing\"\n" + kMesh + maps).find("nobody/normal.jpg"),
              std::string::npos);
}

TEST(LoadScene, point_and_spot_lights_are_where_the_file_says) {
    const SceneDirectory dir;
    const Result<Scene> scene = dir.load(
        kMesh +
        "[[light]]\nkind = \"point\"\nkey = true\nyaw_deg = 90\ndistance_mm = 500\ntarget_mm = [0, 50, 0]\n"
        "[[light]]\nkind = \"spot\"\nposition_mm = [0, 0, 700]\ntarget_mm = [0, 0, 0]\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_LT(length(scene->lights[0].position_mm - Vec3{500, 50, 0}), 1e-3f);
    EXPECT_LT(length(scene->lights[1].to_light_world - Vec3{0, 0, 1}), 1e-6f);
    EXPECT_EQ(&scene->key_light(), &scene->lights[0]);
}

TEST(LoadScene, a_camera_without_a_distance_frames_the_scene) {
    const SceneDirectory dir;
    const Result<Scene> scene = dir.load(kMesh + "[camera]\nyaw_deg = 90\nfov_deg = 20\n");
    ASSERT_TRUE(scene) << scene.error().message;
    const float distance_mm = length(scene->camera.eye_mm - scene->bounds_center_mm);
    EXPECT_NEAR(distance_mm, 1.05f * scene->bounds_radius_mm / std::sin(10 * std::numbers::pi_v<float> / 180),
                0.1f);
    EXPECT_GT(scene->camera.eye_mm.x, scene->bounds_center_mm.x + 100);
}

TEST(LoadScene, a_bare_mesh_is_placed_in_the_studio_in_the_unit_asked_for) {
    const SceneDirectory dir;
    const Result<Scene> scene = load_scene(dir.file("two.obj"), {.mesh_unit_mm = 10});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->environment.kind, EnvironmentKind::studio);
    EXPECT_EQ(scene->objects[0].classes, (std::vector{MaterialClass::skin, MaterialClass::other}))
        << "face, eyes";
    EXPECT_LT(scene->bounds_radius_mm, 10);
    EXPECT_TRUE(scene->key_light().is_key);
}

TEST(LoadScene, names_without_a_path_are_scenes_of_the_project) {
    const Result<Scene> scene = load_built_in_scene("spheres");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->objects.size(), 4u);
    const std::string message = load_built_in_scene("sphere").error().message;
    EXPECT_EQ(message.rfind("unknown scene 'sphere'; did you mean 'spheres'? known: ", 0), 0u) << message;
}

TEST(LoadScene, a_folder_of_the_same_name_does_not_hide_a_scene) {
    const SceneDirectory dir;
    const auto before = std::filesystem::current_path();
    std::filesystem::create_directory(dir.file("spheres"));
    std::filesystem::current_path(std::filesystem::path(dir.file("spheres")).parent_path());
    const Result<Scene> scene = load_built_in_scene("spheres");
    std::filesystem::current_path(before);
    EXPECT_TRUE(scene) << scene.error().message;
}

TEST(LoadScene, what_is_neither_scene_nor_mesh_is_an_error) {
    const SceneDirectory dir;
    dir.put("a.txt", "hello");
    EXPECT_EQ(load_built_in_scene(dir.file("a.txt")).error().message,
              dir.file("a.txt") + ": neither a scene (.toml) nor a mesh (.obj, .gltf, .glb)");
    EXPECT_FALSE(load_built_in_scene(dir.file("none.toml")));
    EXPECT_FALSE(load_built_in_scene(""));
}

TEST(LoadScene, every_scene_of_the_project_loads_when_its_assets_are_there) {
    for (const std::string& name : scene_names()) {
        const Result<Scene> scene = load_built_in_scene(name);
        if (!scene && scene.error().message.find("run tools/get_head") != std::string::npos) continue;
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_FALSE(scene->objects.empty()) << name;
        bool skin = false;
        for (const SceneObject& object : scene->objects)
            for (const MaterialClass c : object.classes) skin |= c == MaterialClass::skin;
        EXPECT_TRUE(skin) << name << " has no skin";
    }
}

TEST(LoadScene, the_heads_are_as_tall_as_heads_and_face_the_camera) {
    for (const char* name : {"head_scan", "face"}) {
        const Result<Scene> scene = load_built_in_scene(name);
        if (!scene && scene.error().message.find("run tools/get_head") != std::string::npos)
            GTEST_SKIP() << scene.error().message;
        ASSERT_TRUE(scene) << scene.error().message;
        float low = INFINITY, high = -INFINITY, front = -INFINITY;
        for (const SceneObject& object : scene->objects)
            for (const Vec3 p : object.mesh.positions_mm) {
                low = std::min(low, p.y), high = std::max(high, p.y);
                if (std::abs(p.x - scene->bounds_center_mm.x) < 10) front = std::max(front, p.z);
            }
        EXPECT_GT(high - low, 150) << name;
        EXPECT_LT(high - low, 500) << name;
        EXPECT_GT(scene->camera.eye_mm.z, front) << name;
        EXPECT_FALSE(scene->credit.empty()) << name;
    }
}

namespace {

// The keys under each heading of `dermis keys`.
std::map<std::string, std::set<std::string>> keys_by_section() {
    std::map<std::string, std::set<std::string>> sections;
    std::string section;
    const std::string manual = scene_file_manual(built_in_catalog().subjects);
    for (const std::string_view line : split(manual, '\n')) {
        if (line.starts_with("## ")) section = std::string(line.substr(line.find('`') + 1));
        if (section.ends_with('`')) section.pop_back();
        if (line.starts_with("| `")) sections[section].emplace(line.substr(3, line.find('`', 3) - 3));
    }
    return sections;
}

}  // namespace

TEST(SceneManual, has_every_key_of_the_pages_example_in_its_section) {
    const Result<std::string> page = read_text_file(fs::path(DERMIS_SOURCE_DIR) / "docs" / "scene_file.md");
    ASSERT_TRUE(page) << page.error().message;
    const auto sections = keys_by_section();
    std::string section = "## Outside any section";
    bool in_example = false;
    size_t keys = 0;
    for (const std::string_view line : split(*page, '\n')) {
        if (line.starts_with("```")) in_example = line == "```toml";
        if (!in_example) continue;
        if (line.starts_with("[")) section = std::string(line.substr(0, line.find_first_of(" #")));
        if (section == "[material.M_Lips]") section = "[material.NAME]";
        const size_t equals = line.find(" = ");
        // Targets and parameters of techniques have no row.
        if (equals == std::string_view::npos || section == "[morph]" || section == "[settings]") continue;
        const std::string key(line.substr(0, equals));
        ASSERT_TRUE(sections.contains(section)) << section;
        EXPECT_TRUE(sections.at(section).contains(key)) << section << " " << key;
        ++keys;
    }
    EXPECT_GT(keys, 30u);
}

TEST(LoadScene, a_bare_mesh_takes_the_words_of_a_scene) {
    const SceneDirectory dir;
    const auto load = [&](std::vector<SceneWord> words) {
        return load_scene(dir.file("two.obj"), {.words = std::move(words)});
    };
    const auto wide = load({{"mesh.unit_mm", "100"}, {"material.eyes.class", "teeth"}});
    ASSERT_TRUE(wide) << wide.error().message;
    EXPECT_EQ(wide->objects[0].unit_mm, 100);
    EXPECT_EQ(wide->objects[0].parts[1].part, HeadPart::teeth);
    EXPECT_FALSE(load({{"material.eye.class", "teeth"}}));
    const auto dark = load({{"skin.tone", "6"}}), light = load({});
    ASSERT_TRUE(dark && light);
    EXPECT_EQ(dark->skin.profile, "openpbr_skin_6");
    EXPECT_EQ(dark->skin.tone, 0) << "applied";
    const auto follows = load({{"skin.profile", "openpbr_skin_6"}});
    ASSERT_TRUE(follows) << follows.error().message;
    const auto red = [](const Scene& scene) {
        return scene.objects[0].mesh.materials[0].base_color_linear.x * scene.skin.albedo_tint_linear.x;
    };
    EXPECT_LT(red(*dark), 0.5f * red(*light));
    EXPECT_LT(red(*follows), 0.5f * red(*light));
}

TEST(LoadScene, a_profile_that_is_too_bright_or_of_another_tone_warns) {
    const SceneDirectory dir;
    dir.put("bright.csv", "variance_mm2,r,g,b\n1,6.95,1,1\n");
    const auto bright = dir.load(kMesh + "[skin]\nprofile = \"bright.csv\"\n");
    if (!bright) {
        EXPECT_NE(bright.error().message.find("6.95"), std::string::npos) << bright.error().message;
    } else {
        EXPECT_NE(all_warnings(*bright).find("has an albedo of 6.95, and skin reflects 1 at most"),
                  std::string::npos)
            << all_warnings(*bright);
    }
    const auto dark =
        dir.load(kMesh + "[skin]\nprofile = \"openpbr_skin_6\"\n[material.face]\nalbedo = [0.7, 0.5, 0.4]\n");
    ASSERT_TRUE(dark) << dark.error().message;
    EXPECT_NE(all_warnings(*dark).find("set skin.tone = 1 (light) to 6 (dark) for both"), std::string::npos)
        << all_warnings(*dark);
}
