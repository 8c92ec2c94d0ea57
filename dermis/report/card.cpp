#include "dermis/report/card.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::inline report {

// RDNA has two SIMDs a compute unit, GCN four (AMD, "RDNA Architecture" white paper, 2019, page 8).
std::span<const Card> cards() {
    static constexpr Card kCards[] = {
        {.chip = "navi21",
         .name = "Radeon RX 6900 XT",
         .clock_ghz = 2.015,
         .compute_units = 80,
         .simds_per_unit = 2,
         .bandwidth_gb_s = 512,
         .source = "AMD, product page of the Radeon RX 6900 XT, 2020: game clock 2015 MHz, 80 compute units, "
                   "16 Gbit/s over 256 bit"},
        {.chip = "navi31",
         .name = "Radeon RX 7900 XTX",
         .clock_ghz = 2.3,
         .compute_units = 96,
         .simds_per_unit = 2,
         .bandwidth_gb_s = 960,
         .source =
             "AMD, product page of the Radeon RX 7900 XTX, 2022: game clock 2300 MHz, 96 compute units, "
             "20 Gbit/s over 384 bit"},
        {.chip = "vega10",
         .name = "Radeon RX Vega 64",
         .clock_ghz = 1.546,
         .compute_units = 64,
         .simds_per_unit = 4,
         .bandwidth_gb_s = 483.8,
         .source =
             "AMD, product page of the Radeon RX Vega 64, 2017: boost clock 1546 MHz, 64 compute units, "
             "1.89 Gbit/s over 2048 bit"}};
    return kCards;
}

Result<const Card*> find_card(std::string_view chip) {
    const auto found = std::ranges::find(cards(), chip, &Card::chip);
    if (found != cards().end()) return &*found;
    std::vector<std::string> known;
    for (const Card& card : cards()) known.emplace_back(card.chip);
    return Error{unknown_name("chip", chip, known)};
}

}  // namespace dermis::inline report
