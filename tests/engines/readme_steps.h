#pragma once
// The lines of code in the six steps of a package's README.

#include <sstream>
#include <string>
#include <vector>

#include "dermis/base/file.h"
#include "test_paths.h"

namespace dermis {

inline std::string readme_of(const std::string& engine) {
    const auto text = read_text_file(DERMIS_SOURCE_DIR "/engines/" + engine + "/README.md");
    return text ? *text : "";
}

/// Code below a step is indented by seven spaces; deeper where it is a block.
inline std::vector<std::string> step_lines(const std::string& readme) {
    std::vector<std::string> found;
    std::istringstream lines(readme);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("       ")) found.push_back(line.substr(7));
    return found;
}

/// Those that contain these words; one empty line where none does.
inline std::vector<std::string> lines_with(const std::string& readme, const std::string& words) {
    std::vector<std::string> found;
    for (const std::string& line : step_lines(readme))
        if (line.find(words) != std::string::npos) found.push_back(line);
    return found.empty() ? std::vector<std::string>{""} : found;
}

/// All but the lines for a shell, each ended by a newline.
inline std::string script_of(const std::string& readme) {
    std::string script;
    for (const std::string& line : step_lines(readme))
        if (!line.starts_with("dermis ") && !line.starts_with("npm ")) script += line + "\n";
    return script;
}

}  // namespace dermis
