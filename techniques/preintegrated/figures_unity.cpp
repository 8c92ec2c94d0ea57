#include "dermis/bake/lut.h"
#include "techniques/preintegrated/figures.h"
#include "techniques/preintegrated/tables.h"

namespace dermis::preintegrated {
namespace {

constexpr const char* kUnitySource = "after a Unity implementation of Penner 2011";
constexpr const char* kUnityCamera = "distance_mm=520";
constexpr const char* kMouth = "target_mm=-4,14,85 distance_mm=400 fov_deg=12";
constexpr const char* kNoseShadow = "target_mm=22,42,80 distance_mm=400 fov_deg=10";

FigureCell difference_cell(std::string label, std::string subject, std::string compare_to, float gain) {
    return {.label = std::move(label) + ", times " + std::to_string(int(gain)),
            .kind = CellKind::difference,
            .subject = std::move(subject),
            .compare_to = std::move(compare_to),
            .gain = gain};
}

FigureCell table_cell(std::string id, std::string diffuse, CellEncoding encoding) {
    return {.label = encoding == CellEncoding::linear ? "linear values shown unchanged"
                                                      : "encoded for display (sRGB)",
            .id = std::move(id),
            .kind = CellKind::table,
            .settings = {{"diffuse", std::move(diffuse)}, {"normals", "blended"}},
            .table = "skin_lut",
            .encoding = encoding};
}

// The script of the article, tap by tap, over our axes.
Result<FigurePicture> unity_taps(const SkinContext&, int width, int height) {
    Result<LutOptions> options = lut_options("unity_2011");
    if (!options) return options.error();
    options->width = width;
    options->height = height;
    options->convention.axes[1] = curvature_axis(0, kMaxCurvaturePerMm);
    const Result<Table> table = bake_lut(*options);
    if (!table) return table.error();
    return FigurePicture{width, height, table->data};
}

Figure table_figure() {
    const auto script = [](CellEncoding encoding, std::string id) {
        FigureCell cell = table_cell(std::move(id), "half_ring", encoding);
        cell.kind = CellKind::computed;
        cell.table.clear();
        cell.settings.clear();
        cell.compute = unity_taps;
        return cell;
    };
    FigureRow published = {"The article's script: ring in steps of 0.05 rad, variances times 1.414",
                           {script(CellEncoding::linear, "script"), script(CellEncoding::srgb, "")}};
    FigureRow ring = {"The same ring, integrated exactly",
                      {table_cell("ring", "half_ring", CellEncoding::linear),
                       table_cell("", "half_ring", CellEncoding::srgb)}};
    FigureRow sphere = {
        "The closed sphere",
        {table_cell("sphere", "lut", CellEncoding::linear), table_cell("", "lut", CellEncoding::srgb)}};
    ring.cells[0].compare_to = "script";
    sphere.cells[0].compare_to = "ring";
    return {.id = "table",
            .title = "The table itself: N·L from -1 to 1 to the right, 1/r from 0 to 1/mm downwards",
            .source = std::string(kUnitySource) + ": the lookup texture, as stored and in linear space",
            .note =
                "A table is data. Read as an sRGB texture it gives the shading of the left column instead of "
                "the right: too dark near the terminator, as the article's author found.",
            .scene = "builtin:spheres",
            .rows = {published, ring, sphere}};
}

Figure curvature_figure() {
    FigureCell vertex = {.label = "at the vertices, 1/mm", .view = "curvature"};
    const auto used = [](std::string label, std::string curvature) {
        return FigureCell{
            .label = std::move(label), .settings = {{"curvature", curvature}}, .view = "skin_curvature"};
    };
    const auto shaded = [](std::string label, std::string curvature) {
        return FigureCell{.label = std::move(label),
                          .id = curvature,
                          .settings = {{"curvature", curvature}, {"normals", "sharp"}},
                          .view = "diffuse"};
    };
    FigureRow shown = {"Curvature",
                       {vertex, used("|1/r|, by the length of the mean normals", "vertex"),
                        used("|1/r|, from derivatives", "derivative")}};
    FigureRow shades = {"Diffuse light",
                        {shaded("from the vertices", "vertex"), shaded("from derivatives", "derivative")}};
    shades.cells[1].compare_to = "vertex";
    shades.cells.push_back({.label = "difference times 32",
                            .kind = CellKind::difference,
                            .subject = "derivative",
                            .compare_to = "vertex",
                            .gain = 32});
    return {.id = "curvature",
            .title = "Curvature",
            .source = std::string(kUnitySource) + ": the curvature of the model",
            .note =
                "Derivatives of the interpolated normal are constant within a facet, so the facets are "
                "visible; the estimate at the vertices is smoothed over 1.8 mm of skin. By default the "
                "curvature is that of the baked mean normals.",
            .rows = {shown, shades}};
}

Figure normals_figure() {
    const auto cell = [](std::string label, std::string normals) {
        FigureCell made = {.label = std::move(label),
                           .id = normals,
                           .settings = {{"normals", normals}},
                           .view = "diffuse",
                           .camera = kMouth};
        if (normals != "sharp") made.compare_to = "sharp";
        return made;
    };
    FigureRow published = {
        "As published",
        {cell("as mapped: \"too crispy\"", "sharp"), cell("three mip levels higher", "smooth"),
         cell("one mixed normal in each channel: lerp", "lerp")}};
    FigureRow ours = {"Light instead of normals",
                      {cell("the light of two levels, mixed: blended", "blended"),
                       cell("mean normals over the profile: baked", "baked"),
                       difference_cell("what baked changes", "baked", "sharp", 4)}};
    return {.id = "normals",
            .title = "Scattering at small bumps",
            .source = std::string(kUnitySource) + ": \"Softening Finer Details\", mip bias 3.0",
            .note =
                "The article tunes the weights of lerp by eye; here they follow from the profile and the "
                "map's scale in mm. Three levels up, texels at the nostril's rim average normals that "
                "face apart.",
            .rows = {published, ours}};
}

Figure parts_figure() {
    const auto cell = [](std::string label, std::string technique, std::string view) {
        FigureCell made = {.label = std::move(label),
                           .id = technique + view,
                           .technique = technique,
                           .view = std::move(view),
                           .camera = kUnityCamera};
        made.settings = {{"specular", "ksk"}};
        return made;
    };
    FigureRow row = {"",
                     {cell("Lambert, diffuse alone", "lambert", "diffuse"),
                      cell("diffuse alone", "preintegrated", "diffuse"),
                      cell("specular alone (ksk)", "preintegrated", "specular"),
                      cell("combined", "preintegrated", "final")}};
    row.cells[1].compare_to = "lambertdiffuse";
    return {.id = "parts",
            .title =
                "Lambert, and the parts of preintegrated: Kelemen/Szirmay-Kalos with the Beckmann table and "
                "Schlick's Fresnel",
            .source = std::string(kUnitySource) + ": the start, before specular, specular, and both combined",
            .rows = {row}};
}

Figure shadow_figure() {
    const auto cell = [](std::string label, std::string shadow) {
        return FigureCell{.label = std::move(label),
                          .id = shadow,
                          .settings = {{"shadow", shadow}},
                          .view = "diffuse",
                          .camera = kNoseShadow,
                          .environment = "none"};
    };
    FigureRow shadows = {
        "",
        {cell("filtered, not scattered", "plain"), cell("scattered into the filter's width", "scattered"),
         cell("gathered around the point", "gathered")}};
    FigureRow changes = {"",
                         {difference_cell("what scattered changes", "scattered", "plain", 4),
                          difference_cell("what gathered changes", "gathered", "plain", 4)}};
    return {.id = "shadow",
            .title = "Scattering into the shadow's edge",
            .source = "Penner 2011; both articles left it out",
            .note = "The shadow of the nose under one light.",
            .rows = {shadows, changes}};
}

}  // namespace

std::vector<Figure> unity_figures() {
    return {table_figure(), curvature_figure(), normals_figure(), parts_figure(), shadow_figure()};
}

}  // namespace dermis::preintegrated
