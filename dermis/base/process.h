#pragma once
// Runs other programs.

#include <filesystem>
#include <string>
#include <vector>

namespace dermis::inline base {

/// Runs arguments[0] (searched in PATH) without a shell, both outputs in the file `log`, and waits. Returns
/// its exit status; 127 or -1 if it cannot be started or was killed.
[[nodiscard]] int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace dermis::inline base
