// Dependencies between folders: what CMake declares for a folder of dermis/ is what its files include.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "test_paths.h"

namespace fs = std::filesystem;
using Layers = std::map<std::string, std::set<std::string>>;

namespace {

const fs::path kRoot = DERMIS_SOURCE_DIR;

// layers.txt has one line per folder, written by dermis_library: "bake: base image optics plot".
Layers declared_layers() {
    Layers layers;
    std::ifstream file(DERMIS_BINARY_DIR "/layers.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string folder;
        words >> folder;
        folder.pop_back();
        layers[folder] = {};
        for (std::string dependency; words >> dependency;) layers[folder].insert(dependency);
    }
    return layers;
}

std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool is_source(const fs::path& path) {
    return path.extension() == ".cpp" || path.extension() == ".h";
}

bool is_shader(const fs::path& path) {
    static const std::set<std::string> kExtensions = {".glsl", ".vert", ".frag", ".comp"};
    return kExtensions.contains(path.extension().string());
}

std::vector<fs::path> files_under(const std::string& tree, bool (*wanted)(const fs::path&)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / tree))
        if (entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path());
    return files;
}

std::set<std::string> included_folders(const std::string& source) {
    static const std::regex include(R"re(#include ["<]dermis/([a-z_]+)/)re");
    std::set<std::string> found;
    for (std::sregex_iterator it(source.begin(), source.end(), include), end; it != end; ++it)
        found.insert((*it)[1]);
    return found;
}

// One sentence for each difference.
std::vector<std::string> differences(const std::string& folder, const std::set<std::string>& declared,
                                     const std::set<std::string>& included) {
    std::vector<std::string> found;
    for (const std::string& name : included)
        if (!declared.contains(name))
            found.push_back(folder + " includes " + name + " and does not declare it");
    for (const std::string& name : declared)
        if (!included.contains(name))
            found.push_back(folder + " declares " + name + " and does not include it");
    return found;
}

std::set<std::string> reachable(const Layers& layers, const std::string& folder) {
    std::set<std::string> all;
    for (const std::string& next : layers.at(folder))
        if (all.insert(next).second) all.merge(reachable(layers, next));
    return all;
}

bool names_vulkan(const std::string& source) {
    static const std::regex vulkan(R"re(#include ["<](volk\.h|vulkan/)|GLFW_INCLUDE_VULKAN)re");
    return std::regex_search(source, vulkan);
}

bool is_cmake(const fs::path& path) {
    return path.filename() == "CMakeLists.txt";
}

bool names_built_in(const std::string& source) {
    static const std::regex names(
        R"re(#include ["<](techniques|subjects|catalog)/|built_in_|make_\w+_(technique|subject)\()re");
    return std::regex_search(source, names);
}

bool links_built_in(const std::string& cmake) {
    static const std::regex links(
        R"re(dermis_(techniques|subjects|catalog)|DEPENDS [^)]*\b(techniques|subjects|catalog)\b)re");
    return std::regex_search(cmake, links);
}

}  // namespace

TEST(Layout, each_folder_declares_what_it_includes_and_nothing_else) {
    const Layers layers = declared_layers();
    ASSERT_TRUE(layers.contains("base"));
    std::map<std::string, std::set<std::string>> included;
    for (const fs::path& path : files_under("dermis", is_source)) {
        const std::string folder = fs::relative(path, kRoot / "dermis").begin()->string();
        if (folder == "dermis.h") continue;
        ASSERT_TRUE(layers.contains(folder)) << folder << " has no dermis_library()";
        included[folder].merge(included_folders(read(path)));
    }
    EXPECT_GT(included.size(), 10u);
    for (auto& [folder, names] : included) {
        names.erase(folder);
        for (const std::string& text : differences(folder, layers.at(folder), names)) ADD_FAILURE() << text;
    }
}

// docs/architecture.md has the rows "| bake | base image optics plot |".
TEST(Layout, the_page_on_architecture_has_the_declared_dependencies) {
    const std::string page = read(kRoot / "docs/architecture.md");
    std::ifstream layers(DERMIS_BINARY_DIR "/layers.txt");
    size_t rows = 0;
    for (std::string line; std::getline(layers, line); ++rows) {
        const size_t colon = line.find(':');
        const std::string included = line.substr(std::min(colon + 2, line.size()));
        const std::string row = "| " + line.substr(0, colon) + " | " + included + " |";
        EXPECT_NE(page.find(row), std::string::npos) << "docs/architecture.md has no row " << row;
    }
    EXPECT_GT(rows, 10u);
}

