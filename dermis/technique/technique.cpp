#include "dermis/technique/technique.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::inline technique {

Result<const Technique*> find_technique(std::span<const Technique> techniques, std::string_view id) {
    std::vector<std::string> ids;
    for (const Technique& technique : techniques) {
        if (technique.id == id) return &technique;
        ids.push_back(technique.id);
    }
    return Error{unknown_name("technique", id, ids)};
}

Result<const Technique*> find_baseline(std::span<const Technique> techniques) {
    const auto baseline = std::ranges::find(techniques, true, &Technique::is_baseline);
    if (baseline == techniques.end())
        return Error{"no technique is the baseline: set is_baseline in techniques/<id>/technique.cpp"};
    return &*baseline;
}

Result<const Technique*> find_default(std::span<const Technique> techniques) {
    const auto usual = std::ranges::find(techniques, true, &Technique::is_default);
    if (usual == techniques.end())
        return Error{"no technique is the default: set is_default in techniques/<id>/technique.cpp"};
    return &*usual;
}

Result<void> check_settings(const Technique& technique, const ParameterValues& values) {
    if (Result<void> in_range = values.check(); !in_range) return in_range.error().within(technique.id);
    const std::string refused = technique.refusal ? technique.refusal(values) : "";
    if (!refused.empty()) return Error{technique.id + ": " + refused};
    return {};
}

}  // namespace dermis::inline technique
