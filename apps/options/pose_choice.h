#pragma once
// Where a mesh is in its motion: --clip talk --time 1.2 --morph jawOpen=0.6.

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dermis/scene/scene_words.h"

namespace dermis::cli {

inline constexpr NumberRange kTimeRange = {0, 1e6}, kFpsRange = {0, 1000};

struct PoseChoice {
    std::string clip;                 ///< empty: the scene's
    std::optional<double> time_s;     ///< in the clip; none: the scene's
    std::vector<std::string> morphs;  ///< "TARGET=WEIGHT"

    void add_to(Command& command);
    [[nodiscard]] bool given() const { return !clip.empty() || time_s || !morphs.empty(); }
    /// As words of the scene file's [animation] and [morph].
    [[nodiscard]] Result<std::vector<SceneWord>> words() const;
};

}  // namespace dermis::cli
