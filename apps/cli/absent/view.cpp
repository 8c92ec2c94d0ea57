// dermis view, where it was built without a window library: says what is missing.

#include "command.h"

namespace dermis::cli {

void add_view_command(CommandLine& line) {
    Command* command = line.add("view", "Shows a scene in a window (not in this build)", "dermis view bust");
    command->allow_extras();
    line.when_chosen(command, writes_nothing, []() -> Result<int> {
        return Error{"built without the viewer: install " DERMIS_VIEW_MISSING
                     " (Debian: apt-get install), configure and build again"};
    });
}

}  // namespace dermis::cli
