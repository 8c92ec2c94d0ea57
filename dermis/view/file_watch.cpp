#include "dermis/view/file_watch.h"

namespace dermis::view {
namespace fs = std::filesystem;

FileWatch::Stamps FileWatch::look() const {
    Stamps stamps;
    std::error_code ec;
    const auto add = [&](const fs::path& path) {
        const Stamp stamp = {fs::last_write_time(path, ec), fs::file_size(path, ec)};
        if (!ec) stamps[path] = stamp;
    };
    for (const fs::path& path : paths_) {
        if (!fs::is_directory(path, ec)) {
            add(path);
            continue;
        }
        for (fs::recursive_directory_iterator entry(path, ec), end; !ec && entry != end; entry.increment(ec))
            if (entry->is_regular_file(ec)) add(entry->path());
    }
    return stamps;
}

void FileWatch::watch(const std::vector<fs::path>& paths) {
    paths_ = paths;
    Stamps now = look();
    for (auto& [path, stamp] : now)
        if (const auto known = stamps_.find(path); known != stamps_.end()) stamp = known->second;
    stamps_ = std::move(now);
}

void FileWatch::add(const std::vector<fs::path>& paths) {
    std::vector<fs::path> all = paths_;
    all.insert(all.end(), paths.begin(), paths.end());
    watch(all);
}

std::vector<fs::path> FileWatch::changed() {
    Stamps now = look();
    std::vector<fs::path> paths;
    for (const auto& [path, stamp] : now) {
        const auto before = stamps_.find(path);
        if (before == stamps_.end() || !(before->second == stamp)) paths.push_back(path);
    }
    for (const auto& [path, stamp] : stamps_)
        if (!now.contains(path)) paths.push_back(path);
    stamps_ = std::move(now);
    return paths;
}

}  // namespace dermis::view
