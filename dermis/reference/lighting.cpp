#include "dermis/reference/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/angle.h"
#include "dermis/optics/fresnel.h"
#include "dermis/optics/microfacet.h"
#include "dermis/rays/sampling.h"
#include "shaders/include/constants.h"

namespace dermis::inline reference {
namespace {

constexpr size_t kMostTranslucentLayers = 16;

bool is_black(Vec3 v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}

float entry_transmittance(double eta, float cosine) {
    return eta > 1 ? float(1 - fresnel_dielectric(cosine, eta)) : 1.0f;
}

float not_reflected(float scale, float bias, float f0) {
    return 1 - std::min(f0 * scale + bias, 1.0f);
}

Vec3 mix(Vec3 a, Vec3 b, float t) {
    return a + (b - a) * t;
}

// shaders/include/shadow.glsl, shadow_disk(): point `disk` of the unit disk that is round as the light sees
// it, in the tangent plane, lifted out of cavities and, under grazing light, out of the surface.
Vec3 tangent_disk(Vec3 n, Vec3 to_light, Vec2 disk, float radius_mm) {
    const LocalFrame frame = frame_of(to_light);
    const float n_dot_l = std::clamp(dot(n, to_light), 0.0f, 1.0f), sine = std::sqrt(1 - n_dot_l * n_dot_l);
    const float per_cosine = std::min(1 / std::max(n_dot_l, 1e-3f), kShadowMaxSlope / std::max(sine, 1e-3f));
    const Vec3 facing = (frame.tangent * disk.x + frame.bitangent * disk.y) * radius_mm;
    const Vec3 in_plane = facing - to_light * (dot(facing, n) * per_cosine);
    const float lacking = std::max(0.0f, sine - kShadowMaxSlope * n_dot_l);
    return in_plane + n * (0.5f * kShadowConcavity / radius_mm * dot(in_plane, in_plane) +
                           radius_mm * (kShadowFacetLift + lacking));
}

}  // namespace

LightArrival light_at(const Light& light, Vec3 p_mm) {
    const Vec3 color = light.color_linear * light.intensity;
    if (light.kind == LightKind::directional) return {color, normalize(light.to_light_world)};
    const Vec3 offset_mm = light.position_mm - p_mm;
    const float distance_mm = std::max(length(offset_mm), 1.0f), distance_m = distance_mm * 1e-3f;
    const Vec3 to_light = normalize(offset_mm);
    float cone = 1;
    if (light.kind == LightKind::spot) {
        const float cos_outer = std::cos(light.outer_angle_rad), cos_inner = std::cos(light.inner_angle_rad);
        const float along = dot(to_light, normalize(light.to_light_world));
        const float ramp =
            std::clamp((along - cos_outer) / std::max(cos_inner - cos_outer, 1e-4f), 0.0f, 1.0f);
        cone = ramp * ramp;
    }
    return {color * (cone / (distance_m * distance_m)), to_light, distance_mm};
}

float specular_response(SpecularReflection model, Vec3 n, Vec3 to_eye, Vec3 to_light, float roughness,
                        float f0) {
    const float n_dot_l = dot(n, to_light);
    if (n_dot_l <= 0 || model == SpecularReflection::none) return 0;
    const Vec3 h = normalize(to_eye + to_light);
    const double n_dot_h = std::clamp(dot(n, h), 0.0f, 1.0f),
                 n_dot_v = std::clamp(dot(n, to_eye), 1e-3f, 1.0f);
    const double fresnel = fresnel_schlick(std::clamp(dot(h, to_eye), 0.0f, 1.0f), f0);
    const double alpha = double(roughness) * roughness;
    if (model == SpecularReflection::blinn_phong) {
        // As in the renderer: normalised to reflect all light at normal incidence (Hoffman 2010), exponent at
        // least 1.
        const double exponent = std::max(blinn_phong_exponent(alpha), 1.0);
        return float(fresnel * (exponent + 8) / (8 * std::numbers::pi) * std::pow(n_dot_h, exponent) *
                     n_dot_l);
    }
    const double brdf = microfacet_brdf(ggx_d(n_dot_h, alpha), ggx_smith_g(n_dot_l, n_dot_v, alpha), fresnel,
                                        n_dot_l, n_dot_v);
    return float(brdf * n_dot_l);
}

Receiver receiver_of(const ShadingPoint& point) {
    Receiver receiver{point.p_smooth_mm, point.n_geometry, point.n, point.occlusion, std::nullopt};
    if (point.material_class == MaterialClass::skin)
        receiver.skin = SurfaceReflection{point.roughness, point.f0};
    return receiver;
}

Receiver Lighting::skin_receiver(const SurfaceAttributes& surface, const RayHit& hit) const {
    Receiver receiver{.p_smooth_mm = surface.p_smooth_mm,
                      .n_geometry = surface.n_geometry_world,
                      .n = materials_.normal_at(surface, hit.object),
                      .occlusion = materials_.occlusion_at(surface, hit)};
    if (brdf_) receiver.skin = materials_.reflection_at(surface, hit.object);
    return receiver;
}

Vec3 Lighting::transmittance(const Ray& ray) const {
    if (rays_.occluded(RaySet::opaque, ray)) return {};
    Vec3 through{1, 1, 1};
    if (!rays_.has(RaySet::translucent)) return through;
    HitBuffer<kMostTranslucentLayers> buffer;
    const std::span<RayHit> hits = buffer.hits();
    const size_t count = rays_.all_hits(RaySet::translucent, ray, hits);
    for (const RayHit& hit : hits.first(count))
        through = through * materials_.transmittance_at(rays_.surface_at(hit), hit.object);
    return through;
}

Vec3 Lighting::light_visibility(size_t light, const Receiver& receiver, Vec3 to_light, float distance_mm,
                                Vec2 u) const {
    if (settings_.shadows == ShadowCasters::scene && shadow_maps_[light] < 0) return {1, 1, 1};
    const float offset_mm = 10 * rays_.epsilon_mm(), radius_mm = 0.5f * settings_.penumbra_mm;
    Vec3 origin_mm = receiver.p_smooth_mm + receiver.n_geometry * offset_mm;
    if (radius_mm > 0) origin_mm += tangent_disk(receiver.n_geometry, to_light, sample_disk(u), radius_mm);
    return transmittance(
        {.origin_mm = origin_mm, .direction = to_light, .min_mm = offset_mm, .max_mm = distance_mm});
}

// A walk has its own boundary, which reflects light before it enters.
float Lighting::entry(const Receiver& receiver, float cosine) const {
    if (settings_.entry_eta > 1) return entry_transmittance(settings_.entry_eta, cosine);
    if (!brdf_ || !receiver.skin) return 1;
    const auto [roughness, f0] = *receiver.skin;
    const Vec4 terms = brdf_->at(kBrdfLobeGgx, roughness, cosine);
    return not_reflected(terms.x, terms.y, f0) / std::max(not_reflected(terms.z, terms.w, f0), 1e-3f);
}

float Lighting::diffuse_exit(const ShadingPoint& point, Vec3 to_eye) const {
    if (!brdf_ || point.material_class != MaterialClass::skin) return 1;
    const Vec4 terms =
        brdf_->at(kBrdfLobeGgx, point.roughness, std::clamp(dot(point.n, to_eye), 1e-3f, 1.0f));
    return not_reflected(terms.x, terms.y, point.f0);
}

LightingChoice Lighting::choose(const LightingRandom& random) const {
    LightingChoice choice{random.penumbra, random.environment, std::nullopt};
    if (settings_.ambient == AmbientModel::traced && !environment_.dark() &&
        random.environment_choice >= 0.5f)
        choice.bright = environment_.sample(random.environment);
    return choice;
}

Vec3 Lighting::environment_irradiance(const Receiver& receiver, const LightingChoice& choice) const {
    if (environment_.dark()) return {};
    if (settings_.ambient == AmbientModel::renderer)
        return environment_.harmonic_irradiance(receiver.n) * (receiver.occlusion * harmonic_entry_);
    // One direction from an even mixture of the cosine lobe and the bright parts: the balance heuristic of
    // Veach 1997 for one sample.
    const Vec3 direction = choice.bright
                               ? choice.bright->direction_world
                               : frame_of(receiver.n).to_world(sample_cosine_hemisphere(choice.hemisphere));
    const float cosine = dot(receiver.n, direction);
    if (cosine <= 0) return {};
    const Vec2 place = choice.bright ? choice.bright->place : environment_.place(direction);
    const float bright_density = choice.bright ? choice.bright->density : environment_.density_at(place);
    const float density = 0.5f * (cosine / kPi + bright_density);
    const float offset_mm = 10 * rays_.epsilon_mm();
    const Vec3 through = transmittance({.origin_mm = receiver.p_smooth_mm + receiver.n_geometry * offset_mm,
                                        .direction = direction,
                                        .min_mm = offset_mm});
    if (is_black(through)) return {};
    return through * environment_.radiance_at(place) * (cosine * entry(receiver, cosine) / density);
}

Vec3 Lighting::irradiance(const Receiver& receiver, const LightingChoice& choice) const {
    Vec3 sum;
    for (size_t light = 0; light < scene_.lights.size(); ++light) {
        const LightArrival arrival = light_at(scene_.lights[light], receiver.p_smooth_mm);
        const float cosine = dot(receiver.n, arrival.to_light);
        if (cosine <= 0 || is_black(arrival.irradiance_linear)) continue;
        const Vec3 visible =
            light_visibility(light, receiver, arrival.to_light, arrival.distance_mm, choice.penumbra);
        sum += arrival.irradiance_linear * visible * (cosine * entry(receiver, cosine));
    }
    return sum + environment_irradiance(receiver, choice);
}

Vec3 Lighting::environment_reflection(const ShadingPoint& point, Vec3 to_eye, Vec2 u) const {
    const LocalFrame frame = frame_of(point.n);
    Vec3 v = frame.to_local(to_eye);
    v.z = std::max(v.z, 1e-3f);
    v = normalize(v);
    const float alpha = point.roughness * point.roughness;
    const Vec3 h = sample_ggx_visible_normal(u, v, alpha);
    const Vec3 l = h * (2 * dot(v, h)) - v;
    if (l.z <= 0) return {};
    // Visible normals leave F * G2 / G1(v) as the weight (Heitz 2018, equation 19).
    const double weight = fresnel_schlick(std::clamp(dot(v, h), 0.0f, 1.0f), point.f0) *
                          ggx_smith_g(l.z, v.z, alpha) / ggx_smith_g1(v.z, alpha);
    const Vec3 direction = frame.to_world(l);
    const float offset_mm = 10 * rays_.epsilon_mm();
    const Vec3 through = transmittance({.origin_mm = point.p_smooth_mm + point.n_geometry * offset_mm,
                                        .direction = direction,
                                        .min_mm = offset_mm});
    if (is_black(through)) return {};
    return through * environment_.radiance(direction) * float(weight);
}

Vec3 Lighting::specular_radiance(const ShadingPoint& given, Vec3 to_eye, const LightingRandom& random) const {
    if (settings_.specular == SpecularReflection::none) return {};
    // A metal's F0 is its colour; the models take one number, so its colour multiplies the result.
    ShadingPoint point = given;
    point.f0 = given.f0 + (1 - given.f0) * given.metallic;
    const Receiver receiver = receiver_of(point);
    Vec3 sum;
    for (size_t light = 0; light < scene_.lights.size(); ++light) {
        const LightArrival arrival = light_at(scene_.lights[light], point.p_smooth_mm);
        const float response = specular_response(settings_.specular, point.n, to_eye, arrival.to_light,
                                                 point.roughness, point.f0);
        if (response <= 0 || is_black(arrival.irradiance_linear)) continue;
        sum += arrival.irradiance_linear * response *
               light_visibility(light, receiver, arrival.to_light, arrival.distance_mm, random.penumbra);
    }
    if (settings_.specular == SpecularReflection::ggx && settings_.ambient == AmbientModel::traced &&
        !environment_.dark())
        sum += environment_reflection(point, to_eye, random.environment);
    if (reflection_ && settings_.ambient == AmbientModel::renderer)
        sum += reflection_->radiance(point.n, to_eye, point.roughness, point.f0, point.occlusion);
    return sum * mix({1, 1, 1}, given.albedo_linear, given.metallic);
}

}  // namespace dermis::inline reference
