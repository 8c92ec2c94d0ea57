#include "dermis/base/warnings.h"

#include "dermis/base/text.h"

namespace dermis::inline base {

void tidy_warnings(std::vector<std::string>& warnings) {
    constexpr size_t kMost = 50;
    for (std::string& warning : warnings) warning = printable_line(warning);
    std::vector<std::string> once = each_once(warnings);
    if (once.size() > kMost) {
        const std::string rest = std::to_string(once.size() - kMost);
        once.resize(kMost);
        once.push_back("and " + rest + " more warnings");
    }
    warnings = std::move(once);
}

}  // namespace dermis::inline base
