#include "techniques/spherical_gaussians/figures.h"

namespace dermis::spherical_gaussians {

std::vector<Figure> figures() {
    struct Column {
        const char* label;
        const char* technique;
        std::vector<std::pair<std::string, std::string>> settings;
    };
    const Column columns[] = {
        {"integral over the sphere", "preintegrated", {}},
        {"Lambert", "lambert", {}},
        {"one lobe, the variance", "spherical_gaussians", {{"lobes", "1"}, {"width", "variance"}}},
        {"one lobe, the deviation", "spherical_gaussians", {{"lobes", "1"}}},
        {"two lobes", "spherical_gaussians", {{"lobes", "2"}}},
        {"six lobes", "spherical_gaussians", {{"lobes", "6"}}}};
    Figure figure = {.id = "spheres",
                     .title = "Spheres under one light",
                     .source = "Pettineo 2020: spheres by lobes of several widths beside a reference",
                     .note =
                         "One lobe cannot have both the narrow and the wide part of the profile: with the "
                         "profile's variance its light reaches too far past the terminator.",
                     .scene = "builtin:spheres",
                     .only_in_its_scene = true};
    for (const char* radius : {"2", "4", "8"}) {
        FigureRow row = {.label = std::string("r = ") + radius + " mm"};
        for (const Column& column : columns) {
            const bool exact = row.cells.empty();
            row.cells.push_back({.label = column.label,
                                 .id = exact ? std::string("exact") + radius : "",
                                 .technique = column.technique,
                                 .settings = column.settings,
                                 .view = "diffuse",
                                 .object = std::string("sphere_") + radius + "mm",
                                 .environment = "none",
                                 .compare_to = exact ? "" : std::string("exact") + radius});
        }
        figure.rows.push_back(std::move(row));
    }
    return {figure};
}

}  // namespace dermis::spherical_gaussians
