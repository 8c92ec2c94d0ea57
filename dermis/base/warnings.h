#pragma once
// Warnings as a user reads them.

#include <cstddef>
#include <string>
#include <vector>

namespace dermis::inline base {

/// Each warning once, at the place of the first, with " (3 times)" where it came more often; one line for a
/// terminal each; at most 50, then how many more there are.
void tidy_warnings(std::vector<std::string>& warnings);

}  // namespace dermis::inline base
