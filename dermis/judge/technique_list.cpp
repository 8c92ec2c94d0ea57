#include "dermis/judge/technique_list.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::inline judge {
namespace {

// Splits at commas outside brackets. The bracket that does not fit is an error.
Result<std::vector<std::string_view>> split_entries(std::string_view text) {
    std::vector<std::string_view> entries;
    size_t start = 0;
    bool inside = false;
    const auto unbalanced = [&] {
        return Error{"--techniques '" + std::string(text) +
                     "': brackets do not match; write technique[name=value,name=value],technique"};
    };
    for (size_t i = 0; i < text.size(); ++i) {
        if ((text[i] == '[' && inside) || (text[i] == ']' && !inside)) return unbalanced();
        if (text[i] == '[' || text[i] == ']') inside = !inside;
        if (text[i] != ',' || inside) continue;
        entries.push_back(trim(text.substr(start, i - start)));
        start = i + 1;
    }
    if (inside) return unbalanced();
    entries.push_back(trim(text.substr(start)));
    return entries;
}

// "a=1,b=2,3,4" is {"a=1", "b=2,3,4"}: what has no '=' goes on with the value before it.
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
    if (entry.empty()) return Error{"--techniques: an entry is empty; write technique,technique[name=value]"};
    const size_t bracket = entry.find('[');
    if (bracket != std::string_view::npos && entry.back() != ']')
        return Error{"--techniques '" + std::string(entry) + "': nothing may follow the bracket"};
    const Result<const Technique*> technique = find_technique(techniques, trim(entry.substr(0, bracket)));
    if (!technique) return technique.error();
    Contestant contestant{.technique = *technique, .values = ParameterValues((*technique)->parameters)};
    if (bracket == std::string_view::npos) return contestant;
    std::vector<std::string> settings = split_settings(entry.substr(bracket + 1, entry.size() - bracket - 2));
    for (const std::string& setting : settings) {
        const size_t equals = setting.find('=');
        if (equals == std::string::npos)
            return Error{"--techniques '" + std::string(entry) + "': write name=value between the brackets"};
        if (Result<void> set = contestant.values.set(trim(std::string_view(setting).substr(0, equals)),
                                                     trim(std::string_view(setting).substr(equals + 1)));
            !set)
            return Error{(*technique)->id + ": " + set.error().message};
    }
    contestant.settings = join(settings, ",");
    return contestant;
}

bool same_values(const Contestant& a, const Contestant& b) {
    if (a.technique != b.technique) return false;
    return std::ranges::all_of(a.technique->parameters.parameters, [&](const Parameter& parameter) {
        return a.values.text(parameter) == b.values.text(parameter);
    });
}

}  // namespace

std::string Contestant::name() const {
    return settings.empty() ? technique->id : technique->id + "[" + settings + "]";
}

Result<std::vector<Contestant>> parse_technique_list(std::span<const Technique> techniques,
                                                     std::string_view text) {
    DERMIS_TRY_ASSIGN(const std::vector<std::string_view> entries, split_entries(text));
    std::vector<Contestant> list;
    for (const std::string_view entry : entries) {
        DERMIS_TRY_ASSIGN(Contestant contestant, parse_entry(techniques, entry));
        for (const Contestant& other : list)
            if (same_values(other, contestant))
                return Error{"--techniques: '" + contestant.name() + "' and '" + other.name() +
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

}  // namespace dermis::inline judge
