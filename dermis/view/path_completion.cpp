#include "dermis/view/path_completion.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "dermis/base/text.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

// As Opener::open() and load_scene() take them.
constexpr std::string_view kOpened[] = {".toml", ".glb", ".gltf", ".obj", ".hdr",
                                        ".exr",  ".png", ".jpg",  ".jpeg"};

}  // namespace

std::vector<std::string> complete_path(std::string_view text) {
    const char* home = std::getenv("HOME");
    std::string typed(text);
    if (typed.starts_with("~/") && home) typed.replace(0, 1, home);
    const size_t slash = typed.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : typed.substr(0, slash + 1);
    const std::string start = typed.substr(folder.size());
    std::vector<std::string> folders, files;
    std::error_code ec;
    fs::directory_iterator entry(folder.empty() ? "." : folder, ec);
    for (; !ec && entry != fs::directory_iterator(); entry.increment(ec)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(start) || (start.empty() && name.starts_with('.'))) continue;
        std::error_code unknown;
        if (entry->is_directory(unknown))
            folders.push_back(folder + name + "/");
        else if (std::ranges::count(kOpened, to_lower(entry->path().extension().string())) > 0)
            files.push_back(folder + name);
    }
    std::ranges::sort(folders);
    std::ranges::sort(files);
    folders.insert(folders.end(), files.begin(), files.end());
    if (folders.size() > kMostCompletions) folders.resize(kMostCompletions);
    return folders;
}

std::string common_start(const std::vector<std::string>& texts) {
    if (texts.empty()) return "";
    std::string start = texts.front();
    for (const std::string& text : texts) {
        const auto differs = std::ranges::mismatch(start, text).in1;
        start.erase(differs, start.end());
    }
    return start;
}

}  // namespace dermis::view
