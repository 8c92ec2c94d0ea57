#include "dermis/scene/key_value_text.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis {
namespace {

const TextKey* find_key(std::span<const TextKey> keys, std::string_view name) {
    const auto found = std::ranges::find(keys, name, &TextKey::name);
    return found == keys.end() ? nullptr : &*found;
}

std::string range_text(const TextKey& key) {
    const std::string count = key.components == 1 ? "a number" : "three numbers x,y,z, each";
    return count + " from " + to_text(key.min) + " to " + to_text(key.max) +
           (key.unit.empty() ? "" : " (" + std::string(key.unit) + ")");
}

Result<void> set_value(const TextKey& key, std::string_view text) {
    const auto wrong = [&] {
        return Error{std::string(key.name) + "=" + std::string(text) + ": " + std::string(key.name) + " is " +
                     range_text(key)};
    };
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != size_t(key.components)) return wrong();
    for (size_t i = 0; i < parts.size(); ++i) {
        const auto number = parse_number(parts[i]);
        if (!number || !(*number >= key.min && *number <= key.max)) return wrong();
        key.values[i] = float(*number);
    }
    if (key.given) *key.given = true;
    return {};
}

}  // namespace

Result<void> parse_key_values(std::string_view what, std::string_view text, std::span<const TextKey> keys) {
    std::vector<std::string> names;
    for (const TextKey& key : keys) names.emplace_back(key.name);
    for (const std::string_view word : split(text, ' ')) {
        const std::string_view pair = trim(word);
        if (pair.empty()) continue;
        const size_t equals = pair.find('=');
        if (equals == std::string_view::npos)
            return Error{std::string(what) + ": '" + std::string(pair) +
                         "' is no key=value; keys: " + join(names, ", ")};
        const std::string_view name = pair.substr(0, equals);
        const TextKey* key = find_key(keys, name);
        if (!key) return Error{std::string(what) + ": " + unknown_name("key", name, names)};
        if (const Result<void> set = set_value(*key, pair.substr(equals + 1)); !set)
            return Error{std::string(what) + ": " + set.error().message};
    }
    return {};
}

std::string key_value_text(std::span<const TextKey> keys) {
    std::string text;
    for (const TextKey& key : keys) {
        if (!text.empty()) text += ' ';
        text += std::string(key.name) + '=';
        for (int i = 0; i < key.components; ++i) {
            const double rounded = std::round(double(key.values[i]) * 1e4) / 1e4;
            text += (i ? "," : "") + to_text(rounded == 0 ? 0.0 : rounded);
        }
    }
    return text;
}

}  // namespace dermis