// Two folders may use the same name for different things.
TEST(Layout, each_folder_has_a_namespace_of_its_own) {
    static const std::regex opened(R"re((?:^|\n)namespace dermis(?:::(?:inline )?([a-z_]+))?)re");
    for (const fs::path& path : files_under("dermis", is_source)) {
        const std::string folder = fs::relative(path, kRoot / "dermis").begin()->string();
        const std::string text = read(path);
        for (std::sregex_iterator it(text.begin(), text.end(), opened), end; it != end; ++it)
            EXPECT_EQ((*it)[1], folder) << path;
    }
}

TEST(Layout, no_folder_depends_on_itself_through_others) {
    const Layers layers = declared_layers();
    for (const auto& [folder, declared] : layers)
        EXPECT_FALSE(reachable(layers, folder).contains(folder)) << folder;
}

TEST(Layout, an_undeclared_and_an_unused_dependency_are_found) {
    const std::set<std::string> included =
        included_folders("#include \"dermis/gpu/device.h\"\n#include \"dermis/base/result.h\"\n");
    EXPECT_EQ(differences("bake", {"base", "optics"}, included),
              (std::vector<std::string>{"bake includes gpu and does not declare it",
                                        "bake declares optics and does not include it"}));
}

TEST(Layout, techniques_and_subjects_include_no_renderer) {
    const std::map<std::string, std::set<std::string>> allowed = {
        {"techniques", {"base", "image", "mesh", "optics", "bake", "rays", "technique"}},
        {"subjects", {"base", "image", "mesh", "optics", "scene"}}};
    for (const auto& [tree, folders] : allowed)
        for (const fs::path& path : files_under(tree, is_source)) {
            if (path.string().ends_with("_test.cpp")) continue;
            for (const std::string& folder : included_folders(read(path)))
                EXPECT_TRUE(folders.contains(folder)) << path << " includes " << folder;
        }
}

TEST(Layout, each_technique_has_a_page_and_a_test_in_its_folder) {
    size_t techniques = 0;
    for (const fs::path& path :
         files_under("techniques", [](const fs::path& p) { return p.filename() == "technique.cpp"; })) {
        const fs::path folder = path.parent_path();
        EXPECT_TRUE(fs::exists(folder / "README.md")) << folder;
        EXPECT_TRUE(std::ranges::any_of(fs::directory_iterator(folder),
                                        [](const fs::directory_entry& entry) {
                                            return entry.path().filename().string().ends_with("_test.cpp");
                                        }))
            << folder << " has no test";
        ++techniques;
    }
    EXPECT_GE(techniques, 6u);
}

TEST(Layout, fuzz_targets_take_their_dictionaries_from_files_that_exist) {
    const std::string key = "// Dictionary: ";
    size_t files = 0;
    for (const fs::path& path : files_under("tests/fuzz", is_source)) {
        const std::string text = read(path);
        const size_t line = text.find(key);
        if (line == text.npos) continue;
        std::istringstream names(text.substr(line + key.size(), text.find('\n', line) - line - key.size()));
        for (std::string name; names >> name; ++files) {
            const fs::path file = kRoot / name;
            EXPECT_TRUE(fs::exists(file.stem() == "*" ? file.parent_path() : file)) << path << ": " << name;
        }
    }
    EXPECT_GT(files, 20u);
}

TEST(Layout, no_library_of_dermis_knows_what_is_built_in) {
    for (const fs::path& path : files_under("dermis", is_source))
        EXPECT_FALSE(names_built_in(read(path))) << path;
    for (const fs::path& path : files_under("dermis", is_cmake))
        EXPECT_FALSE(links_built_in(read(path))) << path;
    EXPECT_TRUE(names_built_in("#include \"subjects/bust/bust.h\"\n"));
    EXPECT_TRUE(names_built_in("const Catalog& c = built_in_catalog();"));
    EXPECT_TRUE(links_built_in("target_link_libraries(dermis_view PUBLIC dermis_techniques)"));
    EXPECT_TRUE(links_built_in("dermis_library(view DEPENDS base subjects)"));
}

