// glTF 2.0 materials (section 3.9) with the extensions that describe translucent bodies.

#include "dermis/mesh/gltf/material.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "dermis/base/file.h"
#include "dermis/base/text.h"

namespace dermis::inline mesh::gltf {
namespace {

// Embedded images are copied into every material that uses them; a small file must not fill the memory that
// way.
constexpr size_t kMaxEmbeddedBytes = size_t{1} << 30;
constexpr double kAnyLength = std::numeric_limits<float>::max();

class MaterialReader {
  public:
    MaterialReader(Document& document, double mm_per_unit) : document_(document), mm_per_unit_(mm_per_unit) {}

    Material read(const JsonView& source, size_t index, double node_scale) {
        Material material;
        mapping_ = uv_mapping_of_material(document_, source);
        material.name = source["name"].text("");
        if (material.name.empty()) material.name = "material " + std::to_string(index);
        read_core(source, material);
        const JsonView extensions = source["extensions"];
        if (extensions.exists())
            read_surface(extensions, material), read_body(extensions, material, node_scale);
        return material;
    }

  private:
    static float number(const JsonView& view, double fallback, double low, double high) {
        const double value = view.number(fallback);
        if (value >= low && value <= high) return float(value);
        warn_of_range(view, low, high);
        return float(std::clamp(value, low, high));
    }

    static void warn_of_range(const JsonView& view, double low, double high) {
        const std::string range =
            high == kAnyLength ? to_text(low) + " or more" : to_text(low) + " to " + to_text(high);
        view.warn("is outside of its range, " + range + "; clamped");
    }

    // Channels of 0 to 1.
    template <size_t N>
    static std::array<float, N> channels(const JsonView& view, std::array<double, N> fallback) {
        std::array<float, N> read{};
        const auto given = view.numbers<N>(fallback);
        for (size_t c = 0; c < N; ++c) read[c] = float(std::clamp(given[c], 0.0, 1.0));
        if (std::ranges::any_of(given, [](double value) { return value < 0 || value > 1; }))
            warn_of_range(view, 0, 1);
        return read;
    }

    static Vec3 color(const JsonView& view, Vec3 fallback) {
        const auto c = channels<3>(view, {fallback.x, fallback.y, fallback.z});
        return {c[0], c[1], c[2]};
    }

    void read_core(const JsonView& source, Material& material) {
        const JsonView pbr = source["pbrMetallicRoughness"];
        auto base = channels<4>(pbr["baseColorFactor"], {1, 1, 1, 1});
        if (read_map(pbr["baseColorTexture"], "baseColorFactor", material.base_color_map))
            material.base_color_linear = {base[0], base[1], base[2]};
        else
            base[3] = 1;
        material.base_color_stated = pbr["baseColorFactor"].exists();
        if (read_map(pbr["metallicRoughnessTexture"], "metallicFactor and roughnessFactor",
                     material.metallic_roughness_map)) {
            material.metallic = number(pbr["metallicFactor"], 1, 0, 1);
            material.roughness = number(pbr["roughnessFactor"], 1, 0, 1);
        }
        if (read_map(source["normalTexture"], "", material.normal_map))
            material.normal_scale = float(source["normalTexture"]["scale"].number(1));
        const JsonView occlusion = source["occlusionTexture"];
        if (read_map(occlusion, "", material.occlusion_map) && occlusion["strength"].number(1) != 1)
            occlusion["strength"].warn("is not read; the map has its full strength");
        if (read_map(source["emissiveTexture"], "emissiveFactor", material.emission_map))
            material.emission_linear = color(source["emissiveFactor"], {0, 0, 0});
        material.double_sided = source["doubleSided"].boolean(false);
        read_alpha(source, base[3], material);
    }

    static void read_alpha(const JsonView& source, float factor, Material& material) {
        const std::string mode = source["alphaMode"].text("OPAQUE");
        if (mode == "MASK") material.alpha_mode = AlphaMode::mask;
        if (mode == "BLEND") material.alpha_mode = AlphaMode::blend;
        if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
            source["alphaMode"].warn("'" + mode.substr(0, 20) + "' is not OPAQUE, MASK or BLEND; opaque");
        material.alpha_cutoff = float(source["alphaCutoff"].number(0.5));
        // Opaque surfaces ignore the factor's alpha as they do the map's.
        if (material.alpha_mode != AlphaMode::opaque) material.opacity = factor;
    }

