#pragma once
// Whether the files that a command is to write can be written and destroy nothing.

#include <filesystem>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline base {

struct FileUse {
    std::vector<std::filesystem::path> outputs;
    /// Files that must stay as they are. What does not exist is left out: it may be the name of a built-in.
    std::vector<std::filesystem::path> inputs;
};

/// Errors: a path that is written twice, an output that is one of the inputs, an output that is a directory
/// or cannot be written. Paths are the same if they lead to the same file: by a link, by "./", by another
/// name of it. Writes and removes one trial file in every folder; leaves nothing.
[[nodiscard]] Result<void> check_outputs(const FileUse& files);

}  // namespace dermis::inline base
