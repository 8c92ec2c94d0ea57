#pragma once
// The pages of the documentation as text: for the tests that compare them with the program.

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "test_paths.h"

namespace dermis::docs {

namespace fs = std::filesystem;

inline const fs::path kRoot = DERMIS_SOURCE_DIR;

inline std::vector<std::string> matches(const std::string& text, const std::regex& pattern,
                                        size_t group = 0) {
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        found.push_back((*it)[group]);
    return found;
}

inline std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<fs::path> pages() {
    std::vector<fs::path> found;
    for (const char* tree : {"docs", "techniques", "subjects", "tests", "scenes"})
        if (fs::exists(kRoot / tree))
            for (const auto& entry : fs::recursive_directory_iterator(kRoot / tree))
                if (entry.path().extension() == ".md") found.push_back(entry.path());
    for (const auto& entry : fs::directory_iterator(kRoot))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    return found;
}

// Indented blocks and fenced blocks line by line (continued lines joined), then spans between backticks.
inline std::vector<std::string> code_of(const std::string& page) {
    std::vector<std::string> code;
    std::string prose, joined;
    bool fenced = false;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            fenced = !fenced;
        } else if (fenced || line.starts_with("    ")) {
            line = line.substr(0, line.find(" #"));
            joined += line;
            if (joined.ends_with('\\')) {
                joined.pop_back();
                continue;
            }
            code.push_back(std::exchange(joined, {}));
        } else {
            prose += line + " ";
        }
    }
    static const std::regex span("`([^`]+)`");
    for (const std::string& text : matches(prose, span, 1)) code.push_back(text);
    return code;
}

}  // namespace dermis::docs
