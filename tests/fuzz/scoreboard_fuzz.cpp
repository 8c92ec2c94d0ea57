// A scoreboard that may have been edited by hand: rows, or an error that names the line; rows can be written
// as a table and plotted.
// Dictionary: dermis/judge/scores_csv.cpp

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dermis/judge/scoreboard.h"
#include "dermis/judge/scores.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto rows = dermis::parse_scores(text);
    if (!rows) {
        const std::string& message = rows.error().message;
        if (!message.starts_with("scores line ") || message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    const auto again = dermis::parse_scores(dermis::scores_csv(*rows));
    if (!again || again->size() != rows->size()) std::abort();
    (void)dermis::scoreboard_markdown(*rows);
    (void)dermis::scoreboard_plot(*rows);
    (void)dermis::merged(*rows, *again);
    return 0;
}
