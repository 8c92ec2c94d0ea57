// dermis report: the program and the machine as text for a fault report.

#include <fnmatch.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/text.h"
#include "dermis/gpu/device.h"
#include "dermis/scene/scene_files.h"

namespace dermis::cli {
namespace {

namespace fs = std::filesystem;

// Packages that can change a picture: drivers, loaders, and linked libraries. Names of libraries carry a
// version that differs between releases, so these are patterns of dpkg-query and fnmatch().
constexpr const char* kPackages[] = {
    "mesa-vulkan-drivers", "libvulkan1",     "vulkan-validationlayers", "libembree[0-9]*", "libopenexr-*",
    "libpng16-16*",        "libturbojpeg0*", "libfreetype6*",           "libglfw3",        "glslc",
    "fonts-dejavu-core"};
constexpr const char* kVariables[] = {
    "DERMIS_ASSETS",  "DERMIS_FONT",      "VK_ICD_FILENAMES", "VK_DRIVER_FILES", "VK_INSTANCE_LAYERS",
    "LP_NUM_THREADS", "XDG_SESSION_TYPE", "DISPLAY",          "WAYLAND_DISPLAY"};

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif
#ifdef NDEBUG
constexpr const char* kAssertions = "without assertions";
#else
constexpr const char* kAssertions = "with assertions";
#endif

// Standard output and error of a program; empty when it cannot be started.
std::string output_of(const std::vector<std::string>& arguments) {
    std::string log = (fs::temp_directory_path() / "dermis-report-XXXXXX").string();
    const int file = ::mkstemp(log.data());
    if (file < 0) return {};
    ::close(file);
    const int status = run_program(arguments, log);
    const Result<std::string> text = read_text_file(log);
    std::error_code ignored;
    fs::remove(log, ignored);
    return text && status != 127 && status != -1 ? *text : std::string();
}

// The value after the separator in the first line that begins with `key`: "model name : X", "PRETTY_NAME=X".
std::string value_in(const char* file, std::string_view key, char separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const size_t at = line.find(separator);
        if (!line.starts_with(key) || at == std::string::npos) continue;
        std::string value = line.substr(at + 1);
        std::erase(value, '"');
        return value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
    }
    return "unknown";
}

std::string version_text() {
    std::string text = "dermis " DERMIS_VERSION;
    if (const fs::path source = source_directory(); !source.empty() && fs::exists(source / ".git")) {
        std::string commit =
            output_of({"git", "-C", source.string(), "describe", "--tags", "--always", "--dirty"});
        if (commit.starts_with("fatal")) commit.clear();
        while (commit.ends_with('\n')) commit.pop_back();
        if (!commit.empty()) text += " (" + commit + ")";
    }
    return text + ", " + kCompiler + ", " + kAssertions;
}

std::string system_text() {
    utsname kernel = {};
    ::uname(&kernel);
    return value_in("/etc/os-release", "PRETTY_NAME", '=') + ", " + kernel.sysname + " " + kernel.release +
           " " + kernel.machine;
}

std::string processor_text() {
    const double gigabytes = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE)) / 1e9;
    char memory[32];
    std::snprintf(memory, sizeof memory, "%.1f GB", gigabytes);
    return value_in("/proc/cpuinfo", "model name", ':') + ", " +
           std::to_string(std::thread::hardware_concurrency()) + " threads, " + memory;
}

std::string device_text() {
    const Result<std::vector<gpu::DeviceInfo>> devices = gpu::list_devices();
    if (!devices) return "device:    none: " + devices.error().message + "\n";
    std::string text;
    for (const gpu::DeviceInfo& device : *devices) {
        std::vector<std::string> samples;
        for (int count : device.sample_counts) samples.push_back(std::to_string(count));
        text += "device:    " + device.name + "; " + device.driver + "; Vulkan " + device.vulkan + "; MSAA " +
                join(samples, " ") + "; " +
                (device.push_descriptors ? "pushed descriptors" : "descriptor sets from a pool") + "\n";
        for (const std::string& missing : device.missing) text += "  lacks:   " + missing + "\n";
    }
    return text;
}

// dpkg-query also lists packages that are not installed, without a version.
std::string installed_versions(const std::string& answer, const char* pattern) {
    std::vector<std::string> found;
    std::istringstream lines(answer);
    for (std::string name, version; std::getline(std::getline(lines, name, '\t'), version);)
        if (!version.empty() && !name.ends_with("-dev") && ::fnmatch(pattern, name.c_str(), 0) == 0)
            found.push_back(name + " " + version);
    return found.empty() ? std::string(pattern) + " (not installed)" : join(found, ", ");
}

std::string package_text() {
    std::vector<std::string> query = {"dpkg-query", "-W", "-f", "${Package}\t${Version}\n"};
    query.insert(query.end(), std::begin(kPackages), std::end(kPackages));
    const std::string answer = output_of(query);
    if (answer.empty()) return "unknown (no dpkg-query here)";
    std::vector<std::string> found;
    for (const char* pattern : kPackages) found.push_back(installed_versions(answer, pattern));
    return join(found, ", ");
}

std::string variable_text() {
    std::vector<std::string> set;
    for (const char* name : kVariables)
        if (const char* value = std::getenv(name)) set.push_back(std::string(name) + "=" + value);
    return set.empty() ? "none of its variables set" : join(set, " ");
}

Result<int> print_report() {
    const std::string missing = DERMIS_VIEW_MISSING;
    const std::string text = "version:   " + version_text() + "\nsystem:    " + system_text() +
                             "\nprocessor: " + processor_text() + "\n" + device_text() +
                             "window:    " + (missing.empty() ? "built" : "not built, missing " + missing) +
                             "\nscenes:    " + join(scene_names(), " ") + "\nvariables: " + variable_text() +
                             "\npackages:  " + package_text() + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

}  // namespace

void add_report_command(CommandLine& line) {
    Command* command =
        line.add("report", "Prints version, devices, drivers and packages for a fault report; sends nothing",
                 "dermis report > report.txt");
    line.when_chosen(command, writes_nothing, print_report);
}

}  // namespace dermis::cli
