#include "dermis/rays/map_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"

namespace dermis::inline rays {
namespace {

constexpr float kGainPreview = 0.5f;  // grey of flat skin
constexpr Vec3 kBackground = {0.02f, 0.02f, 0.02f};

bool is_engine_map(const std::filesystem::path& path, MapKind kind) {
    return kind == MapKind::thickness && to_lower(path.extension().string()) == ".png";
}

// 8 bit, linear, the same in red, green and blue; 1 is `max_mm`, and what holds no skin: smaller mip levels
// mix it in.
Image engine_map(const BakedMap& map, float max_mm) {
    Image picture(map.values.width, map.values.height, 3, PixelFormat::u8, Encoding::linear);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const bool is_empty = map.coverage.at(x, y, 0) == 0 && map.values.at(x, y, 0) == 0;
            const float part = is_empty ? 1 : std::clamp(map.values.at(x, y, 0) / max_mm, 0.0f, 1.0f);
            for (int c = 0; c < 3; ++c) picture.set(x, y, c, part);
        }
    return picture;
}

std::string sidecar_text(const BakedMap& map, const MapOrigin& origin, bool is_png) {
    const BakeMapSettings& s = origin.settings;
    nlohmann::ordered_json json = {{"kind", map_kind_name(map.kind)},
                                   {"unit", map.unit},
                                   {"width", map.values.width},
                                   {"height", map.values.height},
                                   {"channels", map.values.channels},
                                   {"v_origin", "top"},
                                   {"encoding", "linear"},
                                   {"range", {map.min, map.max}},
                                   {"gutter_texels", s.gutter_texels},
                                   {"mesh", origin.mesh}};
    json["uvs"] = origin.uv_file.empty() ? "of the mesh" : "TEXCOORD_1 of " + origin.uv_file;
    if (is_png) json["value_1_mm"] = s.max_mm;
    if (s.material) json["material"] = *s.material;
    switch (map.kind) {
        case MapKind::curvature:
            json["sign"] = "positive where convex";
            json["channel_values"] = {
                "mean curvature", "half of: curvature along the tangent less curvature along the bitangent",
                "twist: turn of the normal towards the tangent on the way along the bitangent"};
            json["smoothing_mm"] = s.smoothing_mm;
            break;
        case MapKind::kernel_size:
            json["profile"] = s.profile->name;
            json["spread_mm"] = spread_radius_mm(*s.profile);
            [[fallthrough]];
        case MapKind::thickness:
            json["cone_rad"] = s.cone_rad;
            [[fallthrough]];
        case MapKind::occlusion:
            json["rays"] = s.rays;
            json["max_mm"] = s.max_mm;
            break;
        case MapKind::gain:
            json["meaning"] = "uniform light that skin returns, over flat skin: red, green, blue";
            json["profile"] = s.profile->name;
            json["walks_per_mm2"] = s.walks_per_mm2;
            json["noise"] = {map.noise.x, map.noise.y, map.noise.z};
            break;
        case MapKind::stretch:
            break;
    }
    json["tool"] = "dermis " DERMIS_VERSION;
    return json.dump(2) + "\n";
}

// The 98th percentile of the absolute value: a few outliers must not darken the rest.
float full_scale(const BakedMap& map) {
    std::vector<float> values;
    const auto channels = size_t(map.values.channels);
    for (size_t i = 0; i < map.values.pixel_count(); ++i)
        if (map.coverage.bytes[i] != std::byte{0})
            values.push_back(std::abs(map.values.floats()[i * channels]));
    if (values.empty()) return 1;
    const auto at = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.98);
    std::nth_element(values.begin(), at, values.end());
    return std::max(*at, 1e-12f);
}

// White at 0; equally light on both sides.
Vec3 diverging(float t) {
    const Vec3 white{0.9f, 0.9f, 0.9f}, convex{0.6f, 0.04f, 0.03f}, concave{0.03f, 0.12f, 0.6f};
    const Vec3 end = t > 0 ? convex : concave;
    return white + (end - white) * std::min(std::abs(t), 1.0f);
}

constexpr MapKind kMapKinds[] = {MapKind::curvature, MapKind::thickness, MapKind::kernel_size,
                                 MapKind::stretch,   MapKind::occlusion, MapKind::gain};

