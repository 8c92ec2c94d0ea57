// A mesh as one GLB: the attributes once, an index accessor a submesh, images in the same buffer.

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "dermis/base/file.h"
#include "dermis/mesh/gltf/glb_content.h"
#include "dermis/mesh/write_mesh.h"

namespace dermis::inline mesh {
namespace {

using Json = gltf::OrderedJson;
using gltf::GlbContent;

Json array_of(Vec3 v) {
    return {v.x, v.y, v.z};
}

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

Result<std::vector<std::byte>> assemble(const GlbContent& glb) {
    std::string json;
    try {
        json = glb.root.dump();
    } catch (const nlohmann::json::exception&) {
        return Error{"a name is not valid UTF-8"};
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const uint64_t total = 12 + 8 + json.size() + 8 + glb.binary.size();
    if (total > UINT32_MAX) return Error{"larger than 4 GiB, the most a GLB can hold"};
    std::vector<std::byte> file;
    file.reserve(total);
    const auto put_u32 = [&](uint64_t value) {
        for (int shift = 0; shift < 32; shift += 8) file.push_back(std::byte(value >> shift & 255));
    };
    for (const uint64_t word :
         {uint64_t{0x46546C67}, uint64_t{2}, total, uint64_t{json.size()}, uint64_t{0x4E4F534A}})
        put_u32(word);
    const auto text = as_bytes(json);
    file.insert(file.end(), text.begin(), text.end());
    put_u32(glb.binary.size()), put_u32(0x004E4942);
    file.insert(file.end(), glb.binary.begin(), glb.binary.end());
    return file;
}

}  // namespace

namespace gltf {

PackedIndices packed_indices(std::span<const uint32_t> indices, size_t vertices) {
    if (vertices > UINT16_MAX) {
        const auto bytes = std::as_bytes(indices);
        return {{bytes.begin(), bytes.end()}, kU32};
    }
    const std::vector<uint16_t> narrow(indices.begin(), indices.end());
    const auto bytes = std::as_bytes(std::span(narrow));
    return {{bytes.begin(), bytes.end()}, kU16};
}

size_t GlbContent::add_view(std::span<const std::byte> bytes, std::optional<int> target) {
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    binary.resize((binary.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(view);
    return root["bufferViews"].size() - 1;
}

size_t GlbContent::add_accessor(std::span<const std::byte> bytes, size_t count, int component,
                                const char* type, std::optional<int> target) {
    const size_t view = add_view(bytes, target);
    root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return root["accessors"].size() - 1;
}

void GlbContent::set_bounds(std::span<const Vec3> values) {
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = -low;
    for (const Vec3& p : values) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    root["accessors"].back()["min"] = array_of(low);
    root["accessors"].back()["max"] = array_of(high);
}

size_t GlbContent::add_changes(const std::vector<Vec3>& changes, bool bounded) {
    std::vector<uint32_t> places;
    std::vector<Vec3> values;
    for (size_t v = 0; v < changes.size(); ++v)
        if (changes[v] != Vec3{}) {
            places.push_back(uint32_t(v));
            values.push_back(changes[v]);
        }
    const bool sparse = 4 * values.size() < 3 * changes.size();  // an entry has its place beside its vector
    if (!sparse) {
        add_attribute(changes, "VEC3");
    } else {
        Json accessor = {{"componentType", kF32}, {"count", changes.size()}, {"type", "VEC3"}};
        if (!values.empty()) {
            const PackedIndices packed = packed_indices(places, changes.size());
            const size_t indices = add_view(packed.bytes, std::nullopt),
                         moved = add_view(std::as_bytes(std::span(values)), std::nullopt);
            accessor["sparse"] = {{"count", values.size()},
                                  {"indices", {{"bufferView", indices}, {"componentType", packed.component}}},
                                  {"values", {{"bufferView", moved}}}};
        }
        root["accessors"].push_back(accessor);
    }
    if (bounded) set_bounds(changes);
    return root["accessors"].size() - 1;
}

namespace {

// The numbers of a vertex one behind the other in one view: WebGPU guarantees only 8 vertex buffers, and an
// engine makes one of each view.
void add_more_uvs(GlbContent& glb, std::span<const std::vector<Vec2>> more_uvs, Json& attributes) {
    if (more_uvs.empty()) return;
    const size_t count = more_uvs.front().size();
    std::vector<Vec2> values;
    values.reserve(count * more_uvs.size());
    for (size_t v = 0; v < count; ++v)
        for (const std::vector<Vec2>& uvs : more_uvs) values.push_back(uvs[v]);
    const size_t view = glb.add_view(std::as_bytes(std::span(values)), kArrayBuffer);
    glb.root["bufferViews"][view]["byteStride"] = more_uvs.size() * sizeof(Vec2);
    for (size_t i = 0; i < more_uvs.size(); ++i) {
        attributes[fmt::format("TEXCOORD_{}", 2 + i)] = glb.root["accessors"].size();
        glb.root["accessors"].push_back({{"bufferView", view},
                                         {"byteOffset", i * sizeof(Vec2)},
                                         {"componentType", kF32},
                                         {"count", count},
                                         {"type", "VEC2"}});
    }
}

}  // namespace

Json add_attributes(GlbContent& glb, const Mesh& mesh, std::span<const std::vector<Vec2>> more_uvs) {
    Json attributes;
    std::vector<Vec3> positions_m;
    for (const Vec3& p_mm : mesh.positions_mm) positions_m.push_back(p_mm * 0.001f);
    attributes["POSITION"] = glb.add_attribute(positions_m, "VEC3");
    glb.set_bounds(positions_m);
    if (!mesh.normals.empty()) attributes["NORMAL"] = glb.add_attribute(mesh.normals, "VEC3");
    if (!mesh.tangents.empty()) attributes["TANGENT"] = glb.add_attribute(mesh.tangents, "VEC4");
    if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = glb.add_attribute(mesh.uvs, "VEC2");
    if (!mesh.atlas_uvs.empty()) attributes["TEXCOORD_1"] = glb.add_attribute(mesh.atlas_uvs, "VEC2");
    add_more_uvs(glb, more_uvs, attributes);
    return attributes;
}

void add_mesh(GlbContent& glb, const Mesh& mesh, const Json& attributes, const Json& targets) {
    Json primitives = Json::array();
    for (const Submesh& submesh : mesh.submeshes) {
        if (submesh.index_count == 0) continue;
        const PackedIndices packed =
            packed_indices(std::span(mesh.indices).subspan(submesh.first_index, submesh.index_count),
                           mesh.positions_mm.size());
        const size_t indices = glb.add_accessor(packed.bytes, submesh.index_count, packed.component, "SCALAR",
                                                kElementArrayBuffer);
        primitives.push_back(
            {{"attributes", attributes}, {"indices", indices}, {"material", submesh.material}});
        if (!targets.empty()) primitives.back()["targets"] = targets;
    }
    glb.root["meshes"].push_back({{"primitives", primitives}});
    if (!mesh.submeshes.empty() && !mesh.submeshes.front().name.empty())
        glb.root["meshes"].back()["name"] = mesh.submeshes.front().name;
}

}  // namespace gltf

Result<std::vector<std::byte>> glb_bytes(const Mesh& mesh, std::span<const NamedImage> images,
                                         std::span<const std::string> extras,
                                         std::span<const std::vector<Vec2>> more_uvs, const Rig* rig) {
    if (mesh.indices.empty()) return Error{"a mesh without triangles is not written"};
    GlbContent glb;
    glb.root = {{"asset", {{"version", "2.0"}, {"generator", "dermis"}}},
                {"scene", 0},
                {"scenes", Json::array({{{"nodes", {0}}}})},
                {"nodes", Json::array({{{"mesh", 0}}})}};
    DERMIS_TRY(MaterialWriter(glb, images).run(mesh.materials));
    for (size_t i = 0; i < std::min(extras.size(), mesh.materials.size()); ++i) {
        if (extras[i].empty()) continue;
        glb.root["materials"][i]["extras"] = Json::parse(extras[i], nullptr, false);
        if (glb.root["materials"][i]["extras"].is_discarded())
            return Error{fmt::format("the extras of material {} are no JSON", i)};
    }
    if (rig)
        gltf::add_rig(glb, *rig, more_uvs);
    else
        gltf::add_mesh(glb, mesh, gltf::add_attributes(glb, mesh, more_uvs));
    glb.root["buffers"] = Json::array({{{"byteLength", glb.binary.size()}}});
    return assemble(glb);
}

Result<void> write_glb(const std::filesystem::path& path, const Mesh& mesh,
                       std::span<const NamedImage> images, std::span<const std::string> extras) {
    const Result<std::vector<std::byte>> bytes = glb_bytes(mesh, images, extras);
    return bytes ? write_file(path, *bytes) : bytes.error().within(path.string());
}

}  // namespace dermis::inline mesh
