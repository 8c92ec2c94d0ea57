#pragma once
// Warnings as a user reads them.

#include <cstddef>
#include <string>
#include <vector>

namespace dermis::inline base {

/// Each warning once, in order of first appearance, with " (3 times)" if repeated, as one line for a
/// terminal; at most 50, then the number of the others.
void tidy_warnings(std::vector<std::string>& warnings);

}  // namespace dermis::inline base
