#pragma once
// The error for a part that was switched off in the build (cmake/Parts.cmake).

#include <string>

#include "dermis/base/result.h"

namespace dermis::inline base {

/// "PNG is not built in; configure dermis with -DDERMIS_WITH_PNG=ON"
[[nodiscard]] inline Error not_built_in(const std::string& part, const std::string& option) {
    return {part + " is not built in; configure dermis with -D" + option + "=ON"};
}

}  // namespace dermis::inline base
