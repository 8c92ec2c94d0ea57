#pragma once
// The content hash of a job that draws.

#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::cli {

/// Of this program's file, the scenes with their meshes and maps, the files of scenes that move, and the
/// words of the command. Errors: a file that cannot be read.
[[nodiscard]] Result<std::string> hash_of_job(const std::vector<const Scene*>& scenes,
                                              const std::vector<std::string>& words);

}  // namespace dermis::cli
