#include "dermis/rays/mapped_normal.h"

#include "shaders/include/wrinkles.h"

namespace dermis::inline rays {
namespace {

Vec3 sampled(const Texture& map, const SurfaceAttributes& at) {
    const Vec4 texel = map.sample(at.uv, at.footprint);
    return Vec3{texel.x, texel.y, texel.z} * 2.0f - Vec3{1, 1, 1};
}

}  // namespace

Vec3 mapped_normal(const Material& material, const NormalMaps& maps, const SurfaceAttributes& at) {
    Vec3 n = sampled(*maps.normal, at);
    const auto share = [&](const Texture* map, float tension, float weight) {
        if (!map || map->empty()) return 0.0f;
        return wrinkle_share(tension, material.wrinkle_from, material.wrinkle_full, weight);
    };
    const float stretch = share(maps.stretch, at.tension, maps.weights.stretch);
    const float compress = share(maps.compress, -at.tension, maps.weights.compress);
    const float scale = wrinkle_scale(stretch, compress);
    n = n * (1 - (stretch + compress) * scale);
    if (stretch > 0) n = n + sampled(*maps.stretch, at) * (stretch * scale);
    if (compress > 0) n = n + sampled(*maps.compress, at) * (compress * scale);
    return n;
}

}  // namespace dermis::inline rays
