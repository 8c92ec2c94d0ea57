// What the packages have beside shaders: JSON that parses, and Unreal's scripts, run with
// unreal_head/unreal.py in place of the editor's module, which keeps what they make. No editor was run.

#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/run_program.h"
#include "dermis/base/angle.h"
#include "dermis/base/file.h"
#include "engines/packages.h"
#include "engines/readme_steps.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

TEST(PackageFiles, of_json_parse_and_name_folders_that_exist) {
    for (const std::string& engine : engine_names())
        for (const auto& [path, text] : package_of(engine, "openpbr_skin_5"))
            if (path.ends_with(".json") || path.ends_with(".uplugin")) {
                EXPECT_FALSE(nlohmann::json::parse(text, nullptr, false).is_discarded()) << path;
            }
    const auto files = package_of("unity", "openpbr_skin_5");
    const auto package = nlohmann::json::parse(files.at("package.json"));
    for (const auto& sample : package.at("samples")) {
        const std::string folder = sample.at("path").get<std::string>() + "/";
        EXPECT_TRUE(files.lower_bound(folder) != files.end() &&
                    files.lower_bound(folder)->first.starts_with(folder));
    }
}

// A package, and what a script of it says.
class UnrealScript : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("python3")) GTEST_SKIP() << "no python3 here";
    }
    void write_skin() {
        for (const auto& [path, text] : package_of("unreal", "openpbr_skin_5"))
            ASSERT_TRUE(write_text_file(directory_.path / path, text));
    }
    void export_sphere() {
        const ProgramResult made = run_shell(DERMIS_PROGRAM " export --engine unreal " DERMIS_SOURCE_DIR
                                                            "/tests/engines/sphere_8mm.toml -o " +
                                                 directory_.path.string(),
                                             directory_.path.string());
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    ProgramResult run_script(const std::string& script) {
        return run_shell("python3 -B " DERMIS_SOURCE_DIR "/tests/engines/unreal_head/unreal.py " +
                             (directory_.path / "DermisSkin/Content/Python").string() + " '" + script + "'",
                         directory_.path.string());
    }
    nlohmann::json made_by(const std::string& script) {
        const ProgramResult result = run_script(script);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out, nullptr, false);
    }
    TemporaryDirectory directory_;
};

// The names of inputs of the Custom node that are connected.
std::set<std::string> connected_inputs(const nlohmann::json& editor, size_t custom) {
    std::set<std::string> names;
    for (const auto& link : editor["links"])
        if (link.contains("to") && link["to"] == custom) names.insert(std::string(link["input"]));
    return names;
}

// By the line in the README.
TEST_F(UnrealScript, imports_the_table_with_its_settings_and_connects_every_input_of_the_node) {
    write_skin();
    const auto editor = made_by("import dermis_skin; dermis_skin.install()");
    const auto& table = editor["assets"]["/DermisSkin/T_SkinTable"];
    EXPECT_TRUE(std::string(table["file"]).ends_with("/DermisSkin/Resources/SkinTable.exr"));
    EXPECT_EQ(table["srgb"], false);
    EXPECT_EQ(table["compression_settings"], "TC_HDR");
    EXPECT_EQ(table["mip_gen_settings"], "TMGS_NO_MIPMAPS");
    EXPECT_EQ(table["never_stream"], true);
    EXPECT_EQ(table["address_x"], "TA_CLAMP");
    for (size_t i = 0; i < editor["nodes"].size(); ++i)
        if (editor["nodes"][i]["kind"] == "MaterialExpressionCustom") {
            EXPECT_THAT(connected_inputs(editor, i),
                        testing::ElementsAre("Albedo", "LightColor", "LightDirection", "Normal", "Position",
                                             "Table", "Thickness"));
        }
}

TEST_F(UnrealScript, without_a_head_says_so) {
    write_skin();
    const ProgramResult result = run_script(lines_with(readme_of("unreal"), "import dermis_head").front());
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, testing::HasSubstr("the package has no head; export it with a scene"));
}

// By the line in the README's steps, twice: the second head takes the place of the first one.
TEST_F(UnrealScript, places_the_head_with_linear_maps_lights_and_camera) {
    export_sphere();
    const std::string line = lines_with(readme_of("unreal"), "import dermis_head").front();
    const auto editor = made_by(line + "; dermis_head.build()");
    const auto scene = nlohmann::json::parse(*read_text_file(directory_.path / "DermisSkin/Head/scene.json"));
    ASSERT_EQ(editor["actors"].size(), scene["objects"].size() + 2);
    const auto& light = editor["actors"][scene["objects"].size()];
    for (const auto& [path, asset] : editor["assets"].items()) {
        if (!asset.contains("file") || std::string(asset["file"]).ends_with(".glb")) continue;
        EXPECT_EQ(asset["srgb"], path.ends_with("_albedo")) << path;
        EXPECT_NE(asset["compression_settings"], "TC_DEFAULT") << path;
        EXPECT_EQ(asset["never_stream"], true) << path;
    }
    const auto& mesh = editor["assets"]["/DermisSkin/Head/SM_object_0"];
    for (const char* off : {"recompute_normals", "recompute_tangents", "generate_lightmap_u_vs"})
        EXPECT_EQ(mesh["build_settings"][off], false) << off;
    EXPECT_EQ(mesh["build_settings"]["use_full_precision_u_vs"], true);
    EXPECT_EQ(mesh["nanite_settings"]["enabled"], false);
    EXPECT_TRUE(mesh["static_materials"][0].contains("material_interface"));

    // Unreal's light and the skin's come from one side, which is x, z, y of the file's.
    const auto& to_light = scene["lights"][0]["to_light"];
    const auto& forward = light["rotation"]["forward"];
    for (const auto& node : editor["nodes"]) {
        if (node.value("parameter_name", "") != "Light0Direction") continue;
        for (size_t i = 0; i < 3; ++i) {
            const float expected = to_light[std::array{0, 2, 1}[i]];
            EXPECT_FLOAT_EQ(float(node["default_value"][i]), expected);
            EXPECT_FLOAT_EQ(float(forward[i]), -expected);
        }
    }
    EXPECT_FLOAT_EQ(float(light["light_component"]["intensity"]), kPi);
}

// A version of the editor that imports glTF in another way gives no wrong head.
TEST_F(UnrealScript, finds_an_importer_that_turns_the_mesh) {
    export_sphere();
    const ProgramResult result = run_script(
        "import unreal, dermis_head\n"
        "unreal.StaticMesh.get_bounding_box = lambda mesh: unreal.Box(mesh.box.min, unreal.Vector())\n"
        "dermis_head.build()");
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, testing::HasSubstr("turned or scaled object_0.glb"));
}

}  // namespace
}  // namespace dermis
