#pragma once
// Light that arrives at a point of the scene, shadowed by rays: irradiance for the diffuse transport,
// reflected radiance for the specular one.

#include <optional>
#include <string_view>

#include "dermis/optics/fresnel.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/reference/environment_sampler.h"
#include "dermis/reference/materials.h"
#include "dermis/reference/split_sum.h"
#include "dermis/scene/scene.h"

namespace dermis::inline reference {

/// Which lights cast shadows: those with a shadow map in the renderer (Scene::shadow_maps), or every one.
enum class ShadowCasters { scene, all };

/// Environment light: traced through the scene, or as the renderer approximates it (order-2 harmonics times
/// the vertices' ambient visibility, and the split sum for its reflections when a Lighting is given one).
enum class AmbientModel { traced, renderer };

enum class SpecularReflection { none, blinn_phong, ggx };

struct LightingSettings {
    ShadowCasters shadows = ShadowCasters::scene;
    AmbientModel ambient = AmbientModel::traced;
    SpecularReflection specular = SpecularReflection::ggx;
    /// Full width of the edge of every shadow, as the renderer's filter makes it: the shadow ray starts
    /// anywhere in a disk in the tangent plane whose outline, seen from the light, is a circle of this
    /// diameter.
    float penumbra_mm = 0;
    /// Above 1: only the part 1 - F(angle, eta) of the light that a smooth dielectric lets in counts as
    /// irradiance.
    double entry_eta = 1;
};

/// Uniform numbers for one evaluation.
struct LightingRandom {
    Vec2 penumbra, environment;
    float environment_choice = 0;
};

/// What they choose of the lights, for several receivers alike.
struct LightingChoice {
    Vec2 penumbra, hemisphere;
    std::optional<EnvironmentSampler::Sample> bright;  ///< else a direction of the receiver's hemisphere
};

/// Where light is received; normals are unit.
struct Receiver {
    Vec3 p_smooth_mm;
    Vec3 n_geometry;
    Vec3 n;  ///< shading normal: the cosine of the irradiance is to this one
    float occlusion = 1;
    std::optional<SurfaceReflection> skin;  ///< what reflects before light enters; absent: not skin
};
[[nodiscard]] Receiver receiver_of(const ShadingPoint& point);

/// Keeps references; everything must outlive it. Safe from any thread.
class Lighting {
  public:
    Lighting(const Scene& scene, const RayScene& rays, const MaterialSet& materials,
             const EnvironmentSampler& environment, const LightingSettings& settings,
             const SplitSumReflection* reflection = nullptr, const BrdfTable* brdf = nullptr)
        : scene_(scene),
          rays_(rays),
          materials_(materials),
          environment_(environment),
          settings_(settings),
          reflection_(reflection),
          brdf_(scene.skin.specular_reduces_diffuse && settings.specular != SpecularReflection::none
                    ? brdf
                    : nullptr),
          shadow_maps_(scene.shadow_maps()),
          harmonic_entry_(settings.entry_eta > 1 ? float(1 - diffuse_external_reflectance(settings.entry_eta))
                                                 : 1.0f) {}

    /// Where a probe or a walk meets skin.
    [[nodiscard]] Receiver skin_receiver(const SurfaceAttributes& surface, const RayHit& hit) const;

    [[nodiscard]] LightingChoice choose(const LightingRandom& random) const;
    /// An unbiased estimate of the irradiance, linear.
    [[nodiscard]] Vec3 irradiance(const Receiver& receiver, const LightingChoice& choice) const;
    /// Whether the irradiance has no noise: no penumbra, and no environment to trace.
    [[nodiscard]] bool is_exact() const {
        return settings_.penumbra_mm == 0 &&
               (settings_.ambient == AmbientModel::renderer || environment_.dark());
    }

    /// An unbiased estimate of the radiance reflected by the surface itself towards the eye. Directional,
    /// point and spot lights as shaders/include/specular.glsl has them; the environment by the same GGX with
    /// rays when traced (only with the ggx model), else by the split sum.
    [[nodiscard]] Vec3 specular_radiance(const ShadingPoint& point, Vec3 to_eye,
                                         const LightingRandom& random) const;

    /// Factor on diffuse light that leaves towards the eye (shaders/include/reduced_diffuse.glsl): less
    /// than 1 on skin of a scene with Skin::specular_reduces_diffuse.
    [[nodiscard]] float diffuse_exit(const ShadingPoint& point, Vec3 to_eye) const;

    /// Transmittance along the segment: 0 behind opaque surfaces, coloured behind translucent
    /// ones (each surface crossed multiplies).
    [[nodiscard]] Vec3 transmittance(const Ray& ray) const;

    [[nodiscard]] const LightingSettings& settings() const { return settings_; }

  private:
    [[nodiscard]] float entry(const Receiver& receiver, float cosine) const;
    [[nodiscard]] Vec3 light_visibility(size_t light, const Receiver& receiver, Vec3 to_light,
                                        float distance_mm, Vec2 u) const;
    [[nodiscard]] Vec3 environment_irradiance(const Receiver& receiver, const LightingChoice& choice) const;
    [[nodiscard]] Vec3 environment_reflection(const ShadingPoint& point, Vec3 to_eye, Vec2 u) const;

    const Scene& scene_;
    const RayScene& rays_;
    const MaterialSet& materials_;
    const EnvironmentSampler& environment_;
    LightingSettings settings_;
    const SplitSumReflection* reflection_;
    const BrdfTable* brdf_;  // absent: the specular reflection takes nothing from the diffuse light
    std::vector<int> shadow_maps_;
    float harmonic_entry_;  // the part of even light that enters; an integral, so it is made once
};

/// The light that reaches `p_mm` if nothing blocks it.
struct LightArrival {
    Vec3 irradiance_linear;  ///< on a surface that faces the light
    Vec3 to_light;
    float distance_mm = 1e30f;
};
/// Inverse square in metres; a spot fades between its angles as a squared linear ramp of the cosine.
[[nodiscard]] LightArrival light_at(const Light& light, Vec3 p_mm);

/// BRDF times cosine of one light, one number: F0 is a number too. 0 below the horizon.
[[nodiscard]] float specular_response(SpecularReflection model, Vec3 n, Vec3 to_eye, Vec3 to_light,
                                      float roughness, float f0);

}  // namespace dermis::inline reference
