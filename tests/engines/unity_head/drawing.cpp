// Frame: the package's ShadowCaster pass into a map, then its ForwardLit pass. What URP gives is in
// tests/engines/urp; its numbers are computed here as SkinHead.cs and URP would set them.

#include "engines/unity_head/drawing.h"

#include <cmath>
#include <regex>

#include "dermis/base/angle.h"
#include "dermis/base/file.h"
#include "engines/unity_head/package.h"
#include "engines/unity_head/sky.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis::unity_head {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace drawn_head;

// SkinHead.cs has the same.
constexpr float kNear = 0.05f, kFar = 20;
constexpr int kShadowSide = 4096;

Vec3 mirrored(const json& numbers) {
    return {-float(numbers[0]), float(numbers[1]), float(numbers[2])};
}
Vec3 metres(const json& lengths_mm) {
    return mirrored(lengths_mm) * 1e-3f;
}
Vec4 row(Vec3 direction, float offset) {
    return {direction.x, direction.y, direction.z, offset};
}

// The words of the package's passes.
Result<std::vector<uint32_t>> compiled(const fs::path& package, const fs::path& scratch,
                                       const std::string& name) {
    const bool is_head = name.starts_with("head"), is_vertex = name.ends_with(".vert");
    const std::string entry = is_head     ? is_vertex ? "SkinHeadVertex" : "SkinHeadFragment"
                              : is_vertex ? "SkinShadowVertex"
                                          : "SkinDepthFragment";
    const std::string text =
        is_head ? "#include \"SkinHeadForward.hlsl\"\n"
                : "#include \"SkinHeadInput.hlsl\"\n#include \"../Runtime/SkinDepth.hlsl\"\n";
    return compiled_hlsl(scratch, name, text,
                         {"-D" + entry + "=main", "-D_MAIN_LIGHT_SHADOWS", "-I", scratch.string(), "-I",
                          (package / "Head").string()});
}

gpu::Values camera_values(const json& settings) {
    const json& camera = settings["camera"];
    const Vec3 eye = metres(camera["eye_mm"]), forward = normalize(metres(camera["target_mm"]) - eye);
    const Vec3 right = normalize(cross(mirrored(camera["up"]), forward)), up = cross(forward, right);
    gpu::Values values = view_values({.eye = eye,
                                      .right = right,
                                      .up = up,
                                      .forward = forward,
                                      .vertical_fov_rad = camera["vertical_fov_rad"],
                                      .near = kNear,
                                      .far = kFar});
    // The packing of SphericalHarmonicsL2 in URP's shaders.
    const json& probe = settings["environment"]["ambient_probe"];
    const char* const channels[] = {"r", "g", "b"};
    for (size_t c = 0; c < 3; ++c) {
        const auto at = [&](size_t i) { return float(probe[3 * i + c]); };
        values["unity_SHA" + std::string(channels[c])] = Vec4{at(3), at(1), at(2), at(0) - at(6)};
        values["unity_SHB" + std::string(channels[c])] = Vec4{at(4), at(5), 3 * at(6), at(7)};
    }
    values["unity_SHC"] = Vec4{float(probe[24]), float(probe[25]), float(probe[26]), 1};
    return values;
}

// URP covers the sphere around the part of the camera's view that has shadows. Towards the light the map
// reaches farther.
gpu::Values shadow_values(const json& settings, Vec3 to_light) {
    const json& camera = settings["camera"];
    const Vec3 eye = metres(camera["eye_mm"]), forward = normalize(metres(camera["target_mm"]) - eye);
    const float bounds = float(settings["bounds"]["radius_mm"]) * 1e-3f;
    const float distance = length(eye - metres(settings["bounds"]["center_mm"])) + bounds;
    const float across = std::tan(0.5f * float(camera["vertical_fov_rad"])), spread = 2 * across * across;
    // Farthest corners of a square view are as far from the centre as the nearest ones, or at the far end.
    const float centre_at = std::min(0.5f * (distance + kNear) * (1 + spread), distance);
    const float radius =
        std::sqrt((distance - centre_at) * (distance - centre_at) + spread * distance * distance);
    const Vec3 centre = eye + forward * centre_at,
               up = std::abs(to_light.y) < 0.99f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 x = normalize(cross(up, to_light)), y = cross(to_light, x);
    const float half = 0.5f / radius, reach = radius + 2 * bounds, deep = 0.5f / reach;
    return {
        {"stub_shadow_0", row(x * half, 0.5f - dot(x, centre) * half)},
        {"stub_shadow_1", row(y * half, 0.5f - dot(y, centre) * half)},
        {"stub_shadow_2", row(to_light * -deep, 0.5f + dot(to_light, centre) * deep)},
        {"_MainLightShadowmapSize", Vec4{1.0f / kShadowSide, 1.0f / kShadowSide, kShadowSide, kShadowSide}},
        {"stub_shadow_bias", Vec4{0, 0, 0, 0}}};
}

