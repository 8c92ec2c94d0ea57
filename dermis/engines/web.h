#pragma once
// A scene's skin as a page for the browser (WebGL 2), a folder for any static server.
//
//     Result<WebPage> page = make_web_page(input);   // input.scene: after complete_scene()
//     for (const WebFile& file : page->files) ...
//
// The page itself is engines/web: HTML, modules and shaders, as they are. Made here are skin.essl (the
// functions of shaders/include/skin), shared.glsl (tone map, constants), scene.json (camera, lights,
// materials, tones), scene.bin (vertices, tables, environment), motion.bin (targets, skins and clips of
// objects that move) and the maps as JPEG. It shows light of distant lights; the key light's shadow is drawn
// by the page, transmission and other lights' shadows are not.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/gain_form.h"
#include "dermis/scene/scene.h"
#include "dermis/shading/shading.h"
#include "dermis/technique/technique.h"

namespace dermis::inline engines {

/// A skin to choose on the page.
struct WebTone {
    std::string name;         ///< what the button says
    std::string description;  ///< the profile's name
    Vec3 albedo_tint_linear = {1, 1, 1};
    Vec3 mean_albedo_linear;  ///< tint included: the button's colour
    /// Both rgba32f: diffuse light over N.L from -1 to 1 and curvature from 0 to
    /// WebInput::table_max_curvature_per_mm, and the rows that the page's shader reads by number.
    TableImage diffuse_table, rows_table;
    std::array<Vec3, 3> occlusion_weights;  ///< of the occlusion's three blurs
    GainForm gain;
};

struct WebInput {
    const Scene& scene;
    std::vector<WebTone> tones;                  ///< 1 to 16; the first is shown first
    std::span<const shading::Source> functions;  ///< shaders/include/skin
    /// engines/web by path, and the shaders of `shared_shaders`.
    std::span<const shading::Source> texts;
    /// The renderer's own files that the page's shader includes, in the order in which they go into
    /// shared.glsl.
    std::span<const std::string_view> shared_shaders;
    int map_side = 1024;             ///< larger maps are made smaller
    size_t triangle_count = 30'000;  ///< of each object, at most, where its seams allow it
    float table_max_curvature_per_mm = 1;
    float shadow_width_mm = 3;  ///< that the row of a shadow's edge was made for
};

/// `path` is relative to the folder, with '/'.
struct WebFile {
    std::string path;
    std::vector<std::byte> bytes;
};

struct WebPage {
    std::vector<WebFile> files;         ///< in the order of their paths
    std::vector<std::string> warnings;  ///< what of the scene the page does not show
};

/// The same input gives the same bytes. Errors: no skin, a map that cannot be read, a table of another
/// format.
[[nodiscard]] Result<WebPage> make_web_page(const WebInput& input);

}  // namespace dermis::inline engines
