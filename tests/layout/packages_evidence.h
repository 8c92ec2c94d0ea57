#pragma once
// Whether a Debian package is used, and dpkg's data on installed ones.

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dermis {

/// Texts of a repository, each in one string.
struct PackageUse {
    std::string lists;    ///< tools/packages*.txt: "NAME" or "NAME | NAME" per line, '#' begins a comment
    std::string readme;   ///< the table below "## Dependencies"
    std::string cmake;    ///< every CMake file
    std::string sources;  ///< every .cpp and .h
    std::string
        texts;  ///< those and the scripts: where programs and files are named that are used at run time
};

[[nodiscard]] std::set<std::string> listed_packages(const std::string& lists);
/// One sentence for each difference between the lists, README, CMake and the sources.
[[nodiscard]] std::vector<std::string> disagreements(const PackageUse& use);

/// Package -> packages it depends on; a virtual package -> those that provide it.
using DebianPackages = std::map<std::string, std::set<std::string>>;
[[nodiscard]] DebianPackages installed_packages();
[[nodiscard]] std::set<std::string> with_dependencies(const std::set<std::string>& names,
                                                      const DebianPackages& system);
/// Folders of the CMake packages that were found, from CMakeCache.txt.
[[nodiscard]] std::vector<std::filesystem::path> package_folders(const std::string& cmake_cache);
/// The files that the CMake package in `folder` requires to exist.
[[nodiscard]] std::vector<std::string> checked_files(const std::filesystem::path& folder);
/// File -> the installed package that holds it; without those that none holds.
[[nodiscard]] std::map<std::string, std::string> owners_of(const std::vector<std::string>& files);
[[nodiscard]] std::vector<std::string> unlisted_owners(const std::map<std::string, std::string>& owners,
                                                       const std::set<std::string>& listed);

}  // namespace dermis