// The same rows as a camera of the light: 0 to 1 becomes -1 to 1.
gpu::Values light_camera(const gpu::Values& shadow, gpu::Values camera) {
    for (const char* axis : {"0", "1"}) {
        const Vec4 v = std::get<Vec4>(shadow.at(std::string("stub_shadow_") + axis));
        camera[std::string("stub_clip_") + axis] = Vec4{2 * v.x, 2 * v.y, 2 * v.z, 2 * v.w - 1};
    }
    camera["stub_clip_2"] = shadow.at("stub_shadow_2");
    camera["stub_clip_3"] = Vec4{0, 0, 0, 1};
    return camera;
}

Result<void> spoil(const std::string& mistake, Material& material, std::vector<Primitive>& primitives) {
    if (mistake.empty() || mistake == "srgb") return {};
    if (mistake == "normals") {
        for (const char* name : {"_NormalsRed", "_NormalsGreen", "_NormalsSpread"})
            material.pictures.erase(name);
        return {};
    }
    if (mistake == "reflections") {
        material.pictures.erase("_ReflectedShares");
        return {};
    }
    if (mistake == "frames") {
        material.values["_Moves"] = {0};
        return {};
    }
    if (mistake != "curvature") return Error{"no mistake is named '" + mistake + "'"};
    for (Primitive& one : primitives)
        for (const char* name : {"TEXCOORD2", "TEXCOORD3"})
            for (size_t i = 0; i < one.attributes[name].size(); ++i) {
                float& value = one.attributes[name][i];
                const bool is_second = i % 2 == 1;
                if (is_second && name == std::string("TEXCOORD3")) continue;  // an occlusion
                value = is_second ? 1 - (1 - value) * 1000 : value * 1000;
            }
    return {};
}

Result<void> add_textures(gpu::Device& device, const Material& material, const std::string& mistake,
                          Uploads& uploads, gpu::Draw& draw, gpu::Values& block) {
    for (const auto& [name, standard] : material.standard_pictures) {
        gpu::TextureData data = standard_picture(standard);
        if (const auto found = material.pictures.find(name); found != material.pictures.end()) {
            DERMIS_TRY_ASSIGN(data, import_picture(found->second));
            // Of pictures of 8 bits: Unity has no sRGB floats.
            if (mistake == "srgb" && name.starts_with("_Normals"))
                data.srgb = data.format == ImageFormat::rgba8;
        }
        block[name + "_TexelSize"] =
            Vec4{1.0f / float(data.width), 1.0f / float(data.height), float(data.width), float(data.height)};
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(device, data));
        draw.textures[name] = &uploads.textures.emplace_back(std::move(texture));
    }
    return {};
}

// Streams by the shader's names, which glslc writes as "input.uv".
Result<gpu::Geometry> uploaded(gpu::Device& device, const fs::path& package, const Primitive& primitive) {
    DERMIS_TRY_ASSIGN(std::string text, read_text_file(package / "Head/SkinHeadForward.hlsl"));
    text = text.substr(text.find("struct SkinHeadAttributes"));
    text.resize(text.find("};"));
    std::vector<gpu::VertexStream> streams;
    const std::regex attribute(" (\\w+) : (\\w+);");
    for (std::sregex_iterator i(text.begin(), text.end(), attribute), end; i != end; ++i) {
        const std::string semantic = (*i)[2];
        const auto found = primitive.attributes.find(semantic);
        if (found == primitive.attributes.end()) {
            if (semantic != "TEXCOORD6" && semantic != "TEXCOORD7")
                return Error{"the mesh has no " + semantic};
            // Of a mesh that does not move. Unity reads zeros there.
            const size_t count = primitive.attributes.at("POSITION").size() / 4;
            streams.push_back({"input." + (*i)[1].str(), 2, std::vector<float>(2 * count)});
            continue;
        }
        streams.push_back({"input." + (*i)[1].str(), primitive.components.at(semantic), found->second});
    }
    return gpu::Geometry::upload(device, primitive.material, streams, primitive.indices);
}

