// dermis info MESH: the content of a mesh file or of the meshes of a scene, and the quality of its UV layout
// for maps of skin.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/rays/flesh.h"
#include "dermis/scene/part_words.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
    SceneChoice scene;
    bool json = false;
};

struct NamedMesh {
    SceneObject object;
    std::vector<std::string> warnings;
    Flesh flesh = {};
};

const char* state_of(const ImageSource& image) {
    if (!image.encoded.empty()) return "embedded";
    if (!image.pixels.empty()) return "made by code";
    std::error_code ec;
    return std::filesystem::is_regular_file(image.name, ec) ? "found" : "missing";
}

struct Box {
    Vec3 low, high;
};

Box bounding_box(const Mesh& mesh) {
    Box box{mesh.positions_mm.front(), mesh.positions_mm.front()};
    for (const Vec3& p : mesh.positions_mm) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

size_t triangles_of(const Mesh& mesh, uint32_t material) {
    size_t count = 0;
    for (const Submesh& submesh : mesh.submeshes)
        if (submesh.material == material) count += submesh.index_count / 3;
    return count;
}

Json percentiles_json(const Percentiles& p) {
    return {{"p5", p.p5}, {"p50", p.p50}, {"p95", p.p95}};
}

Json uv_json(const UvReport& uv) {
    return {{"coverage", uv.coverage},
            {"overlap", uv.overlap},
            {"tiles", uv.tiles},
            {"charts", uv.charts},
            {"seam_length_mm", uv.seam_length_mm},
            {"area_mirrored", uv.area_mirrored},
            {"area_outside", uv.area_outside},
            {"degenerate_triangles", uv.degenerate_triangles},
            {"mm_per_texel_2048", percentiles_json(uv.mm_per_texel_2048)},
            {"anisotropy", percentiles_json(uv.anisotropy)}};
}

const FoundPart* part_of(const SceneObject& object, uint32_t material) {
    return material < object.parts.size() ? &object.parts[material] : nullptr;
}

Json material_json(const SceneObject& object, uint32_t i) {
    const Mesh& mesh = object.mesh;
    Json row = {{"name", mesh.materials[i].name}, {"triangles", triangles_of(mesh, i)}};
    if (const FoundPart* found = part_of(object, i)) {
        row["class"] = part_name(found->part);
        row["reason"] = found->reason;
        row["left_out"] = found->left_out;
    }
    if (!mesh.materials[i].profile.empty()) row["profile"] = mesh.materials[i].profile;
    if (mesh.materials[i].scatter != 1) row["scatter"] = mesh.materials[i].scatter;
    row["maps"] = Json::array();
    for (const NamedMap& map : maps_of(mesh.materials[i]))
        row["maps"].push_back(
            {{"kind", map.kind}, {"name", map.image->name}, {"state", state_of(*map.image)}});
    if (!mesh.uvs.empty() && row["triangles"] != 0) row["uv"] = uv_json(analyze_uvs(mesh, i));
    return row;
}

Json motion_json(const Motion& motion) {
    Json clips = Json::array();
    for (const ClipInfo& clip : motion.clips)
        clips.push_back({{"name", clip.name}, {"length_s", clip.length_s}, {"channels", clip.channels}});
    return {
        {"clips", clips}, {"targets", motion.targets}, {"skins", motion.skins}, {"joints", motion.joints}};
}

Json to_json(const NamedMesh& named) {
    const Mesh& mesh = named.object.mesh;
    const Flesh& flesh = named.flesh;
    const auto [low, high] = bounding_box(mesh);
    Json json = {{"vertices", mesh.positions_mm.size()},
                 {"triangles", mesh.triangle_count()},
                 {"unit_mm", named.object.unit_mm},
                 {"low_mm", {low.x, low.y, low.z}},
                 {"high_mm", {high.x, high.y, high.z}},
                 {"area_mm2", flesh.skin_area_mm2},
                 {"hidden_triangles", flesh.hidden_triangles},
                 {"hidden_area_mm2", flesh.hidden_area_mm2},
                 {"openings", flesh.mesh_openings},
                 {"materials", Json::array()},
                 {"warnings", named.warnings}};
    for (uint32_t i = 0; i < mesh.materials.size(); ++i)
        json["materials"].push_back(material_json(named.object, i));
    if (!named.object.motion.empty()) json["motion"] = motion_json(named.object.motion);
    if (!mesh.tensions.empty()) {
        const auto [least, most] = std::ranges::minmax(mesh.tensions);
        json["tension"] = {least, most};
    }
    return json;
}

void print_uv(const UvReport& uv) {
    std::string tiles;
    for (size_t i = 0; i < std::min<size_t>(uv.tiles.size(), 8); ++i)
        tiles += fmt::format(" {}", uv.tiles[i]);
    if (uv.tiles.size() > 8) tiles += " ...";
    fmt::print(
        "    UV            {:.1f} % of tile{} used, {:.2f} % of it overlapping, {} charts, {:.0f} mm of "
        "seams\n",
        100 * uv.coverage, tiles.empty() ? " (none)" : tiles, 100 * uv.overlap, uv.charts, uv.seam_length_mm);
    const Percentiles &t = uv.mm_per_texel_2048, &a = uv.anisotropy;
    fmt::print("    texel at 2048 {:.3f} / {:.3f} / {:.3f} mm (p5 / p50 / p95 of the surface)\n", t.p5, t.p50,
               t.p95);
    fmt::print("    stretch       {:.1f} / {:.1f} longest over shortest (p50 / p95)\n", a.p50, a.p95);
    if (uv.area_mirrored > 0)
        fmt::print("    mirrored      {:.1f} % of the surface\n", 100 * uv.area_mirrored);
    if (uv.area_outside > 0) fmt::print("    in no tile    {:.1f} % of the surface\n", 100 * uv.area_outside);
    if (uv.degenerate_triangles > 0)
        fmt::print("    degenerate    {} triangles without UV area\n", uv.degenerate_triangles);
}

void print_motion(const Motion& motion) {
    for (const ClipInfo& clip : motion.clips)
        fmt::print("  clip {}: {} s, {} channel{}\n", printable_line(clip.name),
                   to_text(float(clip.length_s)), clip.channels, clip.channels == 1 ? "" : "s");
    if (!motion.targets.empty())
        fmt::print("  {} morph targets: {}\n", motion.targets.size(),
                   printable_line(join(motion.targets, " ")));
    if (motion.joints > 0)
        fmt::print("  {} joint{} in {} skin{}\n", motion.joints, motion.joints == 1 ? "" : "s", motion.skins,
                   motion.skins == 1 ? "" : "s");
}

// The openings that the reference closes and the faces that it leaves out.
void print_flesh(const Flesh& flesh) {
    if (flesh.hidden_triangles > 0)
        fmt::print(
            "  hidden skin: {} triangles, {:.1f} of {:.1f} cm2, not visible from outside; the reference "
            "treats the cavities behind it as flesh\n",
            flesh.hidden_triangles, flesh.hidden_area_mm2 / 100, flesh.skin_area_mm2 / 100);
    if (flesh.mesh_openings > 0)
        fmt::print("  {} opening{} in the surface; the walks of the reference are reflected there\n",
                   flesh.mesh_openings, flesh.mesh_openings == 1 ? "" : "s");
}

void print_material(const SceneObject& object, uint32_t i) {
    const Material& material = object.mesh.materials[i];
    const size_t triangles = triangles_of(object.mesh, i);
    const FoundPart* found = part_of(object, i);
    if (triangles == 0 && !(found && found->left_out)) return;
    const std::string name = printable_line(material.name);
    if (triangles > 0)
        fmt::print("  {}: {} triangles\n", name, triangles);
    else
        fmt::print("  {}: left out: the file has no alpha for it\n", name);
    if (found)
        fmt::print("    class         {}: {}\n", part_name(found->part), printable_line(found->reason));
    if (!material.profile.empty()) fmt::print("    profile       {}\n", printable_line(material.profile));
    if (material.scatter != 1)
        fmt::print("    scatter       {} of its diffuse light\n", to_text(material.scatter));
    if (!object.mesh.uvs.empty() && triangles > 0) print_uv(analyze_uvs(object.mesh, i));
    for (const NamedMap& map : maps_of(material))
        fmt::print("    {:<13} {} ({})\n", map.kind, printable_line(map.image->name), state_of(*map.image));
}

void print_text(const std::string& path, const NamedMesh& named) {
    const Mesh& mesh = named.object.mesh;
    const auto [low, high] = bounding_box(mesh);
    const Vec3 size = high - low;
    fmt::print("{}\n  {} vertices, {} triangles", printable_line(path), mesh.positions_mm.size(),
               mesh.triangle_count());
    if (!named.object.parts.empty()) fmt::print(", one unit is {} mm", to_text(named.object.unit_mm));
    fmt::print(
        "\n  box {:.1f} x {:.1f} x {:.1f} mm, from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f})\n",
        size.x, size.y, size.z, low.x, low.y, low.z, high.x, high.y, high.z);
    print_flesh(named.flesh);
    print_motion(named.object.motion);
    if (!mesh.tensions.empty()) {
        const auto [least, most] = std::ranges::minmax(mesh.tensions);
        fmt::print("  tension {:.2f} to {:.2f} in this pose: ln of a vertex's area over that at rest\n",
                   least, most);
    }
    for (uint32_t i = 0; i < mesh.materials.size(); ++i) print_material(named.object, i);
    for (const std::string& warning : named.warnings) fmt::print("  warning: {}\n", printable_line(warning));
}

Result<std::vector<NamedMesh>> load_meshes(const InfoArguments& arguments) {
    DERMIS_TRY_ASSIGN(Scene scene, arguments.scene.load());
    DERMIS_TRY_ASSIGN(std::vector<Flesh> flesh, find_flesh(scene.objects));
    std::vector<NamedMesh> meshes;
    for (size_t i = 0; i < scene.objects.size(); ++i)
        meshes.push_back({.object = std::move(scene.objects[i]), .flesh = std::move(flesh[i])});
    if (!meshes.empty()) meshes.front().warnings = scene.warnings;
    return meshes;
}

Result<int> run_info(const InfoArguments& arguments) {
    DERMIS_TRY_ASSIGN(std::vector<NamedMesh> meshes, load_meshes(arguments));
    Json list = Json::array();
    for (const NamedMesh& mesh : meshes)
        if (arguments.json)
            list.push_back(to_json(mesh));
        else
            print_text(is_mesh_file(arguments.scene.name) ? arguments.scene.name : mesh.object.name, mesh);
    // JSON: an object for one mesh, an array for several.
    if (arguments.json)
        fmt::print("{}\n",
                   (list.size() == 1 ? list[0] : list).dump(1, ' ', false, Json::error_handler_t::replace));
    return 0;
}

}  // namespace

void add_info_command(CommandLine& line) {
    const auto arguments = std::make_shared<InfoArguments>();
    Command* command =
        line.add("info", "Describes a mesh or a scene: size, materials, maps, UV layout, warnings",
                 "dermis info head.obj --unit-mm 45");
    arguments->scene.add_to(*command)->required();
    command->add_flag("--json", arguments->json, "one JSON object on standard output");
    line.when_chosen(command, writes_nothing, [arguments] { return run_info(*arguments); });
}

}  // namespace dermis::cli
