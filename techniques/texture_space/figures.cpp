#include "techniques/texture_space/figures.h"

namespace dermis {
namespace {

const std::string kSource = "after Gosselin, Sander, Mitchell 2004, figure ";

using Settings = std::vector<std::pair<std::string, std::string>>;

FigureCell cell(std::string label, std::string id, Settings settings) {
    return {.label = std::move(label), .id = std::move(id), .settings = std::move(settings)};
}

// Two pictures that differ in one switch, and what the switch changes.
FigureRow with_and_without(FigureCell without, FigureCell with, float gain) {
    FigureCell difference = {.label = "difference, times " + std::to_string(int(gain)),
                             .kind = CellKind::difference,
                             .subject = with.id,
                             .compare_to = without.id,
                             .gain = gain};
    with.compare_to = without.id;
    return {"", {std::move(without), std::move(with), std::move(difference)}};
}

// A head, and from near: where the blur shows.
Figure blur_figure() {
    const FigureCell without = cell("without", "without", {{"blur_passes", "0"}}),
                     with = cell("with", "with", {});
    FigureRow near = with_and_without(without, with, 4);
    for (FigureCell& one : near.cells) {
        if (!one.id.empty()) one.id += "_near";
        if (!one.compare_to.empty()) one.compare_to += "_near";
        if (!one.subject.empty()) one.subject += "_near";
        one.camera = "target_mm=-12,6,85 distance_mm=400 fov_deg=12";
    }
    return {.id = "blur",
            .title = "With and without the texture-space blur",
            .source = kSource + "2.8.1",
            .rows = {with_and_without(without, with, 4), std::move(near)}};
}

FigureCell image_cell(std::string label, std::string image, FigureImageChannels channels, Settings settings) {
    FigureCell made = cell(std::move(label), "", std::move(settings));
    made.image = std::move(image);
    made.image_channels = channels;
    return made;
}

Figure light_map_figure() {
    // An even number of passes, none of whose maps is kept: the last is light_map_a.
    const Settings raw = {{"preset", "source"}, {"cull", "none"}, {"blur_passes", "0"}},
                   blurred = {{"preset", "source"},
                              {"cull", "none"},
                              {"dilate", "written_only"},
                              {"blur_passes", "2"},
                              {"blur_radius", "5"}};
    Figure figure = {
        .id = "light_map",
        .title = "The light map",
        .source = kSource + "2.8.2",
        .note = "Each pass of the blur fills texels outside the charts with the mean of those inside.",
        .rows = {{"",
                  {image_cell("lit, without blur", "light_map_a", FigureImageChannels::rgb, raw),
                   image_cell("dilated and blurred", "light_map_a", FigureImageChannels::rgb, blurred)}}}};
    for (FigureCell& one : figure.rows[0].cells) one.light = "intensity=1.2";
    return figure;
}

Figure shadow_map_figure() {
    return {.id = "shadow_map",
            .title = "The shadow map's channels",
            .source = kSource + "2.8.3",
            .note =
                "RGB has the optical depth of translucent surfaces (in the source: their opacity), shown as "
                "their transmittance; alpha has the depth of opaque surfaces.",
            .scene = "glasses",
            .only_in_its_scene = true,
            .rows = {{"",
                      {image_cell("RGB, exp(-x)", "shadow_channels", FigureImageChannels::transmittance, {}),
                       image_cell("alpha", "shadow_channels", FigureImageChannels::alpha, {})}}}};
}

Figure translucent_figure() {
    FigureRow row = with_and_without(cell("without", "without", {{"trans_shadow_alpha", "0"}}),
                                     cell("with translucent shadows", "with", {}), 8);
    for (FigureCell& one : row.cells) one.camera = "target_mm=0,5,60 distance_mm=520";
    return {.id = "translucent_shadow",
            .title = "Rendering a tinted lens with and without translucent shadows",
            .source = kSource + "2.8.4",
            .scene = "glasses",
            .only_in_its_scene = true,
            .rows = {row}};
}

Figure kernel_figure() {
    return {.id = "kernel_map",
            .title = "The blur kernel's size over the atlas",
            .source = kSource + "2.8.5",
            .note = "The light map's alpha; 1 (white) is where no triangle was drawn.",
            .scene = "bust",
            .rows = {{"",
                      {image_cell("kernel size", "light_map_a", FigureImageChannels::alpha,
                                  {{"preset", "source"}, {"cull", "none"}, {"blur_passes", "0"}})}}}};
}

// The source blurs farther where the skin is thin, so that light passes through a backlit ear.
Figure ear_figure() {
    // Transmission, which the source does not have, would light both ears.
    FigureRow row = with_and_without(
        cell("without the kernel map", "without", {{"kernel_growth", "0"}, {"transmission", "none"}}),
        cell("with it", "with", {{"kernel_growth", "1.5"}, {"transmission", "none"}}), 4);
    for (FigureCell& one : row.cells) {
        one.view = "diffuse";
        one.camera = "target_mm=70,-4,-5 yaw_deg=55 pitch_deg=0 distance_mm=260 fov_deg=16";
        one.light = "yaw_deg=186 pitch_deg=5 intensity=14";
    }
    return {.id = "kernel_ear",
            .title = "An ear lit from behind, with and without the kernel map",
            .source = kSource + "2.8.5",
            .note = "kernel_growth=1.5 is the source's ratio of its largest to its smallest kernel.",
            .scene = "bust",
            .only_in_its_scene = true,
            .rows = {row}};
}

Figure dilation_figure() {
    const Settings wide = {
        {"light_map_size", "512"}, {"blur", "gaussian"}, {"blur_passes", "2"}, {"blur_radius", "6"}};
    const auto dilate = [&](const char* how) {
        Settings settings = wide;
        settings.emplace_back("dilate", how);
        return settings;
    };
    FigureRow row = {"",
                     {cell("without", "off", dilate("off")),
                      cell("the source's copy in the first pass", "source", dilate("source")),
                      cell("average of written texels", "written", dilate("written_only"))}};
    row.cells[1].compare_to = row.cells[2].compare_to = "off";
    for (FigureCell& one : row.cells) one.camera = "yaw_deg=120 pitch_deg=10";
    return {.id = "dilation",
            .title = "With and without dilation at chart borders",
            .source = kSource + "2.8.6",
            .rows = {row}};
}

Figure specular_figure() {
    FigureRow row = {"",
                     {cell("without", "without", {{"specular_shadow", "off"}}),
                      cell("by the blurred light, as the source", "source", {{"specular_shadow", "source"}}),
                      cell("by the shadow map", "with", {})}};
    row.cells[1].compare_to = row.cells[2].compare_to = "without";
    // From behind, so that reflections graze along lips, nostrils and cheek, which are in shadow.
    for (FigureCell& one : row.cells) {
        one.camera = "target_mm=0,15,85 yaw_deg=14 pitch_deg=2 distance_mm=300 fov_deg=20";
        one.light = "yaw_deg=-130 pitch_deg=20 intensity=9";
    }
    return {
        .id = "specular_shadow",
        .title = "With and without shadowing the specular term",
        .source = kSource + "2.8.7",
        .note = "Lit from behind: without shadows nose, lips and cheek reflect a light that the head hides.",
        .rows = {row}};
}

Figure cull_figure() {
    // The source's blur: what is culled keeps clear of the reach of all passes, and that of the profile is
    // wide. An even number of passes: the last is light_map_a.
    const Settings on = {{"preset", "source"}, {"blur_passes", "2"}},
                   off = {{"preset", "source"}, {"blur_passes", "2"}, {"cull", "none"}};
    FigureRow maps = {"The light map",
                      {image_cell("not culled", "light_map_a", FigureImageChannels::rgb, off),
                       image_cell("culled", "light_map_a", FigureImageChannels::rgb, on)}};
    FigureRow pictures = {"The picture", {cell("not culled", "off", off), cell("culled", "on", on)}};
    pictures.cells[1].compare_to = "off";
    for (FigureRow* row : {&maps, &pictures})
        for (FigureCell& one : row->cells) one.camera = "yaw_deg=-60 pitch_deg=0";
    return {.id = "culling",
            .title = "The texture-space computation is culled on back-facing regions",
            .source = kSource + "2.8.8",
            .note = "Thin parts, where the kernel-size map is above 0.25, are never culled.",
            .scene = "bust",
            .rows = {maps, pictures}};
}

Figure millimetres_figure() {
    const Settings texels = {
        {"blur", "gaussian"}, {"blur_passes", "3"}, {"blur_radius", "4"}, {"kernel_growth", "0"}};
    FigureRow row = {
        "",
        {cell("in texels, as in the source", "texels", texels),
         cell("in millimetres, by the profile", "mm", {}), cell("sum of Gaussians", "gaussians", {})}};
    row.cells[2].technique = "texture_space_gaussians";
    for (FigureCell& one : row.cells) one.view = "light_map", one.camera = "yaw_deg=60 pitch_deg=8";
    row.cells[1].compare_to = row.cells[2].compare_to = "texels";
    return {.id = "millimetres",
            .title = "The blurred light, in texels and in millimetres",
            .source = "not in the source; the last after d'Eon, Luebke 2007",
            .rows = {row}};
}

Figure seams_figure() {
    // Seen from where the sphere's chart begins and ends, with the terminator there.
    FigureRow row =
        with_and_without(cell("carry_seams=off", "drop", {{"carry_seams", "off"}, {"transmission", "none"}}),
                         cell("carry_seams=on", "carry", {{"transmission", "none"}}), 4);
    for (FigureCell& one : row.cells) {
        one.technique = "texture_space_gaussians";
        one.view = "light_map";
        one.camera = "yaw_deg=180 pitch_deg=0";
        one.light = "yaw_deg=100 pitch_deg=0";
    }
    return {.id = "seams",
            .title = "The blurred light of a sphere of 4 mm at its UV seam",
            .source = "not in the source",
            .scene = "unit",
            .only_in_its_scene = true,
            .rows = {row}};
}

}  // namespace

std::vector<Figure> texture_space_figures() {
    return {blur_figure(),   light_map_figure(),   shadow_map_figure(), translucent_figure(),
            kernel_figure(), ear_figure(),         dilation_figure(),   specular_figure(),
            cull_figure(),   millimetres_figure(), seams_figure()};
}

}  // namespace dermis
