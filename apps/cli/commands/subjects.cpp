// dermis subjects: the names after "builtin:" in a scene, with their parameters.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "catalog/catalog.h"
#include "command.h"
#include "parameter_list.h"

namespace dermis::cli {
namespace {

Result<int> list_subjects(bool json) {
    nlohmann::json all = nlohmann::json::array();
    for (const Subject& subject : built_in_catalog().subjects) {
        all.push_back({{"name", subject.name},
                       {"summary", subject.summary},
                       {"parameters", parameters_json(subject.parameters)}});
        if (json) continue;
        std::printf("builtin:%s  %s\n", subject.name.c_str(), subject.summary.c_str());
        std::fputs(parameters_text(subject.parameters).c_str(), stdout);
    }
    if (json) std::printf("%s\n", all.dump(2).c_str());
    return 0;
}

}  // namespace

void add_subjects_command(CommandLine& line) {
    const auto json = std::make_shared<bool>(false);
    Command* command =
        line.add("subjects", "Lists the built-in subjects with their parameters", "dermis subjects");
    command->add_flag("--json", *json, "as JSON");
    line.when_chosen(command, writes_nothing, [json] { return list_subjects(*json); });
}

}  // namespace dermis::cli
