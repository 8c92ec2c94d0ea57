#pragma once
// One sample of one pixel: the path from the eye to what it sees. Internal to dermis/reference.

#include <atomic>
#include <memory>

#include "dermis/reference/picture.h"
#include "dermis/reference/walk_integrator.h"

namespace dermis::inline reference {

struct PixelSample {
    Vec3 diffuse, specular, background;
    Vec3 scattered;  ///< what scattering adds to `diffuse`; Measure::effect
    float coverage = 0;
    float skin = 0;  ///< share of what is seen that is skin
    int walks = 0, lost_walks = 0;
    [[nodiscard]] Vec3 radiance() const { return diffuse + specular + background; }
};

/// What references of a scene have in common.
struct TracedScene {
    Cavities cavities = Cavities::flesh;
    bool approximates_reflections = false;
    RayScene rays;
    MaterialSet materials;
    EnvironmentSampler environment;
    SplitSumReflection reflection;
    std::optional<BrdfTable> brdf;

    [[nodiscard]] static Result<std::shared_ptr<const TracedScene>> load(const Scene& scene,
                                                                         const ReferenceSettings& settings);
};

/// What samples are for. effect: PixelSample::scattered, and of what the picture shows no more than that
/// takes.
enum class Measure { picture, effect };

/// Everything a picture needs, loaded once; safe from any thread afterwards. Not movable: parts refer to each
/// other.
class PixelSampler {
  public:
    [[nodiscard]] static Result<std::unique_ptr<PixelSampler>> create(const Scene& scene,
                                                                      const ReferenceSettings& settings,
                                                                      Measure measure = Measure::picture);
    /// Sample `index` of the pixel; depends on seed, pixel and index alone. Of PixelFilter::grid, every
    /// number of samples has the expected mean of all cells, and each run of grid^2 from a multiple of it has
    /// each cell once.
    [[nodiscard]] PixelSample sample(uint32_t seed, int x, int y, uint32_t index) const;
    /// PixelSample::skin of sample(), without its light.
    [[nodiscard]] float skin(uint32_t seed, int x, int y, uint32_t index) const;
    /// By the seed of the settings.
    [[nodiscard]] PixelSample sample(int x, int y, uint32_t index) const {
        return sample(settings_.seed, x, y, index);
    }

  private:
    PixelSampler(const Scene& scene, const ReferenceSettings& settings,
                 std::shared_ptr<const TracedScene> traced, const LightingSettings& lighting,
                 Measure measure);
    void use_profile(const Profile& profile);
    void use_medium(const ScatteringMedium& medium);

    template <class Shade>
    [[nodiscard]] PixelSample trace(uint32_t of_seed, int x, int y, uint32_t index, const Shade& shade) const;
    [[nodiscard]] Vec2 place_in_pixel(uint32_t pixel, uint32_t index) const;
    [[nodiscard]] Ray camera_ray(int x, int y, Vec2 within) const;
    /// A surface with the ray that sees it, the pixel it is seen in and where in the pixel, by which sample.
    struct Seen {
        RayHit hit;
        Ray ray;
        int x, y;
        Vec2 within;
        uint32_t pixel_seed, index;
    };
    [[nodiscard]] UvFootprint footprint(const Seen& seen, Vec3 p_mm) const;
    /// Opacity of a hit on an opaque or blended surface.
    [[nodiscard]] float opacity_at(const RayHit& hit) const;
    template <class Shade>
    [[nodiscard]] float add_translucent(Seen seen, float through, uint32_t& seed, PixelSample& sample,
                                        const Shade& shade) const;
    MaterialClass add_surface(const Seen& seen, Vec3 weight, uint32_t seed, PixelSample& sample) const;
    /// Where the environment is traced, a point's light has more noise than its walks.
    [[nodiscard]] bool subtracts_flat() const {
        return settings_.normalisation == Normalisation::by_area &&
               lighting_.settings().ambient == AmbientModel::renderer;
    }
    /// By the surface integral: around what the pixel sees of a profile's skin, made once.
    [[nodiscard]] Vec3 reflectance_around(const Seen& seen, size_t profile, const DiffusePoint& point,
                                          uint32_t seed) const;
    /// Around the first surface on a ray through the pixel; nothing if it is not skin of this profile.
    [[nodiscard]] std::optional<Vec3> reflectance_seen(const Seen& seen, size_t profile,
                                                       uint32_t place) const;
    [[nodiscard]] size_t profile_at(const RayHit& hit) const;
    /// Over albedo.
    struct DiffuseLight {
        Vec3 exitance;
        Vec3 scattered;  ///< what scattering adds to it; Measure::effect
    };
    [[nodiscard]] DiffuseLight diffuse_light(const Seen& seen, const ShadingPoint& point,
                                             const UvFootprint& footprint, const LightingRandom& random,
                                             uint32_t seed, PixelSample& sample) const;

    const Scene& scene_;
    ReferenceSettings settings_;
    std::shared_ptr<const TracedScene> traced_;
    const RayScene& rays_;
    const MaterialSet& materials_;
    const EnvironmentSampler& environment_;
    Lighting lighting_;
    Lighting unscattered_lighting_;  ///< of `lambert`: nothing is reflected where light enters the medium
    Measure measure_;
    uint32_t cell_step_;  ///< from the cell of one sample to that of the next
    Mat4 inverse_view_projection_;
    std::vector<std::string> profiles_;       ///< skin_profiles(); empty where `settings` has a medium
    std::vector<SurfaceIntegrator> surface_;  ///< one a profile; empty: no surface integral
    std::vector<WalkIntegrator> walk_;        ///< one a profile; empty: no walks
    /// Three channels of each pixel and profile; 0: not made. Every thread makes the same.
    mutable std::vector<std::atomic<float>> reflectance_;
};

}  // namespace dermis::inline reference
