#pragma once
// dermis profile fit-walk.

#include <optional>
#include <string>

#include "command.h"

namespace dermis::cli {

struct FitWalkOptions {
    std::string name, output;
    int walks = 300'000;
    std::optional<double> g, eta;  ///< replace those of the profile's volume
    bool albedos = false;          ///< the table over albedo instead of one profile
};

[[nodiscard]] Result<FileUse> fit_walk_file(const FitWalkOptions& options);
[[nodiscard]] Result<int> fit_walk(const FitWalkOptions& options);

}  // namespace dermis::cli