TEST(Layout, vulkan_headers_stay_in_gpu) {
    // The window makes the surface that the swapchain draws to.
    const auto may = [](const fs::path& path) {
        return path.string().find("/dermis/gpu/") != std::string::npos ||
               path.filename() == "window_surface.cpp";
    };
    for (const char* tree : {"dermis", "techniques", "subjects", "apps"})
        for (const fs::path& path : files_under(tree, is_source))
            EXPECT_TRUE(may(path) || !names_vulkan(read(path))) << path;
    EXPECT_TRUE(names_vulkan("#define GLFW_INCLUDE_VULKAN\n#include <GLFW/glfw3.h>"));
    EXPECT_TRUE(names_vulkan("#include <vulkan/vulkan.h>"));
}

TEST(Layout, no_source_file_is_over_500_lines) {
    size_t shaders = 0;
    for (const char* tree :
         {"dermis", "techniques", "subjects", "catalog", "apps", "shaders", "tests", "bench"})
        for (const fs::path& path :
             files_under(tree, [](const fs::path& p) { return is_source(p) || is_shader(p); })) {
            const std::string text = read(path);
            EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 500) << path;
            shaders += is_shader(path);
        }
    EXPECT_GT(shaders, 20u);
}

// What dermis/dermis.h includes.
std::set<std::string> public_headers() {
    static const std::regex include(R"re(#include "(dermis/[^"]+)")re");
    std::set<std::string> headers;
    const std::string text = read(kRoot / "dermis/dermis.h");
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
        headers.insert((*it)[1]);
    return headers;
}

TEST(PublicHeaders, are_those_that_the_folders_install) {
    static const std::regex listed(R"re(PUBLIC_HEADERS ([^)]*))re"), header(R"re(\w+\.h)re");
    std::set<std::string> installed;
    for (const fs::path& path : files_under("dermis", is_cmake)) {
        const std::string text = read(path), folder = path.parent_path().filename().string();
        std::smatch match;
        if (!std::regex_search(text, match, listed)) continue;
        const std::string list = match[1];
        for (std::sregex_iterator it(list.begin(), list.end(), header), end; it != end; ++it)
            installed.insert("dermis/" + folder + "/" + it->str());
    }
    EXPECT_EQ(installed, public_headers());
    EXPECT_GT(installed.size(), 20u);
}

TEST(PublicHeaders, include_the_standard_library_and_each_other) {
    static const std::regex foreign(R"re(#include (?:<(?!dermis/)[^>]*[./][^>]*>|"(?!dermis/)[^"]*"))re");
    static const std::regex include(R"re(#include "(dermis/[^"]+)")re");
    static const std::regex vulkan_or_throw(R"re(\bVk[A-Z]\w*|\bVK_\w+|\bthrow\b)re");
    const std::set<std::string> headers = public_headers();
    for (const std::string& name : headers) {
        const std::string text = read(kRoot / name);
        EXPECT_FALSE(std::regex_search(text, foreign)) << name;
        EXPECT_FALSE(std::regex_search(text, vulkan_or_throw)) << name;
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
            EXPECT_TRUE(headers.contains((*it)[1]))
                << name << " includes " << (*it)[1] << ", which is not installed";
    }
    EXPECT_TRUE(std::regex_search(std::string("#include <nlohmann/json.hpp>"), foreign));
    EXPECT_TRUE(std::regex_search(std::string("#include <png.h>"), foreign));
    EXPECT_FALSE(
        std::regex_search(std::string("#include <vector>\n#include \"dermis/base/result.h\""), foreign));
}

TEST(LibraryPage, shows_the_program_that_the_test_of_the_installed_library_compiles) {
    const std::string page = read(kRoot / "docs/library.md"),
                      program = read(kRoot / "tests/install/consumer/main.cpp");
    ASSERT_FALSE(program.empty());
    EXPECT_NE(page.find("```cpp\n" + program + "```\n"), std::string::npos)
        << "docs/library.md differs from tests/install/consumer/main.cpp";
}
