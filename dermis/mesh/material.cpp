#include "dermis/mesh/material.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline mesh {
namespace {

float inside_side(float at, TextureWrap wrap) {
    if (at >= 0 && at <= 1) return at;
    if (wrap == TextureWrap::clamp) return std::clamp(at, 0.0f, 1.0f);
    if (wrap == TextureWrap::repeat) return at - std::floor(at);
    const float t = at - 2 * std::floor(at / 2);
    return t > 1 ? 2 - t : t;
}

}  // namespace

Vec2 inside_image(const ImageSource& image, Vec2 uv) {
    return {inside_side(uv.x, image.wrap_u), inside_side(uv.y, image.wrap_v)};
}

float cutoff_of_map(const Material& material) {
    constexpr float kBlended = 0.5f, kNothing = 2;  // no map reaches 2
    switch (material.alpha_mode) {
        case AlphaMode::opaque:
            return material.opacity < kBlended ? kNothing : 0;
        case AlphaMode::mask:
            return material.opacity > 0 ? material.alpha_cutoff / material.opacity : kNothing;
        case AlphaMode::blend:
            if (material.opacity < kBlended) return kNothing;
            return material.alpha_map.present() || material.base_color_map.present() ? kBlended : 0;
    }
    return 0;
}

bool is_blended(const Material& material) {
    return material.alpha_mode != AlphaMode::mask && (material.opacity < 1 || cutoff_of_map(material) > 0);
}

std::vector<NamedMap> maps_of(const Material& m) {
    std::vector<NamedMap> maps = {{"base color", &m.base_color_map},
                                  {"emission", &m.emission_map},
                                  {"normal", &m.normal_map},
                                  {"wrinkle stretch", &m.wrinkle_stretch_map},
                                  {"wrinkle compress", &m.wrinkle_compress_map},
                                  {"metallic roughness", &m.metallic_roughness_map},
                                  {"roughness", &m.roughness_map},
                                  {"specular", &m.specular_map},
                                  {"occlusion", &m.occlusion_map},
                                  {"displacement", &m.displacement_map},
                                  {"thickness", &m.thickness_map},
                                  {"scatter", &m.scatter_map},
                                  {"opacity", &m.opacity_map},
                                  {"transmission", &m.transmission_map}};
    std::erase_if(maps, [](const NamedMap& map) { return !map.image->present(); });
    return maps;
}

}  // namespace dermis::inline mesh
