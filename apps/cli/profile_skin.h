#pragma once
// dermis profile skin.

#include "command.h"

namespace dermis::cli {

void add_profile_skin(CommandLine& line, Command* profile);

}  // namespace dermis::cli