Result<std::vector<gpu::Draw>> head_draws(gpu::Device& device, const json& scene, const Settings& settings,
                                          Uploads& uploads) {
    std::vector<gpu::Draw> draws;
    for (const json& object : scene["objects"]) {
        DERMIS_TRY_ASSIGN(std::vector<Primitive> primitives,
                          import_glb(settings.package / "Head" / std::string(object["file"]),
                                     {settings.clip, settings.time_s}));
        for (const json& surface : object["materials"]) {
            if (surface["class"] != "skin") continue;
            DERMIS_TRY_ASSIGN(Material material, make_material(settings.package, scene, object, surface));
            material.values["_CurvedGain"] = {settings.gain ? 1.0f : 0.0f};
            material.values["_Scattering"] = {settings.lambert ? 0.0f : 1.0f};
            DERMIS_TRY(spoil(settings.mistake, material, primitives));
            gpu::Draw draw;
            gpu::Values block = {{"_BaseMap_ST", Vec4{1, 1, 0, 0}}};
            DERMIS_TRY(add_textures(device, material, settings.mistake, uploads, draw, block));
            for (const auto& [name, value] : material.values)
                block[name] = value.size() == 1 ? ShaderValue(value[0])
                                                : ShaderValue(Vec4{value[0], value[1], value[2], 1});
            draw.values = block;
            for (const Primitive& one : primitives) {
                if (one.material != std::string(surface["name"])) continue;
                DERMIS_TRY_ASSIGN(gpu::Geometry mesh, uploaded(device, settings.package, one));
                if (object.contains("curvature_of_targets")) {
                    const gpu::TextureData weights =
                        target_weights(one, object["curvature_of_targets"]["targets"]);
                    DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(device, weights));
                    draw.textures["_TargetWeights"] = &uploads.textures.emplace_back(std::move(texture));
                    draw.values["_TargetCount"] = float(weights.width);
                }
                draw.geometry = &uploads.meshes.emplace_back(std::move(mesh));
                draw.index_count = uint32_t(one.indices.size());
                draws.push_back(draw);
            }
        }
    }
    return draws;
}

PassList passes(const json& settings) {
    const Pass shadow = {.name = "shadow",
                         .kind = PassKind::geometry_screen,
                         .vertex_shader = "shadow.vert",
                         .depth = DepthTarget{.image = "shadow_map"},
                         .profile = 1};  // its block StubCamera is StubCamera@1
    PassList list = head_pass(settings["background_linear"]);
    list.passes.front().reads = {{"_MainLightShadowmapTexture", "shadow_map"}};
    list.passes.insert(list.passes.begin(), shadow);
    list.images.push_back(
        {.name = "shadow_map", .format = ImageFormat::depth32f, .size = {kShadowSide, kShadowSide}});
    return list;
}

}  // namespace

Result<Image> draw_head(const Settings& settings) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(settings.package / "Head/scene.json"));
    const json scene = json::parse(text);
    const json& light = scene["lights"][0];
    if (scene["lights"].size() != 1 || light["kind"] != "directional" || scene["environment"].is_null())
        return Error{"only a head with one directional light and an environment can be drawn here"};
    const TemporaryDirectory scratch;
    const fs::path library = scratch.path / "Packages/com.unity.render-pipelines.universal/ShaderLibrary";
    fs::create_directories(library);
    for (const char* name : {"Core.hlsl", "Lighting.hlsl", "Shadows.hlsl"})
        fs::copy_file(fs::path(DERMIS_SOURCE_DIR "/tests/engines/urp") / name, library / name);

    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({}));
    Uploads uploads;
    const Vec3 to_light = mirrored(light["to_light"]);
    gpu::FrameInputs frame;
    DERMIS_TRY_ASSIGN(frame.draws, head_draws(device, scene, settings, uploads));
    frame.blocks["StubCamera"] = camera_values(scene);
    frame.blocks["StubCamera@1"] = light_camera(shadow_values(scene, to_light), camera_values(scene));
    frame.blocks["StubShadow"] = shadow_values(scene, to_light);
    frame.blocks["$Global"] = {{"_LightDirection", to_light}, {"_LightPosition", Vec3{}}};
    const json& color = light["color_linear"];
    const float over_pi = float(light["intensity"]) / kPi;
    frame.blocks["StubLight"] = {
        {"stub_light_direction", row(to_light, 0)},
        {"stub_light_color", row(Vec3{float(color[0]), float(color[1]), float(color[2])} * over_pi, 0)}};

    DERMIS_TRY_ASSIGN(const gpu::TextureData sky, sky_cube(settings.package, scene));
    DERMIS_TRY_ASSIGN(gpu::Texture sky_texture, gpu::Texture::upload(device, sky));
    frame.textures["unity_SpecCube0"] = &uploads.textures.emplace_back(std::move(sky_texture));

    const auto shaders = [&](std::string_view name) {
        return compiled(settings.package, scratch.path, std::string(name));
    };
    return drawn(device, shaders, passes(scene), std::move(frame), settings);
}

}  // namespace dermis::unity_head
