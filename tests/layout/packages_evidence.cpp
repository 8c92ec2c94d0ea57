#include "packages_evidence.h"

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

namespace dermis {
namespace {

// Shows that a package is used: a name that CMake looks for, the beginning of an included path, a program or
// a file that is used at run time. Several of a kind are separated by spaces; one of any kind is enough.
struct Evidence {
    const char* package;
    const char* cmake;
    const char* includes;
    const char* text;
};

constexpr Evidence kPackageEvidence[] = {
    {"g++", "", "", "cmake"},  // CMake's own choice of compiler
    {"cmake", "", "", "cmake -S"},
    {"ninja-build", "", "", "-G Ninja"},
    {"pkg-config", "PkgConfig", "", ""},
    {"libxxhash-dev", "libxxhash", "xxhash.h", ""},
    {"libcli11-dev", "", "CLI/", ""},
    {"libfmt-dev", "fmt", "fmt/", ""},
    {"nlohmann-json3-dev", "nlohmann_json", "nlohmann/", ""},
    {"libtomlplusplus-dev", "", "toml++/", ""},
    {"libpugixml-dev", "pugixml", "pugixml.hpp", ""},
    {"libeigen3-dev", "Eigen3", "Eigen/", ""},
    {"libopenexr-dev", "OpenEXR", "Imf Iex.h half.h", ""},
    {"libpng-dev", "PNG", "png.h", ""},
    {"libturbojpeg0-dev", "libjpeg-turbo", "turbojpeg.h", ""},
    {"libjpeg62-turbo-dev", "libjpeg-turbo", "", ""},
    {"libjpeg-turbo8-dev", "libjpeg-turbo", "", ""},
    {"libfreetype-dev", "Freetype", "ft2build.h", ""},
    {"fonts-dejavu-core", "", "", "DejaVuSans.ttf"},
    {"libosd-dev", "osdCPU", "opensubdiv/", ""},
    {"libembree-dev", "embree", "embree3/ embree4/", ""},
    {"libvulkan-dev", "", "vulkan/", "GLFW_INCLUDE_VULKAN"},
    {"libvulkan-volk-dev", "", "volk.h", ""},
    {"mesa-vulkan-drivers", "", "", "lavapipe"},
    {"libglfw3-dev", "glfw3", "GLFW/", ""},
    {"libimgui-dev", "imgui", "imgui.h", ""},
    {"glslc", "glslc", "", ""},
    {"libspirv-cross-c-shared-dev", "spirv-cross-c-shared", "spirv_cross/", ""},
    {"libgtest-dev", "GTest", "gtest/", ""},
    {"libgmock-dev", "", "gmock/", ""},
    {"libbenchmark-dev", "benchmark", "benchmark/", ""},
    {"vulkan-validationlayers", "", "", "VK_LAYER_KHRONOS_validation"},
    {"xvfb", "", "", "Xvfb"},
    {"libnvtt-bin", "", "", "nvddsinfo"},
    {"chromium", "", "", "\"chromium\""},
    {"nodejs", "", "", "\"node\""},
    {"twm", "", "", "twm"},
    {"xdotool", "", "", "xdotool"},
    {"x11-utils", "", "", "xprop"},
    {"python3", "", "", "python3 -u"},
    {"curl", "", "", "curl --fail"},
    {"ffmpeg", "", "", "ffmpeg"},
    {"clang", "", "", "clang++"},
    {"clang-format", "", "", "clang-format"},
    {"libclang-rt-dev", "", "", "libclang-rt-dev"},
    {"dpkg-dev", "dpkg-shlibdeps", "", ""},
    {"file", "file", "", ""},
    {"pybind11-dev", "pybind11", "pybind11/", ""},
    {"python3-dev", "Python", "", ""},
    {"python3-numpy", "", "", "import numpy"},
    {"python3-venv", "", "", "\"venv\""},
    {"python3-matplotlib", "", "", "import matplotlib"},
};

// These need no package: they are part of CMake, optional, or of the repository.
const std::set<std::string> kOwnCmakeNames = {"Threads", "ccache", "dermis"};
// Folders and files of the C library; a header without '.' or '/' is C++'s own.
const std::regex kSystemHeader(
    R"((sys/.*|fnmatch\.h|unistd\.h|spawn\.h|signal\.h|fcntl\.h|std(lib|io)\.h|poll\.h|dlfcn\.h|pthread\.h|errno\.h|windows\.h|shellapi\.h))");

std::set<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

std::set<std::string> all_matches(const std::string& text, const std::regex& pattern) {
    std::set<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        for (const std::string& word : words((*it)[1])) found.insert(word);
    return found;
}

std::set<std::string> cmake_names(const std::string& cmake) {
    static const std::regex package(R"(find_(?:package|dependency)\(\s*([\w+-]+))");
    static const std::regex variable(
        R"(find_(?:program|library|path|file)\(\s*\w+\s+(?:NAMES\s+)?([\w+.-]+))");
    static const std::regex module(R"(pkg_(?:check_modules|search_module)\(\s*\w+((?:\s+[\w.+-]+)*))");
    static const std::set<std::string> kKeywords = {"REQUIRED", "QUIET", "IMPORTED_TARGET", "GLOBAL"};
    std::set<std::string> names = all_matches(cmake, package);
    names.merge(all_matches(cmake, variable));
    names.merge(all_matches(cmake, module));
    std::erase_if(names, [](const std::string& name) {
        return kKeywords.contains(name) || kOwnCmakeNames.contains(name);
    });
    return names;
}

std::set<std::string> foreign_includes(const std::string& sources) {
    static const std::regex include(R"((?:^|\n)#include <([^>\n]*[./][^>\n]*)>)");
    std::set<std::string> found = all_matches(sources, include);
    std::erase_if(found, [](const std::string& path) { return std::regex_match(path, kSystemHeader); });
    return found;
}

bool includes_any(const Evidence& evidence, const std::string& path) {
    return std::ranges::any_of(words(evidence.includes),
                               [&](const std::string& start) { return path.starts_with(start); });
}

std::set<std::string> readme_packages(const std::string& readme) {
    const size_t begin = std::min(readme.find("## Dependencies"), readme.size());
    const std::string section = readme.substr(begin, readme.find("\n## ", begin) - begin);
    static const std::regex row(R"(\n\| ([^|]+) \|)");
    std::set<std::string> names;
    for (std::sregex_iterator it(section.begin(), section.end(), row), end; it != end; ++it)
        names.merge(words(std::regex_replace((*it)[1].str(), std::regex(","), " ")));
    names.erase("package");
    return names;
}

// The packages of what is looked for or included; a sentence for each that is not listed or not known.
template <class Matches>
void check_uses(const std::set<std::string>& uses, const std::string& verb,
                const std::set<std::string>& listed, std::vector<std::string>& found, Matches matches) {
    for (const std::string& name : uses) {
        bool known = false;
        for (const Evidence& evidence : kPackageEvidence) {
            if (!matches(evidence, name)) continue;
            known = true;
            if (!listed.contains(evidence.package))
                found.push_back(verb + name + ", and " + evidence.package + " is in no list of tools/");
        }
        if (!known) found.push_back(verb + name + ": add its package to kPackageEvidence of this test");
    }
}

}  // namespace

std::set<std::string> listed_packages(const std::string& lists) {
    std::set<std::string> names = words(std::regex_replace(lists, std::regex("#[^\n]*|\\|"), " "));
    names.erase("-");
    return names;
}

std::vector<std::string> disagreements(const PackageUse& use) {
    const std::set<std::string> listed = listed_packages(use.lists), readme = readme_packages(use.readme),
                                names = cmake_names(use.cmake), includes = foreign_includes(use.sources);
    std::vector<std::string> found;
    check_uses(names, "CMake looks for ", listed, found,
               [](const Evidence& evidence, const std::string& name) {
                   return words(evidence.cmake).contains(name);
               });
    std::set<std::string> paths;
    for (const std::string& path : includes) paths.insert("<" + path + ">");
    check_uses(paths, "a source includes ", listed, found,
               [](const Evidence& evidence, const std::string& path) {
                   return includes_any(evidence, path.substr(1));
               });
    for (const std::string& package : listed) {
        const auto known = std::ranges::find(kPackageEvidence, package, &Evidence::package);
        if (known == std::end(kPackageEvidence)) {
            found.push_back(package +
                            " is listed, and kPackageEvidence of this test does not say what shows its use");
            continue;
        }
        const std::string text = known->text;
        if (!std::ranges::any_of(names,
                                 [&](const auto& name) { return words(known->cmake).contains(name); }) &&
            !std::ranges::any_of(includes, [&](const auto& path) { return includes_any(*known, path); }) &&
            (text.empty() || use.texts.find(text) == std::string::npos))
            found.push_back(package + " is listed, and nothing uses it");
    }
    for (const std::string& package : listed)
        if (!readme.contains(package))
            found.push_back(package + " is listed, and README's table does not name it");
    for (const std::string& package : readme)
        if (!listed.contains(package))
            found.push_back("README names " + package + ", which is in no list of tools/");
    return found;
}

}  // namespace dermis
