// dpkg's data on the installed packages, and the files that the CMake packages among them require.

#include <array>
#include <cstdio>
#include <fstream>
#include <regex>
#include <sstream>

#include "packages_evidence.h"

namespace dermis {
namespace {

std::string output_of(const std::string& command) {
    std::string output;
    FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
    if (!pipe) return output;
    std::array<char, 4096> buffer;
    for (size_t count; (count = ::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        output.append(buffer.data(), count);
    ::pclose(pipe);
    return output;
}

// "libc6 (>= 2.36), libpng16-16 | libpng": the names, each alternative by itself.
std::vector<std::string> names_in(const std::string& field) {
    static const std::regex name(R"((?:^|[,|])\s*([a-z0-9][a-z0-9+.-]+))");
    std::vector<std::string> names;
    for (std::sregex_iterator it(field.begin(), field.end(), name), end; it != end; ++it)
        names.push_back((*it)[1]);
    return names;
}

}  // namespace

DebianPackages installed_packages() {
    DebianPackages packages;
    std::istringstream lines(output_of(
        "dpkg-query -W -f '${db:Status-Abbrev}\\t${Package}\\t${Pre-Depends},${Depends}\\t${Provides}\\n'"));
    for (std::string status, package, depends, provides; std::getline(lines, status, '\t');) {
        std::getline(std::getline(std::getline(lines, package, '\t'), depends, '\t'), provides);
        if (!status.starts_with("ii")) continue;
        for (const std::string& name : names_in(depends)) packages[package].insert(name);
        for (const std::string& name : names_in(provides)) packages[name].insert(package);
    }
    return packages;
}

std::set<std::string> with_dependencies(const std::set<std::string>& names, const DebianPackages& system) {
    std::set<std::string> all = names;
    std::vector<std::string> open(names.begin(), names.end());
    while (!open.empty()) {
        const auto known = system.find(open.back());
        open.pop_back();
        if (known == system.end()) continue;
        for (const std::string& next : known->second)
            if (all.insert(next).second) open.push_back(next);
    }
    return all;
}

std::vector<std::filesystem::path> package_folders(const std::string& cmake_cache) {
    static const std::regex entry(R"(\n\w[\w-]*_DIR:PATH=(/[^\n]+))");
    std::vector<std::filesystem::path> folders;
    for (std::sregex_iterator it(cmake_cache.begin(), cmake_cache.end(), entry), end; it != end; ++it)
        if (std::filesystem::is_directory((*it)[1].str())) folders.emplace_back((*it)[1].str());
    return folders;
}

std::vector<std::string> checked_files(const std::filesystem::path& folder) {
    // list(APPEND _IMPORT_CHECK_FILES_FOR_target "${_IMPORT_PREFIX}/lib/x86_64-linux-gnu/libjpeg.a" )
    static const std::regex line(R"(import_check_files_for_\S+((?: "[^"\n]+")+))", std::regex::icase);
    static const std::regex quoted("\"([^\"\\n]+)\"");
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".cmake") continue;
        std::ifstream file(entry.path());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) {
            const std::string names = (*it)[1];
            for (std::sregex_iterator name(names.begin(), names.end(), quoted); name != end; ++name)
                files.push_back(
                    std::regex_replace((*name)[1].str(), std::regex(R"(\$\{_IMPORT_PREFIX\})"), "/usr"));
        }
    }
    return files;
}

std::map<std::string, std::string> owners_of(const std::vector<std::string>& files) {
    std::string command = "dpkg-query -S";
    for (const std::string& file : files) command += " '" + file + "'";
    std::map<std::string, std::string> owners;
    // "libjpeg62-turbo-dev:amd64: /usr/lib/x86_64-linux-gnu/libjpeg.a"
    std::istringstream lines(output_of(command));
    for (std::string line; std::getline(lines, line);)
        if (const size_t at = line.find(": /"); at != std::string::npos)
            owners[line.substr(at + 2)] = line.substr(0, line.find_first_of(":,"));
    return owners;
}

std::vector<std::string> unlisted_owners(const std::map<std::string, std::string>& owners,
                                         const std::set<std::string>& listed) {
    std::vector<std::string> found;
    for (const auto& [file, package] : owners)
        if (!listed.contains(package))
            found.push_back("CMake looks for " + file + ", and " + file.substr(file.rfind('/') + 1) +
                            " is in " + package + ", which no list of tools/ brings");
    return found;
}

}  // namespace dermis