    void read_surface(const JsonView& extensions, Material& material) {
        const JsonView specular = extensions["KHR_materials_specular"];
        if (read_map(specular["specularTexture"], "specularFactor", material.specular_map))
            material.specular = number(specular["specularFactor"], 1, 0, 1);
        if (const Vec3 tint = read_color_without_map(specular, "specularColor", {1, 1, 1});
            tint != Vec3{1, 1, 1})
            specular["specularColorFactor"].warn("is not read; reflections are white");
        // 0 means "no Fresnel at all", which no material here has.
        const JsonView ior = extensions["KHR_materials_ior"]["ior"];
        const double eta = ior.number(1.5);
        if (eta >= 1)
            material.ior = float(eta);
        else
            ior.warn("is below 1; not used");
        material.emission_linear *= number(extensions["KHR_materials_emissive_strength"]["emissiveStrength"],
                                           1, 0, double(kMostEmission));
    }

    void read_body(const JsonView& extensions, Material& material, double node_scale) {
        const JsonView volume = extensions["KHR_materials_volume"];
        const JsonView transmission = extensions["KHR_materials_diffuse_transmission"];
        const JsonView old_scatter = extensions["KHR_materials_volume_scatter"];
        const JsonView scatter = extensions["KHR_materials_scatter"];
        if (!volume.exists() && !transmission.exists() && !old_scatter.exists() && !scatter.exists()) return;
        Material::Scattering body;
        if (read_map(volume["thicknessTexture"], "thicknessFactor", material.thickness_map))
            body.thickness_mm =
                float(number(volume["thicknessFactor"], 0, 0, kAnyLength) * node_scale * mm_per_unit_);
        material.thickness_scale_mm = body.thickness_mm;
        body.attenuation_color = color(volume["attenuationColor"], {1, 1, 1});
        body.attenuation_distance_mm =
            float(number(volume["attenuationDistance"], 0, 0, kAnyLength) * mm_per_unit_);
        if (read_map(transmission["diffuseTransmissionTexture"], "diffuseTransmissionFactor",
                     material.transmission_map))
            body.diffuse_transmission = number(transmission["diffuseTransmissionFactor"], 0, 0, 1);
        body.diffuse_transmission_color =
            read_color_without_map(transmission, "diffuseTransmissionColor", {1, 1, 1});
        if (old_scatter.exists()) read_scatter(old_scatter, {0, 0, 0}, body);
        if (scatter.exists()) {
            read_scatter(scatter, {1, 1, 1}, body);
            body.scatter_strength = number(scatter["scatterStrengthFactor"], 0, 0, 1);
        }
        material.scattering = body;
    }

    static void read_scatter(const JsonView& scatter, Vec3 absent, Material::Scattering& body) {
        // The factor was called multiscatterColor in the first draft, and files keep that key.
        const JsonView old_key = scatter["multiscatterColor"];
        body.multiscatter_color =
            read_color_without_map(scatter, "multiscatterColor", color(old_key, absent));
        body.anisotropy = number(scatter["scatterAnisotropy"], 0, -1, 1);
    }

    // A colour NAMEFactor whose map NAMETexture is not read here.
    static Vec3 read_color_without_map(const JsonView& owner, const std::string& name, Vec3 absent) {
        const std::string factor = name + "Factor", map = name + "Texture";
        if (!owner[map.c_str()].exists()) return color(owner[factor.c_str()], absent);
        leave_out(owner[map.c_str()], "is not read", factor);
        return absent;
    }

    // The image behind a textureInfo object. A map that is left out takes `factors` with it, which is then
    // false: what they multiply is not known. One warning names both.
    bool read_map(const JsonView& info, std::string_view factors, ImageSource& map) {
        if (!info.exists()) return true;
        std::string reason = reason_to_leave_out(info);
        if (info.failed()) return false;
        if (reason.empty()) {
            map = texture(info);
            if (map.present() || info.failed()) return true;
            reason = "is empty";
        }
        leave_out(info, reason, factors);
        return false;
    }

    static void leave_out(const JsonView& info, const std::string& reason, std::string_view factors) {
        const bool several = factors.find(' ') != std::string_view::npos;
        info.warn(reason + "; not used" +
                  (factors.empty() ? "" : (several ? ", nor are " : ", nor is ") + std::string(factors)));
    }

    std::string reason_to_leave_out(const JsonView& info) {
        const UvMapping mapping = uv_mapping(info);
        if (!has_picture(document_, info)) return "has no PNG or JPEG source";
        if (mapping.set != mapping_.set)
            return fmt::format("is for UV set {}, the material's first map for set {}", mapping.set,
                               mapping_.set);
        if (mapping != mapping_) return "has another KHR_texture_transform than the material's first map";
        return {};
    }

    ImageSource texture(const JsonView& info) {
        const JsonView chosen = document_.view()["textures"][size_t(info["index"].integer(0))];
        ImageSource found = image(document_.view()["images"][size_t(chosen["source"].integer(0))]);
        if (chosen["sampler"].exists()) {
            const JsonView sampler = document_.view()["samplers"][size_t(chosen["sampler"].integer(0))];
            if (sampler.failed()) return {};
            found.wrap_u = wrap(sampler["wrapS"]), found.wrap_v = wrap(sampler["wrapT"]);
        }
        return found;
    }

