#include "dermis/base/parameter.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::inline base {
namespace {

const std::string kPreset = "preset";

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

std::vector<std::string> ParameterTable::names() const {
    std::vector<std::string> names = {kPreset};
    for (const Parameter& parameter : parameters) names.push_back(parameter.name);
    return names;
}

Result<void> ParameterValues::set(std::string_view name, std::string_view text) {
    if (name == kPreset) return set_preset(text);
    const Parameter* parameter = table_->find(name);
    if (!parameter) return Error{unknown_name("parameter", name, table_->names())};
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

Result<void> ParameterValues::set_preset(std::string_view name) {
    std::vector<std::string> names;
    for (const ParameterPreset& preset : table_->presets) {
        if (preset.name == name) return bytes_ = preset.values, Result<void>();
        names.push_back(preset.name);
    }
    return Error{unknown_name(kPreset, name, names)};
}

Result<void> ParameterValues::set_all(std::span<const std::string> settings) {
    for (const std::string& setting : settings) {
        const size_t equals = setting.find('=');
        if (equals == std::string::npos) return Error{"'" + setting + "': write name=value"};
        DERMIS_TRY(set(trim(std::string_view(setting).substr(0, equals)),
                       trim(std::string_view(setting).substr(equals + 1))));
    }
    return {};
}

Result<void> ParameterValues::set_all(const std::map<std::string, std::string>& settings) {
    if (const auto preset = settings.find(kPreset); preset != settings.end())
        DERMIS_TRY(set_preset(preset->second));
    for (const auto& [name, text] : settings)
        if (name != kPreset) DERMIS_TRY(set(name, text));
    return {};
}

const ParameterPreset* ParameterValues::preset() const {
    const auto same = [&](const ParameterPreset& preset) {
        ParameterValues values(*table_);
        values.bytes_ = preset.values;
        return values == *this;
    };
    const auto found = std::ranges::find_if(table_->presets, same);
    return found == table_->presets.end() ? nullptr : &*found;
}

bool operator==(const ParameterValues& a, const ParameterValues& b) {
    return a.table_ == b.table_ && std::ranges::all_of(a.table_->parameters, [&](const Parameter& parameter) {
               return a.get(parameter) == b.get(parameter);
           });
}

Result<void> ParameterValues::check() const {
    for (const Parameter& parameter : table_->parameters) {
        const std::array<double, 3> value = get(parameter);
        // A float that was set to the end of its range holds the nearest float.
        const auto end = [&](double number) {
            return parameter.double_precision ? number : double(float(number));
        };
        for (size_t i = 0; i < parameter.component_count(); ++i)
            if (!(value[i] >= end(parameter.min) && value[i] <= end(parameter.max)))
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
