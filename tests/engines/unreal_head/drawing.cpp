#include "engines/unreal_head/drawing.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/image/half.h"
#include "engines/drawn_head/glb.h"
#include "engines/unreal_head/graph.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis::unreal_head {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace drawn_head;

constexpr float kNearCm = 5, kFarCm = 2000;

Vec3 vector(const json& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

Result<json> run_script(const fs::path& plugin, const fs::path& scratch) {
    const fs::path said = scratch / "editor.json";
    if (run_program({"python3", "-B", DERMIS_SOURCE_DIR "/tests/engines/unreal_head/unreal.py",
                     (plugin / "Content/Python").string(), "import dermis_head; dermis_head.build()"},
                    said) != 0) {
        DERMIS_TRY_ASSIGN(const std::string text, read_text_file(said));
        return Error{"the script fails: " + text};
    }
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(said));
    return json::parse(text);
}

Result<const json*> actor_of(const json& editor, const std::string& kind) {
    for (const json& actor : editor["actors"])
        if (actor.value("kind", "") == kind) return &actor;
    return Error{"the script places no " + kind};
}

Result<gpu::Values> camera_values(const json& editor) {
    DERMIS_TRY_ASSIGN(const json* actor, actor_of(editor, "CameraActor"));
    const json& camera = (*actor)["camera_component"];
    const Vec3 forward = normalize(vector((*actor)["rotation"]["forward"]));
    const Vec3 right = normalize(cross(vector((*actor)["rotation"]["up"]), forward));
    // Unreal's field of view is across the picture.
    const float across = float(camera["field_of_view"]) * kRadiansPerDegree, aspect = camera["aspect_ratio"];
    return view_values({.eye = vector((*actor)["location"]),
                        .right = right,
                        .up = cross(forward, right),
                        .forward = forward,
                        .vertical_fov_rad = 2 * std::atan(std::tan(0.5f * across) / aspect),
                        .near = kNearCm,
                        .far = kFarCm});
}

// The mesh as Interchange has it: x, z, y in centimetres, texture coordinates as they are.
Result<void> add_streams(const Glb& glb, const json& primitive, std::vector<std::vector<float>>& kept,
                         std::vector<gpu::VertexStream>& streams) {
    for (const auto& [semantic, name, count] : {std::tuple("POSITION", "input.position", 3),
                                                {"NORMAL", "input.normal", 3},
                                                {"TANGENT", "input.tangent", 4},
                                                {"TEXCOORD_0", "input.uv_0", 2},
                                                {"TEXCOORD_1", "input.uv_1", 2}}) {
        const json& attributes = primitive["attributes"];
        const bool has_it = attributes.contains(semantic);
        if (!has_it && count != 4) return Error{"the mesh has no " + std::string(semantic)};
        // A mesh without tangents has no normal map in tangent space, so zeros do.
        const std::vector<float> given =
            has_it ? floats_of(glb, attributes[semantic])
                   : std::vector<float>(floats_of(glb, attributes["NORMAL"]).size() / 3 * 4);
        std::vector<float>& made = kept.emplace_back();
        const float scale = std::string_view(semantic) == "POSITION" ? 100.0f : 1.0f;
        for (size_t i = 0; i < given.size(); i += size_t(count)) {
            if (count == 2)
                made.insert(made.end(), {given[i], given[i + 1]});
            else
                made.insert(made.end(), {given[i] * scale, given[i + 2] * scale, given[i + 1] * scale});
        }
        streams.push_back({name, std::min(count, 3), made});
    }
    return {};
}

// By the settings that the script gave the asset.
Result<gpu::TextureData> texture_of(const json& editor, const std::string& path, const std::string& name,
                                    const std::string& mistake) {
    const json& asset = editor["assets"][path];
    if (!asset.contains("file") || (mistake == "normals" && name.starts_with("Normals")))
        return standard_picture("white");
    const std::string compression = asset["compression_settings"], mips = asset["mip_gen_settings"];
    if (compression != "TC_VECTOR_DISPLACEMENTMAP" && compression != "TC_HDR" && compression != "TC_BC7")
        return Error{path + ": " + compression + " is not modelled"};
    if (mips != "TMGS_SIMPLE_AVERAGE" && mips != "TMGS_NO_MIPMAPS")
        return Error{path + ": " + mips + " is not modelled"};
    const bool srgb = asset["srgb"] || (mistake == "srgb" && name.starts_with("Normals"));
    DERMIS_TRY_ASSIGN(gpu::TextureData data, imported_picture(fs::path(std::string(asset["file"])), srgb,
                                                              mips == "TMGS_SIMPLE_AVERAGE", false));
    if (mistake == "curvature" && name == "VertexBends") {
        auto* halves = reinterpret_cast<uint16_t*>(data.bytes.data());
        for (size_t i = 0; i < data.bytes.size() / 2; ++i)
            if (i % 4 != 3) halves[i] = to_half(1000 * from_half(halves[i]));  // the fourth is an occlusion
    }
    return data;
}

