#include "dermis/rays/cut_out.h"

#include "dermis/scene/image_source.h"

namespace dermis::inline rays {

Result<std::unique_ptr<CutOut>> CutOut::load(const SceneObject& object, uint32_t number) {
    const Material& material = object.mesh.materials[number];
    const bool may_be = number < object.classes.size() && object.classes[number] == MaterialClass::other;
    const float cutoff = may_be ? cutoff_of_map(material) : 0;
    if (cutoff == 0 && !(may_be && is_blended(material))) return std::unique_ptr<CutOut>();
    DERMIS_TRY_ASSIGN(const Image alpha, load_alpha(cutoff > 0 ? material : Material{}));
    const ImageSource& source = material.alpha_map.present() ? material.alpha_map : material.base_color_map;
    return std::unique_ptr<CutOut>(
        new CutOut(object.mesh, cutoff, is_blended(material), Texture(alpha, source.wrap_u, source.wrap_v)));
}

float CutOut::alpha(uint32_t triangle, float u, float v) const {
    const uint32_t* corner = &mesh_->indices[3 * size_t(triangle)];
    const float weight[3] = {1 - u - v, u, v};
    Vec2 uv;
    float alpha = mesh_->colors_linear.empty() ? 1.0f : 0.0f;
    for (int i = 0; i < 3; ++i) {
        if (!mesh_->uvs.empty()) uv = uv + mesh_->uvs[corner[i]] * weight[i];
        if (!mesh_->colors_linear.empty()) alpha += mesh_->colors_linear[corner[i]].w * weight[i];
    }
    return alpha * alpha_.sample(uv).x;
}

}  // namespace dermis::inline rays
