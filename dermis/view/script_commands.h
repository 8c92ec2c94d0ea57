#pragma once
// Does what the commands of a script ask for.

#include "dermis/view/parts.h"
#include "dermis/view/script.h"

namespace dermis::view {

/// Input commands come over the next frames, everything else is done now.
[[nodiscard]] Result<void> run_command(Parts& parts, const ScriptCommand& command);

}  // namespace dermis::view
