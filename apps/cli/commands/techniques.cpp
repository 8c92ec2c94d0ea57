// dermis techniques: what can be rendered, where it comes from, what can be set.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/technique/technique.h"

namespace dermis::cli {
namespace {

std::string range_text(const Parameter& parameter) {
    if (!parameter.choices.empty()) return join(parameter.choices, "|");
    return to_text(parameter.min) + " to " + to_text(parameter.max) +
           (parameter.unit.empty() ? "" : " " + parameter.unit);
}

nlohmann::json to_json(const Technique& technique) {
    const ParameterValues defaults(technique.parameters);
    nlohmann::json parameters = nlohmann::json::array();
    for (const Parameter& parameter : technique.parameters.parameters)
        parameters.push_back({{"name", parameter.name},
                              {"unit", parameter.unit},
                              {"min", parameter.min},
                              {"max", parameter.max},
                              {"choices", parameter.choices},
                              {"default", defaults.text(parameter)},
                              {"doc", parameter.doc}});
    return {{"id", technique.id},
            {"summary", technique.summary},
            {"source", technique.source},
            {"views", technique.views},
            {"parameters", parameters}};
}

Result<int> list_techniques(const std::string& only, bool json) {
    nlohmann::json all = nlohmann::json::array();
    if (!only.empty())
        if (const auto known = find_technique(only); !known) return known.error();
    for (const Technique& technique : all_techniques()) {
        if (!only.empty() && technique.id != only) continue;
        if (json) {
            all.push_back(to_json(technique));
            continue;
        }
        std::printf("%s  %s\n    source: %s\n", technique.id.c_str(), technique.summary.c_str(),
                    technique.source.c_str());
        const ParameterValues defaults(technique.parameters);
        for (const Parameter& parameter : technique.parameters.parameters)
            std::printf("    %-22s %-32s default %-14s %s\n", parameter.name.c_str(),
                        range_text(parameter).c_str(), defaults.text(parameter).c_str(),
                        parameter.doc.c_str());
    }
    if (json) std::printf("%s\n", all.dump(2).c_str());
    return 0;
}

}  // namespace

void add_techniques_command(CommandLine& line) {
    struct Options {
        std::string only;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    Command* command = line.add("techniques", "Techniques with their parameters", "dermis techniques wrap");
    command->add_option("id", options->only, "only this one");
    command->add_flag("--json", options->json, "as JSON");
    line.when_chosen(command, [options] { return list_techniques(options->only, options->json); });
}

}  // namespace dermis::cli
