#pragma once
// Other programs, run and waited for.

#include <filesystem>
#include <string>
#include <vector>

namespace dermis::inline base {

/// Runs arguments[0] (looked for in PATH) with both its outputs in the file `log`, and waits. Its exit
/// status; 127 or -1 when it cannot be started or was killed. No shell: arguments are taken as they are.
[[nodiscard]] int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace dermis::inline base
