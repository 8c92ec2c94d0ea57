#include "dermis/technique/technique_list.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::inline technique {
namespace {

// Splits at commas outside brackets. The bracket that does not fit is an error.
Result<std::vector<std::string_view>> split_entries(std::string_view text) {
    std::vector<std::string_view> entries;
    size_t start = 0;
    bool inside = false;
    const Error unbalanced = {"'" + std::string(text) +
                              "': brackets do not match; write technique[name=value,name=value],technique"};
    for (size_t i = 0; i < text.size(); ++i) {
        if ((text[i] == '[' && inside) || (text[i] == ']' && !inside)) return unbalanced;
        if (text[i] == '[' || text[i] == ']') inside = !inside;
        if (text[i] != ',' || inside) continue;
        entries.push_back(trim(text.substr(start, i - start)));
        start = i + 1;
    }
    if (inside) return unbalanced;
    entries.push_back(trim(text.substr(start)));
    return entries;
}

// "a=1,b=2,3,4" is {"a=1", "b=2,3,4"}: a part without '=' belongs to the value before it.
std::vector<std::string> split_settings(std::string_view text) {
    std::vector<std::string> settings;
    for (const std::string_view part : split(text, ',')) {
        if (part.find('=') == std::string_view::npos && !settings.empty())
            settings.back() += "," + std::string(trim(part));
        else
            settings.emplace_back(trim(part));
    }
    return settings;
}

Result<Contestant> parse_entry(std::span<const Technique> techniques, std::string_view entry) {
    if (entry.empty()) return Error{"an entry is empty; write technique,technique[name=value]"};
    const size_t bracket = entry.find('[');
    if (bracket != std::string_view::npos && entry.back() != ']')
        return Error{"'" + std::string(entry) + "': nothing may follow the bracket"};
    DERMIS_TRY_ASSIGN(const Technique* technique, find_technique(techniques, trim(entry.substr(0, bracket))));
    Contestant contestant{.technique = technique, .values = ParameterValues(technique->parameters)};
    if (bracket == std::string_view::npos) return contestant;
    const auto settings = split_settings(entry.substr(bracket + 1, entry.size() - bracket - 2));
    if (Result<void> set = contestant.values.set_all(settings); !set)
        return set.error().within(technique->id);
    DERMIS_TRY(check_settings(*technique, contestant.values));
    contestant.settings = join(settings, ",");
    return contestant;
}

}  // namespace

std::string Contestant::name() const {
    return settings.empty() ? technique->id : technique->id + "[" + settings + "]";
}

Result<Contestant> parse_technique(std::span<const Technique> techniques, std::string_view text) {
    DERMIS_TRY_ASSIGN(const std::vector<std::string_view> entries, split_entries(text));
    if (entries.size() != 1) return Error{"'" + std::string(text) + "': name one technique"};
    return parse_entry(techniques, entries[0]);
}

Result<std::vector<Contestant>> parse_technique_list(std::span<const Technique> techniques,
                                                     std::string_view text) {
    DERMIS_TRY_ASSIGN(const std::vector<std::string_view> entries, split_entries(text));
    std::vector<Contestant> list;
    for (const std::string_view entry : entries) {
        DERMIS_TRY_ASSIGN(Contestant contestant, parse_entry(techniques, entry));
        for (const Contestant& other : list)
            if (other.technique == contestant.technique && other.values == contestant.values)
                return Error{"'" + contestant.name() + "' and '" + other.name() +
                             "' have the same settings; remove one"};
        list.push_back(std::move(contestant));
    }
    return list;
}

std::vector<Contestant> default_contestants(std::span<const Technique> techniques) {
    std::vector<Contestant> list;
    for (const Technique& technique : techniques)
        list.push_back({.technique = &technique, .values = ParameterValues(technique.parameters)});
    std::stable_partition(list.begin(), list.end(),
                          [](const Contestant& c) { return c.technique->is_baseline; });
    return list;
}

}  // namespace dermis::inline technique
