// `dermis bake curvature | thickness | kernel-size | stretch | occlusion | gain`: maps of a mesh over its UV
// atlas.

#include <atomic>
#include <cstdio>
#include <memory>

#include "bake_options.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/rays/map_file.h"
#include "map_options.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace {

struct BakeMapsOptions {
    MapChoice map;
    std::string output;
};

Result<FileUse> files_of(const BakeMapsOptions& options) {
    const std::filesystem::path path = options.output;
    DERMIS_TRY(check_map_path(path, options.map.settings));
    return FileUse{.outputs = {path, map_sidecar_path(path), map_preview_path(path), atlas_mesh_path(path)},
                   .inputs = {options.map.mesh, options.map.profile}};
}

Result<int> run(const BakeMapsOptions& options) {
    DERMIS_TRY_ASSIGN(const MapRequest request, options.map.request());
    DERMIS_TRY(keep_scene_files(request.scene, files_of(options)));
    const BakeMapSettings& settings = request.settings;
    const Result<BakedMap> map = [&] {
        constexpr double kSteps = 1000;
        Progress line(std::string(map_kind_name(settings.kind)), size_t(kSteps));
        std::atomic<size_t> shown = 0;
        return bake_map(request.scene.objects, settings, [&](double done) {
            const auto now = size_t(done * kSteps);
            const size_t before = shown.exchange(now);
            if (now > before) line.advance(now - before);
        });
    }();
    if (!map) return map.error();
    DERMIS_TRY(write_map(options.output, *map,
                         {.mesh = options.map.mesh,
                          .settings = settings,
                          .uv_file = atlas_mesh_name(request.layout, options.output)}));
    print_warnings(map->warnings);
    std::printf("%s: %s, %dx%d, %s to %s %s\n", printable_line(options.output).c_str(),
                std::string(map_kind_name(settings.kind)).c_str(), map->values.width, map->values.height,
                to_text(map->min).c_str(), to_text(map->max).c_str(), map->unit.c_str());
    print_path(map_preview_path(options.output));
    DERMIS_TRY(deliver_layout(request.scene, request.layout, options.output));
    return 0;
}

void add_common(Command* command, BakeMapsOptions& options) {
    BakeMapSettings& s = options.map.settings;
    const bool thickness = s.kind == MapKind::thickness;
    command->add_option("MESH", options.map.mesh, "mesh, scene file, scene name or builtin:NAME")->required();
    command
        ->add_output("-o,--output", options.output,
                     thickness
                         ? "file to write, .exr in mm, or .png: 8 bit, linear, 1 is --max-mm; FILE.json and "
                           "FILE_preview.png are written too"
                         : "file to write, .exr; FILE.exr.json and FILE_preview.png are written too")
        ->required();
    command->add_option("--size", s.size, kMapSizeRange, "side of the map in texels")->capture_default_str();
    command
        ->add_option("--gutter", s.gutter_texels, kMapGutterRange,
                     "width of the gutter around UV islands in texels")
        ->capture_default_str();
    command->add_option("--material", options.map.material, "bake this material only (default: all skin)");
    command->add_option("--uvs", options.map.uvs,
                        "file, or atlas: FILE_atlas.glb has it (default: the file's if no two places of the "
                        "skin share texels; with --material the file's)");
    command->add_option("--unit-mm", options.map.unit_mm, kUnitRangeMm,
                        "length of one unit of the mesh file in mm");
    options.map.pose.add_to(*command);
}

void add_rays(Command* command, BakeMapSettings& s) {
    command->add_option("--rays", s.rays, {1, 4096}, "rays for each texel")->capture_default_str();
    command
        ->add_option("--ray-size", s.ray_size, {16, 16384},
                     "maximum side of the grid on which rays are traced, in texels")
        ->capture_default_str();
    command
        ->add_option("--max-mm", s.max_mm, {0, 1e6},
                     "thickness where the mesh is open; for occlusion the maximum distance (0: no limit)")
        ->capture_default_str();
}

void add_map(CommandLine& line, Command* group, MapKind kind, const std::string& summary,
             const std::string& example) {
    auto options = std::make_shared<BakeMapsOptions>();
    BakeMapSettings& s = options->map.settings;
    s = usual_map_settings(kind);
    const bool depth = kind == MapKind::thickness || kind == MapKind::kernel_size;
    Command* command = line.add(std::string(map_kind_name(kind)), summary, example, group);
    add_common(command, *options);
    if (depth || kind == MapKind::occlusion) add_rays(command, s);
    if (depth)
        command
            ->add_option("--cone-rad", s.cone_rad, {0, 1.5},
                         "half angle of the cone of inward rays in radians")
            ->capture_default_str();
    if (kind == MapKind::curvature)
        command
            ->add_option("--smoothing-mm", s.smoothing_mm, {0, 100},
                         "averages features narrower than about twice this")
            ->capture_default_str();
    if (kind == MapKind::gain)
        command
            ->add_option("--walks-per-mm2", s.walks_per_mm2, {0.1, 10000},
                         "random walks that start on each mm^2 of the skin")
            ->capture_default_str();
    if (kind == MapKind::kernel_size || kind == MapKind::gain)
        command->add_option("--profile", options->map.profile, "diffusion profile instead of the scene's");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace

void add_bake_maps_command(CommandLine& line) {
    Command* group = bake_group(line);
    add_map(line, group, MapKind::curvature, "Curvature in 1/mm: mean, and how it differs by direction",
            "dermis bake curvature head_scan -o curvature.exr");
    add_map(line, group, MapKind::thickness, "Thickness of the body behind the surface in mm",
            "dermis bake thickness head_scan -o thickness.exr");
    add_map(line, group, MapKind::kernel_size, "Kernel size for texture_space, from thickness and profile",
            "dermis bake kernel-size head_scan --profile gpu_gems_3 -o kernel.exr");
    add_map(line, group, MapKind::stretch,
            "Stretch: mm per unit of u and of v, and the cosine between both directions",
            "dermis bake stretch head_scan -o stretch.exr");
    add_map(line, group, MapKind::occlusion, "Occlusion: cosine-weighted visibility of the environment",
            "dermis bake occlusion head_scan -o occlusion.exr");
    add_map(line, group, MapKind::gain, "Gain: uniform light that each place returns, over flat skin",
            "dermis bake gain head_scan --profile openpbr_skin_3 -o gain.exr");
}

}  // namespace dermis::cli
