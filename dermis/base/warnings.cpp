#include "dermis/base/warnings.h"

#include <unordered_map>

#include "dermis/base/text.h"

namespace dermis {

void tidy_warnings(std::vector<std::string>& warnings) {
    constexpr size_t kMost = 50;
    std::unordered_map<std::string, size_t> place;
    std::vector<std::string> once;
    std::vector<size_t> times;
    for (const std::string& warning : warnings) {
        const auto [at, is_new] = place.try_emplace(warning, once.size());
        if (is_new) once.push_back(warning), times.push_back(0);
        ++times[at->second];
    }
    for (size_t i = 0; i < once.size(); ++i) {
        once[i] = printable_line(once[i]);
        if (times[i] > 1) once[i] += " (" + std::to_string(times[i]) + " times)";
    }
    if (once.size() > kMost) {
        const std::string rest = std::to_string(once.size() - kMost);
        once.resize(kMost);
        once.push_back("and " + rest + " more warnings");
    }
    warnings = std::move(once);
}

}  // namespace dermis
