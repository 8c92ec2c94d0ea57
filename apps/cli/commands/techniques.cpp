// dermis techniques: a line for each technique, or one technique with its source, presets and parameters.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/text.h"
#include "parameter_list.h"

namespace dermis::cli {
namespace {

nlohmann::json to_json(const Technique& technique) {
    return {{"id", technique.id},
            {"summary", technique.summary},
            {"source", technique.source},
            {"views", technique.views},
            {"presets", presets_json(technique.parameters)},
            {"parameters", parameters_json(technique.parameters)}};
}

std::string to_text(const Technique& technique) {
    std::string text =
        wrapped(technique.id + ": " + technique.summary, 0) + wrapped("source: " + technique.source, 2);
    if (!technique.views.empty()) text += wrapped("own views: " + join(technique.views, ", "), 2);
    return text + "\nParameters: name = default (range)\n" + parameters_text(technique.parameters);
}

Result<int> list_techniques(const std::string& only, bool json) {
    const std::span<const Technique> all = built_in_catalog().techniques;
    const Technique* one = nullptr;
    if (!only.empty()) {
        DERMIS_TRY_ASSIGN(one, find_technique(all, only));
    }
    if (json) {
        nlohmann::json list = nlohmann::json::array();
        for (const Technique& technique : all)
            if (!one || one == &technique) list.push_back(to_json(technique));
        std::printf("%s\n", list.dump(2).c_str());
    } else if (one) {
        std::fputs(to_text(*one).c_str(), stdout);
    } else {
        for (const Technique& technique : all)
            std::printf("%-24s %s\n", technique.id.c_str(), technique.summary.c_str());
    }
    return 0;
}

}  // namespace

void add_techniques_command(CommandLine& line) {
    struct TechniquesOptions {
        std::string only;
        bool json = false;
    };
    const auto options = std::make_shared<TechniquesOptions>();
    Command* command = line.add("techniques", "Lists the techniques, or one with its parameters and presets",
                                "dermis techniques wrap");
    command->add_option("ID", options->only, "show this technique with parameters and presets");
    command->add_flag("--json", options->json, "as JSON");
    line.when_chosen(command, writes_nothing,
                     [options] { return list_techniques(options->only, options->json); });
}

}  // namespace dermis::cli
