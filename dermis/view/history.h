#pragma once
// Undo and redo of what panels, keys and scripts change of the look, the head and the techniques. The camera,
// the time of a clip, the debug view and the comparison are not part of it.

#include <deque>
#include <string>
#include <vector>

#include "dermis/view/shown_scene.h"

namespace dermis::view {

/// Largest number of steps that can be undone.
inline constexpr size_t kMostSteps = 200;

class History {
  public:
    /// Once a frame: a state that differs from the last becomes a step. Not while something is held, so that
    /// a whole drag is one step.
    void follow(Model& model);
    /// The scene was read again: what reading changed belongs to the last step.
    void amend(Model& model);
    /// Another scene.
    void forget() { states_.clear(), now_ = 0; }

    /// Returns false where nothing is left to undo or redo. If the change belongs to the words that a scene
    /// is loaded with, the opener reads the scene again. Errors: a panorama that cannot be read any more.
    [[nodiscard]] Result<bool> undo(Model& model, ShownScene& shown) { return go(-1, model, shown); }
    [[nodiscard]] Result<bool> redo(Model& model, ShownScene& shown) { return go(1, model, shown); }

  private:
    struct State {
        std::string key;  ///< equal states have equal keys
        Scene look;       ///< without objects
        std::vector<SceneWord> words;
        std::array<TechniqueChoice, 2> choices;
        int tone = 0;
    };
    [[nodiscard]] static State state_of(Model& model, std::string key);
    [[nodiscard]] Result<bool> go(int step, Model& model, ShownScene& shown);

    std::deque<State> states_;
    size_t now_ = 0;  ///< index of the present state
};

}  // namespace dermis::view
