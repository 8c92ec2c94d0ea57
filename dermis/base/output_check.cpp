#include "dermis/base/output_check.h"

#include <algorithm>
#include <set>

#include "dermis/base/file.h"

namespace dermis::inline base {
namespace fs = std::filesystem;
namespace {

// A file that does not exist has the real path of its folder and its own name.
fs::path real_path(const fs::path& path) {
    std::error_code ec;
    const fs::path real = fs::weakly_canonical(fs::absolute(path, ec), ec);
    return ec ? path.lexically_normal() : real;
}

// Only a regular file loses its content when it is written again; /dev/null takes any number of outputs.
bool can_be_lost(const fs::path& path) {
    std::error_code ec;
    return !fs::exists(path, ec) || fs::is_regular_file(path, ec);
}

// weakly_canonical() does not see that two hard links are one file.
bool has_hard_links(const fs::path& path) {
    std::error_code ec;
    return fs::is_regular_file(path, ec) && fs::hard_link_count(path, ec) > 1;
}

// Files that were met, by all their names.
class KnownFiles {
  public:
    void add(const fs::path& path) {
        real_.insert(real_path(path));
        if (has_hard_links(path)) linked_.push_back(path);
    }
    [[nodiscard]] bool has(const fs::path& path) const {
        std::error_code ec;
        return real_.contains(real_path(path)) ||
               (has_hard_links(path) && std::ranges::any_of(linked_, [&](const fs::path& other) {
                    return fs::equivalent(path, other, ec);
                }));
    }

  private:
    std::set<fs::path> real_;
    std::vector<fs::path> linked_;
};

}  // namespace

Result<void> check_outputs(const FileUse& files) {
    std::error_code ec;
    KnownFiles read, written;
    for (const fs::path& input : files.inputs)
        if (fs::is_regular_file(input, ec)) read.add(input);
    std::set<fs::path> tried;
    for (const fs::path& output : files.outputs) {
        if (can_be_lost(output)) {
            if (read.has(output))
                return Error{output.string() +
                             ": is an input of this command and would be replaced; name another output"};
            if (written.has(output))
                return Error{output.string() + ": two outputs would be written there; name another file"};
            written.add(output);
        }
        // The folder is tried once: a turn of the camera has thousands of files.
        const bool is_new_folder = tried.insert(output.parent_path()).second;
        if (!is_new_folder && !fs::is_directory(output, ec)) continue;
        DERMIS_TRY(try_output(output));
    }
    return {};
}

}  // namespace dermis::inline base
