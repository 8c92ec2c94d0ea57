#pragma once
// The parts of the interface that panels.cpp puts together. Between Interface::begin and end.

#include "dermis/view/panels.h"

namespace dermis::view {

// technique_panels.cpp
/// Choice, source and every parameter of one side.
void show_technique(Model& model, size_t choice, PanelRequests& requests, WidgetMap& widgets);
/// Debug view, exposure, tone map.
void show_view(Model& model, WidgetMap& widgets);
void show_compare(Model& model, PanelRequests& requests, WidgetMap& widgets);

// scene_panels.cpp; all want a scene
void show_light(Scene& scene, WidgetMap& widgets);
void show_skin(Model& model, PanelRequests& requests, WidgetMap& widgets);
void show_camera(Scene& scene, PanelRequests& requests, WidgetMap& widgets);

// warning_panel.cpp
/// What is not read yet.
void show_warnings(Warnings& warnings, WidgetMap& widgets);

// head_panel.cpp; wants a scene
/// Unit and materials of the scene's mesh files.
void show_head(Model& model, WidgetMap& widgets);

// motion_panel.cpp; wants a scene
/// Clip, time and morph targets.
void show_motion(Model& model, PanelRequests& requests, WidgetMap& widgets);

// time_panel.cpp
void show_times(const PanelFacts& facts);

// overlays.cpp, open_panel.cpp; over the picture
/// Shows name and seconds of loading until the first picture.
void show_loading(const Model& model, const PanelFacts& facts);
/// Shows what is being baked, and how far it is.
void show_baking(const PanelFacts& facts);
void show_side_names(const Model& model, const PanelFacts& facts);
void show_open_field(Model& model, const PanelFacts& facts, PanelRequests& requests);
void show_notices(const Model& model, const PanelFacts& facts);
void show_help(const PanelFacts& facts);

}  // namespace dermis::view
