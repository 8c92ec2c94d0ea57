// Profiles for the engines' own skin, read back from what is written. No editor was run.

#include "dermis/engines/native.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/optics/conversions.h"
#include "engines/packages.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using testing::HasSubstr;

std::string native_file(const std::string& engine, const std::string& path) {
    const auto files =
        make_native_profile(engine, *find_profile("openpbr_skin_5"), built_in_package_templates());
    EXPECT_TRUE(files) << files.error().message;
    for (const PackageFile& file : *files)
        if (file.path == path) return {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()};
    ADD_FAILURE() << engine << " has no " << path;
    return "";
}

std::vector<double> numbers_of(const std::string& text, const std::string& start) {
    std::smatch line;
    EXPECT_TRUE(std::regex_search(text, line, std::regex(start + ".*"))) << start;
    std::vector<double> numbers;
    const std::string rest = line.str().substr(start.size());
    const std::regex number("[0-9.]+(e[-+]?[0-9]+)?");
    for (std::sregex_iterator i(rest.begin(), rest.end(), number), end; i != end; ++i)
        numbers.push_back(std::stod(i->str()));
    return numbers;
}

void expect_skin(const ToolSettings& settings) {
    const BurleyProfile wanted = burley_equivalent(*find_profile("openpbr_skin_5"));
    const auto read = to_canonical(settings);
    ASSERT_TRUE(read) << read.error().message;
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(read->d_mm[c] / wanted.d_mm[c], 1, 1e-4);
}

TEST(NativeProfile, of_hdrp_is_the_skins_burley_profile) {
    const std::string asset = native_file("unity_hdrp", "Skin.asset");
    ToolSettings settings = default_settings(ToolId::hdrp);
    const std::vector<double> color = numbers_of(asset, "scatteringDistance:");
    ASSERT_EQ(color.size(), 4u);
    ASSERT_TRUE(set_value(settings, "scatteringDistance", {color.begin(), color.begin() + 3}));
    ASSERT_TRUE(set_value(settings, "scatteringDistanceMultiplier",
                          numbers_of(asset, "scatteringDistanceMultiplier:")));
    expect_skin(settings);
    EXPECT_THAT(native_file("unity_hdrp", "README.md"),
                HasSubstr("# A diffusion profile for HDRP: openpbr_skin_5"));
}

constexpr const char* kValueRecorder = R"(
import sys
from unittest.mock import MagicMock
class Recorded(MagicMock):
    def set_editor_property(self, name, value):
        print(name + ":", value)
editor = Recorded()
editor.LinearColor = lambda *values: values
sys.modules["unreal"] = editor
exec(compile(open(sys.argv[1]).read(), "skin_profile.py", "exec"))
)";

TEST(NativeProfile, of_unreal_is_the_skins_burley_profile) {
    if (std::system("command -v python3 >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
    const TemporaryDirectory directory;
    const auto script = directory.path / "skin_profile.py", recorder = directory.path / "record.py",
               log = directory.path / "log.txt";
    ASSERT_TRUE(write_text_file(script, native_file("unreal", "skin_profile.py")));
    ASSERT_TRUE(write_text_file(recorder, kValueRecorder));
    ASSERT_EQ(run_program({"python3", "-B", recorder.string(), script.string()}, log), 0);
    const std::string said = *read_text_file(log);
    ToolSettings settings = default_settings(ToolId::unreal);
    for (const char* key :
         {"surface_albedo", "mean_free_path_color", "mean_free_path_distance", "world_unit_scale"}) {
        std::vector<double> values = numbers_of(said, std::string(key) + ":");
        if (values.size() == 4) values.pop_back();  // alpha
        const Result<void> set = set_value(settings, key, values);
        ASSERT_TRUE(set) << set.error().message;
    }
    expect_skin(settings);
    EXPECT_THAT(said, HasSubstr("enable_mean_free_path: False"));
}

TEST(NativeProfile, another_engine_is_refused_with_those_that_have_one) {
    const auto files =
        make_native_profile("godot", *find_profile("openpbr_skin_5"), built_in_package_templates());
    ASSERT_FALSE(files);
    EXPECT_EQ(files.error().message, "--native: no profile for godot; there is one for unity_hdrp, unreal");
}

}  // namespace
}  // namespace dermis
