#pragma once
// The interface over the picture: a column of settings on the right, a line of state below the picture, help.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dermis/optics/tissue/skin_model.h"
#include "dermis/view/actions.h"
#include "dermis/view/model.h"

namespace dermis::view {

/// In pixels of the window.
struct Region {
    float x = 0, y = 0, width = 0, height = 0;
};

struct TimedPass {
    std::string name;
    double time_ms = 0;
    std::vector<float> history_ms;  ///< oldest first, this one last
};

/// Values that panels show but cannot change.
struct PanelFacts {
    float scale = 1;
    int width = 0, height = 0;          ///< the window, pixels
    std::string device, picture_state;  ///< picture_state: "1280x800, 4 samples"
    std::vector<TimedPass> passes;
    double frame_ms = 0;
    std::vector<float> frame_history_ms;  ///< oldest first
    std::string loading;                  ///< the scene that is being read; empty: none
    double elapsed_s = 0;                 ///< since the window's start
    bool lacks_bakes = false;             ///< curvature and occlusion of the shown scene
    std::string probe;                    ///< the surface under the mouse pointer
};

/// Requests of a panel beyond the model.
struct PanelRequests {
    std::vector<Action> actions;
    std::optional<int> tone;            ///< Model::tone wanted
    std::optional<SkinModel> pigments;  ///< skin of these wanted
    std::string open;                   ///< a scene
};

/// Where widgets are, by what they set ("exposure_ev", a parameter's name): scripts drag them there.
using WidgetMap = std::map<std::string, Region>;

/// The part of the window that the picture has.
[[nodiscard]] Region picture_region(const Model& model, int width, int height, float scale);

/// Between Interface::begin and end.
void show_panels(Model& model, const PanelFacts& facts, PanelRequests& requests, WidgetMap& widgets);

}  // namespace dermis::view