    static TextureWrap wrap(const JsonView& mode) {
        constexpr uint64_t kRepeat = 10497, kClamp = 33071, kMirror = 33648;
        const uint64_t number = mode.integer(kRepeat);
        if (number == kClamp) return TextureWrap::clamp;
        if (number == kMirror) return TextureWrap::mirror;
        if (number != kRepeat) mode.warn(std::to_string(number) + " is not a wrap mode; repeats");
        return TextureWrap::repeat;
    }

    ImageSource image(const JsonView& source) {
        if (source.failed()) return {};
        const std::string name = source["name"].text(""), uri = source["uri"].text("");
        if (source["bufferView"].exists()) {
            const auto bytes = buffer_view(document_, source["bufferView"].integer(0));
            return embedded(source, name, {bytes.begin(), bytes.end()});
        }
        if (uri.starts_with("data:")) {
            auto bytes = decode_data_uri(uri);
            if (!bytes) return source.fail("malformed data URI"), ImageSource{};
            return embedded(source, name, std::move(*bytes));
        }
        const std::string path = decode_percent(uri);
        if (!stays_inside(path))
            return source.fail("uri '" + path.substr(0, 200) + "' leaves the file's directory"),
                   ImageSource{};
        return {.name = (document_.directory / utf8_path(path)).generic_string(),
                .encoded = {},
                .named_by = document_.messages.file};
    }

    ImageSource embedded(const JsonView& source, const std::string& name, std::vector<std::byte> bytes) {
        if (source.failed()) return {};
        if (bytes.empty()) return {};
        embedded_bytes_ += bytes.size();
        if (embedded_bytes_ > kMaxEmbeddedBytes)
            return source.fail("more than 1 GiB of embedded images"), ImageSource{};
        return {.name = document_.messages.file + ":" + (name.empty() ? source.place() : name),
                .encoded = std::move(bytes)};
    }

    Document& document_;
    double mm_per_unit_;
    UvMapping mapping_;  // of the material being read
    size_t embedded_bytes_ = 0;
};

}  // namespace

std::vector<Material> read_materials(Document& document, double mm_per_unit,
                                     const std::vector<double>& node_scales) {
    MaterialReader reader(document, mm_per_unit);
    const JsonView sources = document.view()["materials"];
    std::vector<Material> materials;
    for (size_t i = 0; i < sources.size() && !document.messages.error; ++i)
        materials.push_back(reader.read(sources[i], i, i < node_scales.size() ? node_scales[i] : 1));
    return materials;
}

Vec2 UvMapping::apply(Vec2 uv) const {
    // Exact where nothing changes.
    if (rotation_rad == 0) return {float(uv.x * scale[0] + offset[0]), float(uv.y * scale[1] + offset[1])};
    const double u = uv.x * scale[0], v = uv.y * scale[1];
    const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
    return {float(c * u + s * v + offset[0]), float(-s * u + c * v + offset[1])};
}

UvMapping uv_mapping(const JsonView& info) {
    UvMapping mapping;
    mapping.set = info["texCoord"].integer(0);
    if (!info["extensions"].exists()) return mapping;
    const JsonView transform = info["extensions"]["KHR_texture_transform"];
    if (!transform.exists()) return mapping;
    mapping.offset = transform["offset"].numbers<2>({0, 0});
    mapping.scale = transform["scale"].numbers<2>({1, 1});
    mapping.rotation_rad = transform["rotation"].number(0);
    mapping.set = transform["texCoord"].integer(mapping.set);
    return mapping;
}

bool has_picture(Document& document, const JsonView& info) {
    const uint64_t index = info["index"].integer(UINT64_MAX);
    if (index == UINT64_MAX && !info.failed()) info.fail("has no index");
    if (info.failed()) return false;
    const JsonView chosen = document.view()["textures"][size_t(index)];
    return !chosen.failed() && chosen["source"].exists();
}

UvMapping uv_mapping_of_material(Document& document, const JsonView& material) {
    const JsonView pbr = material["pbrMetallicRoughness"], extensions = material["extensions"];
    std::vector<JsonView> infos = {pbr["baseColorTexture"], material["normalTexture"],
                                   pbr["metallicRoughnessTexture"], material["emissiveTexture"],
                                   material["occlusionTexture"]};
    if (extensions.exists()) {
        infos.push_back(extensions["KHR_materials_specular"]["specularTexture"]);
        infos.push_back(extensions["KHR_materials_volume"]["thicknessTexture"]);
        infos.push_back(extensions["KHR_materials_diffuse_transmission"]["diffuseTransmissionTexture"]);
    }
    for (const JsonView& info : infos)
        if (info.exists() && has_picture(document, info)) return uv_mapping(info);
    return {};
}

}  // namespace dermis::inline mesh::gltf
