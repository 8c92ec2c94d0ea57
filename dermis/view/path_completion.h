#pragma once
// Paths that begin with what was typed.

#include <string>
#include <string_view>
#include <vector>

namespace dermis::view {

/// Largest number of paths that complete_path() returns.
inline constexpr size_t kMostCompletions = 200;

/// Folders, which end with '/', then the files that the window opens, each sorted; hidden ones only after a
/// typed
/// '.'. `text` may begin with "~/"; relative paths are of the current directory. Empty for a folder that
/// cannot be read.
[[nodiscard]] std::vector<std::string> complete_path(std::string_view text);

/// The longest common prefix; empty without texts.
[[nodiscard]] std::string common_start(const std::vector<std::string>& texts);

}  // namespace dermis::view