// The sidecar of a map; null where there is none.
nlohmann::json sidecar_of(const std::filesystem::path& path) {
    const Result<std::string> text = read_text_file(map_sidecar_path(path));
    if (!text) return {};
    nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
    const auto is_kind = [&](MapKind kind) { return json["kind"] == map_kind_name(kind); };
    const bool is_map = json.is_object() && json.contains("kind") && std::ranges::any_of(kMapKinds, is_kind);
    return is_map ? json : nlohmann::json{};
}

}  // namespace

std::filesystem::path map_sidecar_path(const std::filesystem::path& path) {
    return path.string() + ".json";
}

std::filesystem::path map_preview_path(const std::filesystem::path& path) {
    return path.parent_path() / (path.stem().string() + "_preview.png");
}

Image map_preview(const BakedMap& map) {
    const float scale = full_scale(map);
    Image picture(map.values.width, map.values.height, 3);
    const auto channels = size_t(map.values.channels);
    for (size_t i = 0; i < picture.pixel_count(); ++i) {
        const float* value = &map.values.floats()[i * channels];
        Vec3 color = kBackground;
        if (map.coverage.bytes[i] != std::byte{0} && map.kind == MapKind::gain) {
            color = Vec3{value[0], value[1], value[2]} * kGainPreview;
        } else if (map.coverage.bytes[i] != std::byte{0}) {
            const float t = value[0] / scale;
            color = map.kind == MapKind::curvature ? diverging(t)
                                                   : Vec3{t, channels == 3 ? value[1] / scale : t, t};
        }
        float* to = &picture.floats()[3 * i];
        to[0] = color.x;
        to[1] = color.y;
        to[2] = color.z;
    }
    return convert(picture, PixelFormat::u8, Encoding::srgb);
}

Result<std::optional<std::string>> describe_map(const std::filesystem::path& path) {
    const nlohmann::json json = sidecar_of(path);
    if (json.is_null()) return std::optional<std::string>();
    DERMIS_TRY_ASSIGN(const LoadedImage loaded, read_image(path, ImageUse::data));
    const Image& image = loaded.image;
    const auto number = [&](const char* name) {
        return json.contains(name) && json[name].is_number() ? json[name].get<double>() : -1.0;
    };
    if (number("width") != image.width || number("height") != image.height ||
        number("channels") != image.channels)
        return Error{path.string() + ": its size is not that in " + map_sidecar_path(path).string() +
                     "; bake the map again"};
    const auto text = [&](const char* name) {
        return json.contains(name) && json[name].is_string() ? json[name].get<std::string>() : std::string();
    };
    std::string line = "a map of " + text("kind") + " over the UVs of " + text("mesh") + ", unit " +
                       text("unit") + ", " + std::to_string(image.width) + "x" + std::to_string(image.height);
    if (const std::string profile = text("profile"); !profile.empty()) line += ", for profile " + profile;
    return std::optional(line);
}

Result<void> check_map_path(const std::filesystem::path& path, const BakeMapSettings& settings) {
    const bool is_png = is_engine_map(path, settings.kind);
    if (!is_png && to_lower(path.extension().string()) != ".exr")
        return Error{path.string() + ": maps are written as .exr (a preview .png comes beside it)" +
                     (settings.kind == MapKind::thickness ? ", thickness as .png too" : "")};
    if (is_png && settings.max_mm <= 0)
        return Error{path.string() + ": max_mm is the thickness of a value of 1, and has to be above 0"};
    return {};
}

Result<void> write_map(const std::filesystem::path& path, const BakedMap& map, const MapOrigin& origin) {
    if (Result<void> good = check_map_path(path, origin.settings); !good) return good;
    const bool is_png = is_engine_map(path, map.kind);
    const std::string text = sidecar_text(map, origin, is_png);
    const std::filesystem::path preview_path = map_preview_path(path);
    const Result<std::vector<std::byte>> picture =
        is_png ? encode_image(".png", engine_map(map, origin.settings.max_mm))
               : encode_image(".exr", convert(map.values, PixelFormat::f16, Encoding::linear),
                              {{"dermis", text}});
    if (!picture) return Error{path.string() + ": " + picture.error().message};
    const Result<std::vector<std::byte>> preview = encode_image(".png", map_preview(map));
    if (!preview) return Error{preview_path.string() + ": " + preview.error().message};
    const FileContent files[] = {
        {path, *picture}, {map_sidecar_path(path), as_bytes(text)}, {preview_path, *preview}};
    return write_files(files);
}

}  // namespace dermis::inline rays
