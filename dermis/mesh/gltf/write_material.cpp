#include "dermis/mesh/gltf/write_material.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include "dermis/base/file.h"

namespace dermis::inline mesh::gltf {
namespace {

// By the first bytes; empty for anything else.
std::string mime_type(std::span<const std::byte> bytes) {
    const auto starts_with = [&](std::string_view magic) {
        return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
    };
    if (starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    return starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

class MaterialWriter {
  public:
    MaterialWriter(GlbContent& glb, std::span<const NamedImage> images) : glb_(glb) {
        for (const NamedImage& image : images) given_.emplace(image.name, image.encoded);
    }

    Result<void> run(std::span<const Material> materials) {
        Json list = Json::array();
        for (const Material& material : materials) list.push_back(material_json(material));
        glb_.root["materials"] = list;
        if (error_) return *error_;
        if (!extensions_.empty()) glb_.root["extensionsUsed"] = extensions_;
        return {};
    }

  private:
    Json material_json(const Material& m) {
        Json json;
        json["name"] = m.name;
        Json& pbr = json["pbrMetallicRoughness"];
        const Vec3 base = m.base_color_linear;
        pbr["baseColorFactor"] = {base.x, base.y, base.z, m.opacity};
        pbr["metallicFactor"] = m.metallic;
        pbr["roughnessFactor"] = m.roughness;
        add_texture(pbr, "baseColorTexture", m.base_color_map);
        add_texture(pbr, "metallicRoughnessTexture", m.metallic_roughness_map);
        // glTF has normal maps in tangent space only.
        if (m.normal_space == NormalSpace::tangent) add_texture(json, "normalTexture", m.normal_map);
        if (json.contains("normalTexture")) json["normalTexture"]["scale"] = m.normal_scale;
        add_texture(json, "occlusionTexture", m.occlusion_map);
        if (m.alpha_mode != AlphaMode::opaque)
            json["alphaMode"] = m.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
        if (m.alpha_mode == AlphaMode::mask) json["alphaCutoff"] = m.alpha_cutoff;
        if (m.double_sided) json["doubleSided"] = true;
        write_surface(m, json);
        if (m.scattering) write_body(m, *m.scattering, json);
        return json;
    }

    void write_surface(const Material& m, Json& json) {
        const Vec3 e = m.emission_linear;
        const float strength = std::max({1.0f, e.x, e.y, e.z});  // factors end at 1
        if (e != Vec3{}) json["emissiveFactor"] = array_of(e * (1 / strength));
        add_texture(json, "emissiveTexture", m.emission_map);
        if (strength > 1) extend(json, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
        if (m.ior != 1.5f) extend(json, "KHR_materials_ior", {{"ior", m.ior}});
        if (m.specular == 1 && !m.specular_map.present()) return;
        Json specular;
        specular["specularFactor"] = m.specular;
        add_texture(specular, "specularTexture", m.specular_map);
        extend(json, "KHR_materials_specular", specular);
    }

    void write_body(const Material& m, const Material::Scattering& s, Json& json) {
        Json volume;
        volume["thicknessFactor"] = s.thickness_mm / 1000;
        volume["attenuationColor"] = array_of(s.attenuation_color);
        if (s.attenuation_distance_mm > 0) volume["attenuationDistance"] = s.attenuation_distance_mm / 1000;
        add_texture(volume, "thicknessTexture", m.thickness_map);
        extend(json, "KHR_materials_volume", volume);
        Json transmission;
        transmission["diffuseTransmissionFactor"] = s.diffuse_transmission;
        transmission["diffuseTransmissionColorFactor"] = array_of(s.diffuse_transmission_color);
        add_texture(transmission, "diffuseTransmissionTexture", m.transmission_map);
        extend(json, "KHR_materials_diffuse_transmission", transmission);
        Json scatter;
        scatter["multiscatterColorFactor"] = array_of(s.multiscatter_color);
        scatter["scatterAnisotropy"] = s.anisotropy;
        extend(json, "KHR_materials_volume_scatter", scatter);
        // The newer draft's default strength is none at all.
        scatter["scatterStrengthFactor"] = s.scatter_strength;
        extend(json, "KHR_materials_scatter", scatter);
    }

    void extend(Json& material, const char* extension, Json content) {
        material["extensions"][extension] = std::move(content);
        if (std::ranges::find(extensions_, extension) == extensions_.end())
            extensions_.emplace_back(extension);
    }

    void add_texture(Json& owner, const char* key, const ImageSource& source) {
        if (!source.present() || error_) return;
        const std::string key_of_image =
            source.name.empty() ? "unnamed " + std::to_string(textures_.size()) : source.name;
        const auto [at, is_new] = textures_.try_emplace(key_of_image, textures_.size());
        if (is_new) add_image(source);
        owner[key]["index"] = at->second;
    }

    void add_image(const ImageSource& source) {
        const auto given = given_.find(source.name);
        const std::span<const std::byte> bytes =
            given != given_.end() ? given->second : std::span<const std::byte>(source.encoded);
        const std::string mime = mime_type(bytes);
        if (bytes.empty())
            error_ = Error{"no bytes were given for the map '" + source.name + "'"};
        else if (mime.empty())
            error_ = Error{"the map '" + source.name + "' is neither PNG nor JPEG"};
        if (error_) return;
        Json image;
        image["name"] = utf8_path(source.name).filename().string();
        image["mimeType"] = mime;
        image["bufferView"] = glb_.add_view(bytes, std::nullopt);
        glb_.root["images"].push_back(image);
        glb_.root["textures"].push_back({{"sampler", 0}, {"source", glb_.root["images"].size() - 1}});
        constexpr int kLinear = 9729, kLinearMipmapLinear = 9987;
        glb_.root["samplers"] = Json::array({{{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}}});
    }

    GlbContent& glb_;
    std::map<std::string, std::span<const std::byte>> given_;
    std::map<std::string, size_t> textures_;
    std::vector<std::string> extensions_;
    std::optional<Error> error_;
};

}  // namespace

Result<void> add_materials(GlbContent& glb, std::span<const Material> materials,
                           std::span<const NamedImage> images) {
    return MaterialWriter(glb, images).run(materials);
}

}  // namespace dermis::inline mesh::gltf
