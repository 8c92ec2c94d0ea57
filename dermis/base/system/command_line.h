#pragma once
// Inside dermis/base only: a Windows program gets one line of text and splits it by itself.

#include <string>
#include <vector>

namespace dermis::inline base {

/// The line that CommandLineToArgvW() and the C library split into these arguments again.
[[nodiscard]] std::string command_line(const std::vector<std::string>& arguments);

}  // namespace dermis::inline base
