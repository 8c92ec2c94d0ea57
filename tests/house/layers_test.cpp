// The arrows of the house: a folder of src/ includes only what its arrow in CMake allows.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using Layers = std::map<std::string, std::set<std::string>>;

namespace {

// layers.txt has one line a folder, written by dermis_library: "bake: optics mesh image".
Layers read_layers() {
    Layers layers;
    std::ifstream file(DERMIS_BINARY_DIR "/layers.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string folder;
        words >> folder;
        folder.pop_back();
        layers[folder] = {};
        for (std::string arrow; words >> arrow;) layers[folder].insert(arrow);
    }
    return layers;
}

std::set<std::string> reachable(const Layers& layers, const std::string& folder) {
    std::set<std::string> all = {folder};
    for (const std::string& arrow : layers.at(folder)) all.merge(reachable(layers, arrow));
    return all;
}

std::vector<std::string> forbidden_includes(const std::string& source, const std::set<std::string>& allowed) {
    static const std::regex include(R"re(#include ["<]dermis/([a-z_]+)/)re");
    std::vector<std::string> found;
    for (std::sregex_iterator it(source.begin(), source.end(), include), end; it != end; ++it)
        if (!allowed.contains((*it)[1])) found.push_back((*it)[1]);
    return found;
}

std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool is_source(const fs::path& path) {
    return path.extension() == ".cpp" || path.extension() == ".h";
}

}  // namespace

TEST(House, every_include_follows_an_arrow) {
    const Layers layers = read_layers();
    ASSERT_TRUE(layers.contains("base"));
    size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(DERMIS_SOURCE_DIR "/src")) {
        if (!is_source(entry.path())) continue;
        const std::string folder = fs::relative(entry.path(), DERMIS_SOURCE_DIR "/src").begin()->string();
        ASSERT_TRUE(layers.contains(folder)) << folder << " has no dermis_library()";
        for (const std::string& wrong : forbidden_includes(read(entry.path()), reachable(layers, folder)))
            ADD_FAILURE() << entry.path() << " includes " << wrong << ", which " << folder << " must not";
        ++files;
    }
    EXPECT_GT(files, 5u);
}

TEST(House, a_forbidden_include_is_found) {
    EXPECT_EQ(forbidden_includes("#include \"dermis/gpu/device.h\"\n#include \"dermis/base/result.h\"\n",
                                 {"base", "optics"}),
              std::vector<std::string>{"gpu"});
}

TEST(House, techniques_never_include_gpu_or_render) {
    for (const auto& entry : fs::recursive_directory_iterator(DERMIS_SOURCE_DIR "/techniques")) {
        if (!is_source(entry.path())) continue;
        EXPECT_TRUE(forbidden_includes(read(entry.path()),
                                       {"base", "image", "mesh", "optics", "bake", "fit", "technique"})
                        .empty())
            << entry.path();
    }
}

TEST(House, vulkan_headers_stay_in_gpu) {
    static const std::regex vulkan(R"re(#include ["<](volk\.h|vulkan/))re");
    for (const char* tree : {"/src", "/techniques", "/apps/cli"})
        for (const auto& entry : fs::recursive_directory_iterator(std::string(DERMIS_SOURCE_DIR) + tree)) {
            if (!is_source(entry.path()) || entry.path().string().find("/src/gpu/") != std::string::npos)
                continue;
            EXPECT_FALSE(std::regex_search(read(entry.path()), vulkan)) << entry.path();
        }
}

TEST(House, no_source_file_is_over_500_lines) {
    for (const char* tree : {"/src", "/techniques", "/apps", "/shaders", "/tests", "/bench"})
        for (const auto& entry : fs::recursive_directory_iterator(std::string(DERMIS_SOURCE_DIR) + tree)) {
            if (!is_source(entry.path())) continue;
            const std::string text = read(entry.path());
            EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 500) << entry.path();
        }
}

TEST(House, installed_headers_show_the_standard_library_and_nothing_else) {
    static const std::regex foreign(R"re(#include (?:<(?!dermis/)[^>]*[./][^>]*>|"(?!dermis/)[^"]*"))re");
    static const std::regex vulkan_or_throw(R"re(\bVk[A-Z]\w*|\bVK_\w+|\bthrow\b)re");
    size_t headers = 0;
    for (const char* folder : {"base", "image", "mesh", "optics", "bake", "fit"})
        for (const auto& entry : fs::directory_iterator(DERMIS_SOURCE_DIR "/src/" + std::string(folder))) {
            if (entry.path().extension() != ".h") continue;
            const std::string text = read(entry.path());
            EXPECT_FALSE(std::regex_search(text, foreign)) << entry.path();
            EXPECT_FALSE(std::regex_search(text, vulkan_or_throw)) << entry.path();
            // What a public header includes is installed too.
            EXPECT_EQ(text.find("/codec/"), std::string::npos) << entry.path();
            EXPECT_EQ(text.find("#include \"dermis/optics/preintegration/"), std::string::npos)
                << entry.path();
            ++headers;
        }
    EXPECT_GT(headers, 20u);
    EXPECT_TRUE(std::regex_search(std::string("#include <nlohmann/json.hpp>"), foreign));
    EXPECT_TRUE(std::regex_search(std::string("#include <png.h>"), foreign));
    EXPECT_FALSE(
        std::regex_search(std::string("#include <vector>\n#include \"dermis/base/result.h\""), foreign));
}
