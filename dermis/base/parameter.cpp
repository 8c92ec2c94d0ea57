#include "dermis/base/parameter.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::inline base {
namespace {

Error out_of_range(const Parameter& parameter, std::string_view text) {
    return Error{"parameter '" + parameter.name + "': '" + std::string(text) + "' is not in its range, " +
                 to_text(parameter.min) + " to " + to_text(parameter.max) +
                 (parameter.unit.empty() ? "" : " " + parameter.unit)};
}

Result<double> parse_component(const Parameter& parameter, std::string_view text) {
    const auto value = parse_number(text);
    if (!value) {
        return Error{"parameter '" + parameter.name + "': '" + std::string(text) + "' is not a number (" +
                     to_text(parameter.min) + " to " + to_text(parameter.max) +
                     (parameter.unit.empty() ? "" : " " + parameter.unit) + ")"};
    }
    const bool whole = parameter.kind != ParameterKind::integer || *value == std::floor(*value);
    if (!(*value >= parameter.min && *value <= parameter.max)) return out_of_range(parameter, text);
    if (!whole)
        return Error{"parameter '" + parameter.name + "': '" + std::string(text) + "' is not a whole number"};
    return *value;
}

Result<double> parse_choice(const Parameter& parameter, std::string_view text) {
    std::string name = to_lower(trim(text));
    if (parameter.kind == ParameterKind::toggle) {
        if (name == "true" || name == "1" || name == "yes") name = "on";
        if (name == "false" || name == "0" || name == "no") name = "off";
    }
    const auto found = std::ranges::find(parameter.choices, name);
    if (found == parameter.choices.end())
        return Error{unknown_name("value for '" + parameter.name + "':", text, parameter.choices)};
    return double(found - parameter.choices.begin());
}

// "1,0.5,0.2", "1 0.5 0.2", or one number for a grey.
Result<std::array<double, 3>> parse_color(const Parameter& parameter, std::string_view text) {
    std::string spaced(text);
    std::ranges::replace(spaced, ' ', ',');
    std::vector<double> components;
    for (const std::string_view part : split(spaced, ',')) {
        if (trim(part).empty()) continue;
        DERMIS_TRY_ASSIGN(const double component, parse_component(parameter, part));
        components.push_back(component);
    }
    if (components.size() == 1) components.resize(3, components[0]);
    if (components.size() != 3)
        return Error{"parameter '" + parameter.name + "': '" + std::string(text) +
                     "' is not one number or three"};
    return std::array{components[0], components[1], components[2]};
}

}  // namespace

const Parameter* ParameterTable::find(std::string_view name) const {
    const auto found = std::ranges::find(parameters, name, &Parameter::name);
    return found == parameters.end() ? nullptr : &*found;
}

Result<void> ParameterValues::set(std::string_view name, std::string_view text) {
    const Parameter* parameter = table_->find(name);
    if (!parameter) {
        std::vector<std::string> names;
        for (const Parameter& p : table_->parameters) names.push_back(p.name);
        return Error{unknown_name("parameter", name, names)};
    }
    if (parameter->kind == ParameterKind::color) {
        DERMIS_TRY_ASSIGN(const auto color, parse_color(*parameter, text));
        put(*parameter, color);
        return {};
    }
    const bool named = parameter->kind == ParameterKind::toggle || parameter->kind == ParameterKind::choice;
    DERMIS_TRY_ASSIGN(const double value,
                      named ? parse_choice(*parameter, text) : parse_component(*parameter, text));
    put(*parameter, {value});
    return {};
}

Result<void> ParameterValues::check() const {
    for (const Parameter& parameter : table_->parameters) {
        const std::array<double, 3> value = get(parameter);
        for (size_t i = 0; i < parameter.component_count(); ++i)
            if (!(value[i] >= parameter.min && value[i] <= parameter.max))
                return out_of_range(parameter, to_text(value[i]));
    }
    return {};
}

std::array<double, 3> ParameterValues::get(const Parameter& parameter) const {
    const std::byte* at = bytes_.data() + parameter.offset;
    const auto load = [at]<class T>(T value) {
        std::memcpy(&value, at, sizeof value);
        return value;
    };
    switch (parameter.kind) {
        case ParameterKind::number:
            return {parameter.double_precision ? load(double{}) : double(load(float{}))};
        case ParameterKind::integer:
        case ParameterKind::choice:
            return {double(load(int32_t{}))};
        case ParameterKind::toggle:
            return {load(bool{}) ? 1.0 : 0.0};
        case ParameterKind::color: {
            const Vec3 color = load(Vec3{});
            return {color.x, color.y, color.z};
        }
    }
    return {};
}

void ParameterValues::put(const Parameter& parameter, std::array<double, 3> value) {
    std::byte* at = bytes_.data() + parameter.offset;
    const auto store = [at](auto typed) { std::memcpy(at, &typed, sizeof typed); };
    switch (parameter.kind) {
        case ParameterKind::number:
            return parameter.double_precision ? store(value[0]) : store(float(value[0]));
        case ParameterKind::integer:
        case ParameterKind::choice:
            return store(int32_t(value[0]));
        case ParameterKind::toggle:
            return store(value[0] != 0);
        case ParameterKind::color:
            return store(Vec3{float(value[0]), float(value[1]), float(value[2])});
    }
}

std::string ParameterValues::text(const Parameter& parameter) const {
    const std::array<double, 3> value = get(parameter);
    switch (parameter.kind) {
        case ParameterKind::number:
            return parameter.double_precision ? to_text(value[0]) : to_text(float(value[0]));
        case ParameterKind::integer:
            return std::to_string(int64_t(value[0]));
        case ParameterKind::toggle:
        case ParameterKind::choice:
            return parameter.choices[size_t(value[0])];
        case ParameterKind::color:
            return to_text(float(value[0])) + "," + to_text(float(value[1])) + "," + to_text(float(value[2]));
    }
    return {};
}

}  // namespace dermis::inline base
