#pragma once
// dermis profile skin.

#include <string>
#include <string_view>

#include "command.h"

namespace dermis::cli {

/// "--epidermis-mm" of "epidermis_mm".
[[nodiscard]] std::string skin_flag_of(std::string_view key);

void add_profile_skin(CommandLine& line, Command* profile);

}  // namespace dermis::cli
