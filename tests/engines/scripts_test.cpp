// What the packages have beside shaders: JSON that parses, and Unreal's script, run with an object in place
// of the editor's module that records what is set. No editor was run.

#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "engines/packages.h"
#include "engines/readme_steps.h"
#include "support/temporary_directory.h"

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

// Every value by its name in the editor, for the table and for the nodes of the material.
constexpr const char* kRecorder = R"(
import sys
from unittest.mock import MagicMock
class Recorded(MagicMock):
    def set_editor_property(self, name, value):
        print("set", name, value if isinstance(value, (bool, int, float, str)) else "object")
editor = Recorded()
editor.EditorAssetLibrary.does_asset_exist.return_value = False
sys.modules["unreal"] = editor
sys.path.insert(0, sys.argv[1])
exec(sys.argv[2])
for call in editor.MaterialEditingLibrary.connect_material_expressions.call_args_list:
    print("connect", call.args[3])
)";

// By the line in the README's steps.
TEST(UnrealScript, imports_the_table_with_its_settings_and_connects_every_input_of_the_node) {
    if (std::system("command -v python3 >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
    const TemporaryDirectory directory;
    for (const auto& [path, text] : package_of("unreal", "openpbr_skin_5"))
        ASSERT_TRUE(write_text_file(directory.path / path, text));
    ASSERT_TRUE(write_text_file(directory.path / "record.py", kRecorder));
    const auto log = directory.path / "log.txt";
    EXPECT_EQ(run_program({"python3", "-B", (directory.path / "record.py").string(),
                           (directory.path / "DermisSkin/Content/Python").string(),
                           lines_with(readme_of("unreal"), "import dermis_skin").front()},
                          log),
              0);
    const auto said = read_text_file(log);
    ASSERT_TRUE(said);
    for (const char* line :
         {"set filename ", "/DermisSkin/Resources/SkinTable.exr\n", "set destination_path /DermisSkin\n",
          "set srgb False\n", "set compression_settings object\n", "set never_stream True\n",
          "set address_x object\n", "set include_file_paths object\n", "connect Table\n", "connect Normal\n",
          "connect Position\n", "connect LightDirection\n", "connect Albedo\n", "connect LightColor\n",
          "connect Thickness\n"})
        EXPECT_THAT(*said, testing::HasSubstr(line));
}

}  // namespace
}  // namespace dermis
