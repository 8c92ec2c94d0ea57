#include "dermis/mesh/gltf/texture.h"

#include <cmath>

namespace dermis::inline mesh::gltf {

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
