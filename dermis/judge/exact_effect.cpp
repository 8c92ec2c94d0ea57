#include "dermis/judge/exact_effect.h"

#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/reference/materials.h"

namespace dermis::inline judge {

Result<Image> exact_effect(const Scene& scene, const ExactExitance& exact, int width, int height, int grid,
                           float penumbra_mm) {
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(scene.objects));
    DERMIS_TRY_ASSIGN(const MaterialSet materials, MaterialSet::load(scene));
    const GaussianSum gaussians = to_gaussian_sum(profile).sum;
    const Light& key = scene.key_light();
    const Vec3 light = key.color_linear * (key.intensity / std::numbers::pi_v<float>);
    const Mat4 inverse = camera_matrices(scene.camera, float(width) / float(height)).inverse_view_projection;
    const auto effect_at = [&](float x, float y) -> Vec3 {
        const auto hit = rays.closest_hit(RaySet::opaque, camera_ray(inverse, x, y, width, height));
        if (!hit) return {};
        const ShadingPoint point = materials.shade(rays.surface_at(*hit), *hit);
        if (point.material_class != MaterialClass::skin) return {};
        const ExactPoint value = exact(gaussians, penumbra_mm, point.p_mm);
        const Vec3 without = {value.irradiance, value.irradiance, value.irradiance};
        return point.albedo_linear * light * (value.exitance - without);
    };
    Image picture(width, height, 3);
    const float cell = 1 / float(grid);
    parallel_for(size_t(height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(width); ++x) {
                Vec3 sum;
                for (int i = 0; i < grid * grid; ++i)
                    sum += effect_at(float(x) + (float(i % grid) + 0.5f) * cell,
                                     float(y) + (float(i / grid) + 0.5f) * cell);
                const Vec3 mean = sum * (cell * cell);
                const float channels[3] = {mean.x, mean.y, mean.z};
                std::copy_n(channels, 3, &picture.floats()[3 * (y * size_t(width) + x)]);
            }
    });
    return picture;
}

}  // namespace dermis::inline judge
