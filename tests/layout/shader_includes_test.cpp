// Dependencies between folders of shaders: what techniques include is in shaders/include, atlas and screen,
// and neither the renderer's own passes nor another technique's folder.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "test_paths.h"

namespace fs = std::filesystem;

namespace {

const fs::path kShaderRoot = DERMIS_SOURCE_DIR;

struct ShaderFile {
    std::string folder;                 // "shaders/atlas", "techniques/wrap"
    std::vector<std::string> includes;  // as they are written
    bool numbers_bindings = false;
};

bool numbers_bindings(const std::string& text) {
    return std::regex_search(text, std::regex(R"re(\bbinding *=)re"));
}

std::vector<std::string> includes_of(const std::string& text) {
    static const std::regex include(R"re(#include "([^"]+)")re");
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
        found.push_back((*it)[1]);
    return found;
}

std::vector<ShaderFile> shader_files() {
    static const std::set<fs::path> kExtensions = {".glsl", ".vert", ".frag", ".comp"};
    std::vector<ShaderFile> files;
    for (const char* tree : {"shaders", "techniques"})
        for (const auto& entry : fs::recursive_directory_iterator(kShaderRoot / tree)) {
            if (!kExtensions.contains(entry.path().extension())) continue;
            std::ifstream file(entry.path());
            const std::string text = {std::istreambuf_iterator<char>(file), {}};
            files.push_back({fs::relative(entry.path().parent_path(), kShaderRoot).generic_string(),
                             includes_of(text), numbers_bindings(text)});
        }
    return files;
}

// Why a shader of `folder` must not include this; empty when it may.
std::string objection(const std::string& folder, const std::string& include) {
    if (!fs::is_regular_file(kShaderRoot / include))
        return "there is no such file, seen from the repository's root";
    const std::string from = fs::path(include).parent_path().generic_string();
    if (from == folder || from == "shaders/include/skin") return "";
    if (folder == "shaders/include/skin") return "it is to include its own folder only";
    if (from == "shaders/include") return "";
    if (folder == "shaders/include") return "it is to include its own folder and shaders/include/skin only";
    if ((from == "shaders/atlas" || from == "shaders/screen") && folder.starts_with("techniques/")) return "";
    return from + " is not for it";
}

}  // namespace

TEST(ShaderIncludes, follow_the_layout) {
    std::set<std::string> folders;
    size_t includes = 0;
    for (const ShaderFile& file : shader_files()) {
        folders.insert(file.folder);
        for (const std::string& include : file.includes) {
            ++includes;
            EXPECT_EQ(objection(file.folder, include), "") << file.folder << " includes " << include;
        }
    }
    EXPECT_GT(includes, 30u);
    for (const char* folder : {"shaders/include", "shaders/include/skin", "shaders/renderer", "shaders/atlas",
                               "shaders/screen", "techniques/lambert"})
        EXPECT_TRUE(folders.contains(folder)) << folder;
}

TEST(ShaderIncludes, of_the_wrong_folder_are_found) {
    const auto first = [](const char* text) { return includes_of(text).at(0); };
    const std::string frame = first("#version 460\n#include \"shaders/include/frame.glsl\"\n");
    EXPECT_EQ(objection("techniques/wrap", frame), "");
    EXPECT_EQ(objection("techniques/wrap", "shaders/atlas/light.glsl"), "");
    EXPECT_NE(objection("techniques/wrap", "shaders/renderer/tone_map.glsl"), "");
    EXPECT_NE(objection("techniques/wrap", "techniques/texture_space_gaussians/gaussian.glsl"), "");
    EXPECT_NE(objection("shaders/include", "shaders/renderer/tone_map.glsl"), "");
    EXPECT_EQ(objection("shaders/include", "shaders/include/skin/pi.glsl"), "");
    EXPECT_NE(objection("shaders/include/skin", frame), "");
    EXPECT_EQ(objection("techniques/wrap", "shaders/screen/rays.glsl"), "");
    EXPECT_NE(objection("shaders/atlas", "shaders/screen/rays.glsl"), "");
    EXPECT_NE(objection("shaders/include", "shaders/atlas/light.glsl"), "");
    EXPECT_NE(objection("shaders/renderer", "shaders/atlas/light.glsl"), "");
    EXPECT_NE(objection("shaders/atlas", "techniques/texture_space_gaussians/gaussian.glsl"), "");
    EXPECT_NE(objection("techniques/wrap", "include/frame.glsl"), "");
}

// Numbers would be ignored: bindings are found by name.
TEST(Shaders, do_not_number_their_bindings) {
    for (const ShaderFile& file : shader_files()) EXPECT_FALSE(file.numbers_bindings) << file.folder;
    EXPECT_TRUE(numbers_bindings("layout(set = 0, binding = 3) uniform texture2D a;"));
}
