#include "dermis/render/skin_tone.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline render {
namespace {

constexpr float kMaxTint = 4;  // what a scene file allows

struct Mean {
    Vec3 sum;
    size_t count = 0;
    void add(Vec3 color) { sum += color, ++count; }
};

// Nearest texel.
Vec3 texel_at(const Image& image, Vec2 uv) {
    const auto index = [](float t, int size) { return std::clamp(int(t * float(size)), 0, size - 1); };
    const int x = index(uv.x, image.width), y = index(uv.y, image.height);
    const auto channel = [&](int c) {
        const float value = image.at(x, y, image.channels >= 3 ? c : 0);
        return image.encoding == Encoding::srgb ? srgb_decode(value) : value;
    };
    return {channel(0), channel(1), channel(2)};
}

Result<void> add_submesh(const Mesh& mesh, const Submesh& submesh, Mean& mean) {
    const Material& material = mesh.materials[submesh.material];
    Image map;
    if (material.base_color_map.present() && mesh.uvs.size() == mesh.positions_mm.size()) {
        DERMIS_TRY_ASSIGN(Image decoded, load_image_source(material.base_color_map, ImageUse::color));
        map = std::move(decoded);
    }
    for (uint32_t i = 0; i < submesh.index_count; ++i) {
        const uint32_t vertex = mesh.indices[submesh.first_index + i];
        mean.add(map.empty() ? material.base_color_linear
                             : material.base_color_linear *
                                   texel_at(map, inside_image(material.base_color_map, mesh.uvs[vertex])));
    }
    return {};
}

}  // namespace

Result<Vec3> mean_skin_albedo(const Scene& scene) {
    Mean mean;
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes)
            if (object.classes[submesh.material] == MaterialClass::skin)
                DERMIS_TRY(add_submesh(object.mesh, submesh, mean));
    if (mean.count == 0) return Error{scene.name + " has no skin to give a tone"};
    return mean.sum * (1.0f / float(mean.count));
}

Vec3 tint_towards(Vec3 albedo_linear, Vec3 mean_linear) {
    const auto ratio = [](float wanted, float mean) {
        return mean > 1e-4f ? std::clamp(wanted / mean, 0.0f, kMaxTint) : 1.0f;
    };
    return {ratio(albedo_linear.x, mean_linear.x), ratio(albedo_linear.y, mean_linear.y),
            ratio(albedo_linear.z, mean_linear.z)};
}

}  // namespace dermis::inline render
