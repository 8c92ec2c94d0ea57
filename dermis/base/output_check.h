#pragma once
// Checks that a command can write its files and overwrites none of its inputs.

#include <filesystem>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline base {

struct FileUse {
    std::vector<std::filesystem::path> outputs;
    /// Files that must not be overwritten. Missing ones are ignored: they may be names of built-in scenes.
    std::vector<std::filesystem::path> inputs;
};

/// Errors: a path that is written twice, an output that is one of the inputs, an output that is a directory
/// or cannot be written. Paths are equal if they lead to the same file (links, "./"). Writes and removes one
/// trial file in every folder.
[[nodiscard]] Result<void> check_outputs(const FileUse& files);

}  // namespace dermis::inline base
