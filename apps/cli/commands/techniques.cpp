// dermis techniques: the techniques with their sources and parameters.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "catalog/catalog.h"
#include "command.h"
#include "parameter_list.h"

namespace dermis::cli {
namespace {

nlohmann::json to_json(const Technique& technique) {
    return {{"id", technique.id},
            {"summary", technique.summary},
            {"source", technique.source},
            {"views", technique.views},
            {"parameters", parameters_json(technique.parameters)}};
}

Result<int> list_techniques(const std::string& only, bool json) {
    nlohmann::json all = nlohmann::json::array();
    if (!only.empty()) DERMIS_TRY(find_technique(built_in_catalog().techniques, only));
    for (const Technique& technique : built_in_catalog().techniques) {
        if (!only.empty() && technique.id != only) continue;
        if (json) {
            all.push_back(to_json(technique));
            continue;
        }
        std::printf("%s  %s\n    source: %s\n", technique.id.c_str(), technique.summary.c_str(),
                    technique.source.c_str());
        print_parameters(technique.parameters);
    }
    if (json) std::printf("%s\n", all.dump(2).c_str());
    return 0;
}

}  // namespace

void add_techniques_command(CommandLine& line) {
    struct TechniquesOptions {
        std::string only;
        bool json = false;
    };
    const auto options = std::make_shared<TechniquesOptions>();
    Command* command =
        line.add("techniques", "Lists the techniques with their parameters", "dermis techniques wrap");
    command->add_option("ID", options->only, "list this technique only");
    command->add_flag("--json", options->json, "as JSON");
    line.when_chosen(command, writes_nothing,
                     [options] { return list_techniques(options->only, options->json); });
}

}  // namespace dermis::cli
