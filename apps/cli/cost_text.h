#pragma once
// What `dermis cost` prints, as text and as JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "dermis/report/ratios.h"

namespace dermis::cli {

/// What is asked for, and what a frame of each technique has to do.
struct Counted {
    std::vector<Contestant> contestants;  ///< the cost base is among them
    std::vector<const Card*> cards;
    Size size;
    std::string scene, credit;
    std::string device;             ///< that counted
    std::vector<FrameWork> frames;  ///< one for each contestant
};

/// A table for each technique, then the frames beside each other. At most 100 columns.
void print_card(const Counted& counted, const Card& card, const std::vector<FrameCost>& costs);

/// What holds for all cards, with an empty array "gpus".
[[nodiscard]] nlohmann::ordered_json to_json(const Counted& counted);
[[nodiscard]] nlohmann::ordered_json to_json(const Counted& counted, const Card& card,
                                             const std::vector<FrameCost>& costs);

}  // namespace dermis::cli
