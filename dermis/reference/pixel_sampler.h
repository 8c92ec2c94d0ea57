#pragma once
// One sample of one pixel: the path from the eye to what it sees. Internal to dermis/reference.

#include <atomic>

#include "dermis/reference/picture.h"
#include "dermis/reference/walk_integrator.h"

namespace dermis::inline reference {

struct PixelSample {
    Vec3 diffuse, specular, background;
    float coverage = 0;
    float skin = 0;  ///< share of what is seen that is skin
    int walks = 0, lost_walks = 0;
    [[nodiscard]] Vec3 radiance() const { return diffuse + specular + background; }
};

/// Everything a picture needs, loaded once; safe from any thread afterwards. Not movable: parts refer to each
/// other.
class PixelSampler {
  public:
    [[nodiscard]] static Result<std::unique_ptr<PixelSampler>> create(const Scene& scene,
                                                                      const ReferenceSettings& settings);
    /// Sample `index` of the pixel; depends on seed, pixel and index alone.
    [[nodiscard]] PixelSample sample(int x, int y, uint32_t index) const;

  private:
    PixelSampler(const Scene& scene, const ReferenceSettings& settings, RayScene rays, MaterialSet materials,
                 EnvironmentSampler environment, SplitSumReflection reflection, std::optional<BrdfTable> brdf,
                 const LightingSettings& lighting);
    void use_profile(const Profile& profile);
    void use_medium(const ScatteringMedium& medium);

    [[nodiscard]] Ray camera_ray(int x, int y, Vec2 within) const;
    /// A surface with the ray that sees it, the pixel it is seen in and where in the pixel.
    struct Seen {
        RayHit hit;
        Ray ray;
        int x, y;
        Vec2 within;
    };
    [[nodiscard]] UvFootprint footprint(const Seen& seen, Vec3 p_mm) const;
    /// Opacity of a hit on an opaque or blended surface.
    [[nodiscard]] float opacity_at(const RayHit& hit) const;
    [[nodiscard]] float add_translucent(Seen seen, float through, uint32_t& seed, PixelSample& sample) const;
    MaterialClass add_surface(const Seen& seen, Vec3 weight, uint32_t seed, PixelSample& sample) const;
    /// Where the environment is traced, a point's light has more noise than its walks.
    [[nodiscard]] bool subtracts_flat() const {
        return settings_.normalisation == Normalisation::by_area &&
               lighting_.settings().ambient == AmbientModel::renderer;
    }
    [[nodiscard]] Vec3 exitance(const ShadingPoint& point, const UvFootprint& footprint,
                                const LightingRandom& random, uint32_t seed, PixelSample& sample) const;

    const Scene& scene_;
    ReferenceSettings settings_;
    RayScene rays_;
    MaterialSet materials_;
    EnvironmentSampler environment_;
    SplitSumReflection reflection_;
    std::optional<BrdfTable> brdf_;
    Lighting lighting_;
    Mat4 inverse_view_projection_;
    std::vector<std::string> profiles_;       ///< skin_profiles(); empty where `settings` has a medium
    std::vector<SurfaceIntegrator> surface_;  ///< one a profile; empty: no surface integral
    std::vector<WalkIntegrator> walk_;        ///< one a profile; empty: no walks
};

}  // namespace dermis::inline reference
