#include "parameter_list.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "dermis/base/text.h"

namespace dermis::cli {

std::string range_text(const Parameter& parameter) {
    if (!parameter.choices.empty()) return join(parameter.choices, "|");
    return to_text(parameter.min) + " to " + to_text(parameter.max) +
           (parameter.unit.empty() ? "" : " " + parameter.unit);
}

void print_parameters(const ParameterTable& table) {
    const ParameterValues defaults(table);
    for (const Parameter& parameter : table.parameters)
        std::printf("    %-22s %-32s default %-14s %s\n", parameter.name.c_str(),
                    range_text(parameter).c_str(), defaults.text(parameter).c_str(), parameter.doc.c_str());
}

nlohmann::json parameters_json(const ParameterTable& table) {
    const ParameterValues defaults(table);
    nlohmann::json parameters = nlohmann::json::array();
    for (const Parameter& parameter : table.parameters)
        parameters.push_back({{"name", parameter.name},
                              {"unit", parameter.unit},
                              {"min", parameter.min},
                              {"max", parameter.max},
                              {"choices", parameter.choices},
                              {"default", defaults.text(parameter)},
                              {"doc", parameter.doc}});
    return parameters;
}

}  // namespace dermis::cli
