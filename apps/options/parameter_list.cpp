#include "parameter_list.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "dermis/base/text.h"

namespace dermis::cli {
namespace {

// "name=value" for each parameter that differs from the defaults.
std::string differences(const ParameterTable& table, const ParameterPreset& preset) {
    const ParameterValues defaults(table);
    ParameterValues values(table);
    if (!values.set("preset", preset.name)) return "";
    std::vector<std::string> settings;
    for (const Parameter& parameter : table.parameters)
        if (values.get(parameter) != defaults.get(parameter))
            settings.push_back(parameter.name + "=" + values.text(parameter));
    return join(settings, ", ");
}

}  // namespace

std::string range_text(const Parameter& parameter) {
    if (!parameter.choices.empty()) return join(parameter.choices, ", ");
    return to_text(parameter.min) + " to " + to_text(parameter.max) +
           (parameter.unit.empty() ? "" : " " + parameter.unit);
}

std::string wrapped(std::string_view text, size_t indent) {
    constexpr size_t kColumns = 80;
    std::string lines, line;
    for (const std::string_view word : split(text, ' ')) {
        if (!line.empty() && line.size() + 1 + word.size() > kColumns) lines += line + '\n', line.clear();
        line += line.empty() ? std::string(indent, ' ') : " ";
        line += word;
    }
    return lines + line + '\n';
}

std::string parameters_text(const ParameterTable& table) {
    const ParameterValues defaults(table);
    std::string text;
    for (const Parameter& parameter : table.parameters)
        text +=
            wrapped(parameter.name + " = " + defaults.text(parameter) + " (" + range_text(parameter) + ")",
                    2) +
            wrapped(parameter.doc, 6);
    if (table.presets.size() > 1)
        text += "\nPresets: preset=NAME sets all parameters; later settings override it\n";
    for (const ParameterPreset& preset : table.presets) {
        if (table.presets.size() == 1) break;
        const std::string settings = differences(table, preset);
        text += wrapped(preset.name + ": " + preset.doc, 2) + (settings.empty() ? "" : wrapped(settings, 6));
    }
    return text;
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

nlohmann::json presets_json(const ParameterTable& table) {
    nlohmann::json presets = nlohmann::json::array();
    for (const ParameterPreset& preset : table.presets)
        presets.push_back(
            {{"name", preset.name}, {"doc", preset.doc}, {"differs_in", differences(table, preset)}});
    return presets;
}

}  // namespace dermis::cli
