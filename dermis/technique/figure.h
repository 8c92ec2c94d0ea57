#pragma once
// The figures of a technique's source, declared as data: what `dermis figures` draws, one labelled sheet a
// figure.
//
//     Figure{.id = "normals", .title = "Bumps", .source = "the article, \"Too crispy\"",
//            .rows = {{.cells = {{.label = "sharp", .id = "sharp", .settings = {{"normals", "sharp"}}},
//                                {.label = "blended", .settings = {{"normals", "blended"}}, .compare_to =
//                                "sharp"}}}}}
//
// A technique lists them in Technique::figures; dermis/report renders the cells, compares, and composes.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline technique {

struct SkinContext;

/// Content of a cell.
enum class CellKind {
    render,     ///< a scene drawn with a technique
    table,      ///< a table that the technique bakes for its settings
    computed,   ///< what `compute` returns
    difference  ///< |subject - compare_to| of two other cells, times gain, as grey
};

/// How numbers that are not a drawn picture become colours: encoded as a display wants them, or put there as
/// they are, which is what a viewer shows of a linear texture.
enum class CellEncoding { srgb, linear };

enum class CellAlbedo { mapped, white };

/// Channels that are shown of an image of the frame; transmittance is exp(-rgb).
enum class FigureImageChannels { rgb, alpha, transmittance };

/// Linear values, three a texel, rows top to bottom.
struct FigurePicture {
    int width = 0, height = 0;
    std::vector<float> rgb_linear;
};

/// Empty texts mean "as the figure (or the scene) has it".
struct FigureCell {
    std::string label;  ///< above the cell; the figure's numbers come beneath it
    std::string id;     ///< by which other cells name it, unique in its figure
    CellKind kind = CellKind::render;

    std::string scene, technique;
    std::vector<std::pair<std::string, std::string>> settings;  ///< parameters as --set takes them
    std::string view = "final";
    std::string camera, light;  ///< as --camera and --light take them
    std::string object;         ///< the camera is moved so that this object of the scene fills the cell
    std::string environment;  ///< none, studio, or a panorama ("assets:hdri/sunset.hdr"); one that is absent
                              ///< is replaced by the studio turned half around, and the label says so
    float environment_yaw_deg = 0;
    bool environment_visible = false;
    CellAlbedo albedo = CellAlbedo::mapped;
    std::string image;  ///< of a render: an image of the frame by name, instead of the picture
    FigureImageChannels image_channels = FigureImageChannels::rgb;

    std::string table;  ///< its name
    std::function<Result<FigurePicture>(const SkinContext&, int width, int height)> compute;
    CellEncoding encoding = CellEncoding::srgb;

    std::string subject;     ///< of a difference: the id of a cell before this one
    std::string compare_to;  ///< id of an earlier cell; the difference is printed below
    float gain = 8;          ///< of a difference
};

struct FigureRow {
    std::string label;  ///< may be empty
    std::vector<FigureCell> cells;
};

/// The scene name of a figure that wants a head: the scan where it is installed, else the built-in bust.
inline constexpr const char* kHeadScene = "head";

struct Figure {
    std::string id;  ///< the file's name
    std::string title;
    std::string source;  ///< which document's figure it makes again
    std::string note;    ///< what to see, and what differs from the source; one to three sentences
    std::string scene = kHeadScene;
    bool only_in_its_scene = false;  ///< no other scene has what it shows
    std::string technique;           ///< empty: the one that lists it
    float aspect = 1;                ///< width over height of a cell
    std::vector<FigureRow> rows;
};

/// Everything wrong with a figure that shows without drawing it, one line each: ids used twice or not (yet)
/// there, cells without what their kind needs.
[[nodiscard]] std::vector<std::string> problems(const Figure& figure);

}  // namespace dermis::inline technique
