#include "preintegrated/figures.h"

namespace dermis {
namespace {

constexpr const char* kUnity = "after a Unity implementation of Penner 2011";
constexpr const char* kCurves = "after Yeung 2015, Pre-Integrated Skin Shading";

Figure table_figure() {
    const auto cell = [](std::string label, std::string construction, CellEncoding encoding) {
        return FigureCell{.label = std::move(label),
                          .kind = CellKind::table,
                          .settings = {{"construction", std::move(construction)}},
                          .table = "skin_lut",
                          .encoding = encoding};
    };
    FigureRow ring = {"The published ring",
                      {cell("linear values shown as they are", "ring", CellEncoding::linear),
                       cell("encoded for display (sRGB)", "ring", CellEncoding::srgb)}};
    ring.cells[0].id = "ring";
    FigureRow sphere = {"The closed sphere",
                        {cell("linear values shown as they are", "sphere", CellEncoding::linear),
                         cell("encoded for display (sRGB)", "sphere", CellEncoding::srgb)}};
    sphere.cells[0].compare_to = "ring";
    return {
        .id = "table",
        .title = "The table itself: N·L from -1 to 1 to the right, 1/r from 0 to 0.5/mm downwards",
        .source = std::string(kUnity) + ", the lookup texture",
        .note =
            "A table is data. Read as an sRGB texture it shades as the left pictures look: too dark in the "
            "falloff, as the article's author found.",
        .scene = "builtin:spheres",
        .rows = {ring, sphere}};
}

Figure normals_figure() {
    const auto cell = [](std::string label, std::string normals) {
        return FigureCell{.label = std::move(label),
                          .id = normals,
                          .settings = {{"normals", normals}, {"specular", "none"}},
                          .view = "diffuse",
                          .camera = "distance_mm=450"};
    };
    FigureRow row = {
        "",
        {cell("as mapped: \"too crispy\"", "sharp"), cell("blended, one normal a channel", "blended"),
         cell("all from the smaller mip", "smooth")}};
    row.cells[1].compare_to = row.cells[2].compare_to = "sharp";
    return {.id = "normals",
            .title = "Scattering at small bumps",
            .source = std::string(kUnity) + ", \"Softening Finer Details\", mip bias 3.0",
            .rows = {row}};
}

Figure spheres_figure() {
    Figure figure = {.id = "spheres_direct",
                     .title = "Spheres under one light: table, curves, closed form",
                     .source = std::string(kCurves) + ", spheres lit by a single directional light",
                     .scene = "builtin:spheres"};
    for (const auto& [diffuse, name] :
         {std::pair{"lut", "table"}, {"curve_2015", "curves of 2015"}, {"closed_form", "closed form"}}) {
        FigureRow row = {.label = name};
        for (const char* radius : {"2", "4", "8", "16"}) {
            const std::string id = std::string(diffuse) + radius;
            row.cells.push_back(
                {.label = std::string("r = ") + radius + " mm",
                 .id = id,
                 .settings = {{"diffuse", diffuse}, {"shadow", "plain"}, {"specular", "none"}},
                 .view = "diffuse",
                 .object = std::string("sphere_") + radius + "mm",
                 .environment = "none",
                 .compare_to = std::string(diffuse) == "lut" ? "" : std::string("lut") + radius});
        }
        figure.rows.push_back(row);
    }
    return figure;
}

}  // namespace

std::vector<Figure> preintegrated_figures() {
    return {table_figure(), normals_figure(), spheres_figure()};
}

}  // namespace dermis
