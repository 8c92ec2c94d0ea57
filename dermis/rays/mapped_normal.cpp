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
    const Vec3 n = sampled(*maps.normal, at);
    const Texture* wrinkles = at.tension > 0 ? maps.stretch : maps.compress;
    if (!wrinkles || wrinkles->empty()) return n;
    const float share = wrinkle_share(at.tension, material.wrinkle_from, material.wrinkle_full);
    return share > 0 ? n + (sampled(*wrinkles, at) - n) * share : n;
}

}  // namespace dermis::inline rays