Result<gpu::Draw> material_draw(gpu::Device& device, const json& editor, const Graph& graph,
                                const Settings& settings, Uploads& uploads) {
    gpu::Draw draw;
    for (const auto& [name, path] : graph.textures) {
        DERMIS_TRY_ASSIGN(const gpu::TextureData data, texture_of(editor, path, name, settings.mistake));
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(device, data));
        draw.textures[name + "Map"] = &uploads.textures.emplace_back(std::move(texture));
    }
    for (const auto& [name, value] : graph.values)
        draw.values[name + "Value"] = value.is_array()
                                          ? ShaderValue(Vec4{value[0], value[1], value[2], value[3]})
                                          : ShaderValue(float(value));
    if (settings.mistake == "shadow")
        for (auto& [name, value] : draw.values)
            if (name.ends_with("ToLightValue")) value = Vec4{};
    if (settings.mistake == "reflections") draw.values["ReflectionLevelsValue"] = 0.0f;
    draw.values["ScatteringValue"] = settings.lambert ? 0.0f : 1.0f;
    draw.values["CurvedGainValue"] = settings.gain ? 1.0f : 0.0f;
    return draw;
}

struct Head {
    std::vector<gpu::Draw> draws;
    std::string fragment;
};

// All skin of a scene has the same text.
Result<void> add_mesh(gpu::Device& device, const json& editor, const json& mesh, const Settings& settings,
                      Uploads& uploads, Head& head) {
    DERMIS_TRY_ASSIGN(const Glb glb, read_glb(std::string(mesh["file"])));
    const json& primitives = glb.document["meshes"][0]["primitives"];
    for (size_t slot = 0; slot < primitives.size(); ++slot) {
        const json& material = mesh["static_materials"][slot];
        if (!material.contains("material_interface")) continue;
        DERMIS_TRY_ASSIGN(const Graph graph, material_graph(editor, material["material_interface"]["asset"]));
        if (!head.fragment.empty() && head.fragment != graph.fragment)
            return Error{"materials of skin differ in their text"};
        head.fragment = graph.fragment;
        DERMIS_TRY_ASSIGN(gpu::Draw draw, material_draw(device, editor, graph, settings, uploads));
        std::vector<std::vector<float>> kept;
        kept.reserve(5);
        std::vector<gpu::VertexStream> streams;
        DERMIS_TRY(add_streams(glb, primitives[slot], kept, streams));
        const std::vector<uint32_t> indices = integers_of(glb, primitives[slot]["indices"]);
        DERMIS_TRY_ASSIGN(gpu::Geometry geometry, gpu::Geometry::upload(device, "head", streams, indices));
        draw.geometry = &uploads.meshes.emplace_back(std::move(geometry));
        draw.index_count = uint32_t(indices.size());
        head.draws.push_back(draw);
    }
    return {};
}

}  // namespace

Result<Image> draw_head(const Settings& settings) {
    constexpr std::string_view kMistakes[] = {"", "normals", "curvature", "srgb", "shadow", "reflections"};
    if (std::ranges::count(kMistakes, settings.mistake) == 0)
        return Error{"no mistake is named '" + settings.mistake + "'"};
    const TemporaryDirectory scratch;
    const fs::path plugin = settings.package / "DermisSkin";
    DERMIS_TRY_ASSIGN(const json editor, run_script(plugin, scratch.path));
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({}));
    Uploads uploads;
    Head head;
    for (const json& actor : editor["actors"]) {
        if (!actor.contains("object")) continue;
        if (vector(actor["location"]) != Vec3{}) return Error{"a mesh is not at the origin"};
        DERMIS_TRY(add_mesh(device, editor, editor["assets"][std::string(actor["object"]["asset"])], settings,
                            uploads, head));
    }
    gpu::FrameInputs frame;
    frame.draws = head.draws;
    DERMIS_TRY_ASSIGN(frame.blocks["StubCamera"], camera_values(editor));
    const auto shaders = [&](std::string_view name) {
        return compiled_hlsl(scratch.path, std::string(name),
                             name == "head.vert" ? vertex_text() : head.fragment,
                             {"-I", (plugin / "Shaders").string()});
    };
    DERMIS_TRY_ASSIGN(const std::string scene, read_text_file(plugin / "Head/scene.json"));
    return drawn(device, shaders, head_pass(json::parse(scene)["background_linear"]), std::move(frame),
                 settings);
}

}  // namespace dermis::unreal_head
