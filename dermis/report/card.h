#pragma once
// The graphics cards that costs are modelled for: one for each chip that the compiler is asked for.

#include <span>
#include <string_view>

#include "dermis/base/result.h"

namespace dermis::inline report {

struct Card {
    std::string_view chip;  ///< as RADV_FORCE_FAMILY has it since Mesa 23
    std::string_view name;
    double clock_ghz = 0;  ///< what the maker promises in games (Vega: the boost clock)
    int compute_units = 0, simds_per_unit = 0;
    double bandwidth_gb_s = 0;  ///< of its memory, 10^9 bytes a second; caches not counted
    std::string_view source;    ///< of the figures

    /// Cycles that all SIMDs of the card have together in a millisecond.
    [[nodiscard]] double simd_cycles_per_ms() const {
        return clock_ghz * 1e6 * compute_units * simds_per_unit;
    }
    [[nodiscard]] double bytes_per_ms() const { return bandwidth_gb_s * 1e6; }
};

[[nodiscard]] std::span<const Card> cards();

/// Error: an unknown chip, with the known ones.
[[nodiscard]] Result<const Card*> find_card(std::string_view chip);

}  // namespace dermis::inline report
