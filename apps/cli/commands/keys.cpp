// dermis keys: every key of the scene file as tables in Markdown.

#include <cstdio>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/scene/scene_description.h"

namespace dermis::cli {

void add_keys_command(CommandLine& line) {
    Command* command = line.add("keys", "Prints every key of the scene file with its unit, range and default",
                                "dermis keys > keys.md");
    line.when_chosen(command, writes_nothing, []() -> Result<int> {
        const std::string manual = scene_file_manual(built_in_catalog().subjects);
        std::fwrite(manual.data(), 1, manual.size(), stdout);
        return 0;
    });
}

}  // namespace dermis::cli
