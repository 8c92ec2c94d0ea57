#pragma once
// Which files have changed since the last check, by time and size.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dermis::view {

class FileWatch {
  public:
    /// These files and the files below these directories, from now on. Files known before count as they
    /// were last looked at, so that no change falls between; new ones as they are now.
    void watch(const std::vector<std::filesystem::path>& paths);
    /// These too.
    void add(const std::vector<std::filesystem::path>& paths);
    /// Files that changed, appeared or vanished since the last call. A few microseconds a file.
    [[nodiscard]] std::vector<std::filesystem::path> changed();

  private:
    struct Stamp {
        std::filesystem::file_time_type time;
        uintmax_t size = 0;
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    using Stamps = std::map<std::filesystem::path, Stamp>;
    [[nodiscard]] Stamps look() const;

    std::vector<std::filesystem::path> paths_;
    Stamps stamps_;
};

}  // namespace dermis::view
