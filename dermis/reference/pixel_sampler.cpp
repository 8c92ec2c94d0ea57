#include "dermis/reference/pixel_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dermis/base/angle.h"
#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/rays/random.h"
#include "dermis/scene/skin_profiles.h"

namespace dermis::inline reference {
namespace {

constexpr int kMostLayers = 16;
// The relative error of the albedo is 0.05 % to 0.1 %: it would look like an effect of the whole picture.
constexpr int kAlbedoWalks = 1'800'000;

// Numbers of the lights that the light of a point without scattering takes in a picture: it has more noise
// than a few probes of scattered light.
constexpr int kLeastLights = 16;
// Places in a pixel where the reflectance around it is found, and probes at each.
constexpr uint32_t kReflectancePlaces = 4, kReflectanceStream = 3;
constexpr int kReflectanceProbes = 16;

// Surfaces other than skin are seen from both sides, as the renderer draws them.
void face_the_eye(ShadingPoint& point, Vec3 to_eye) {
    if (point.material_class == MaterialClass::skin || dot(point.n_face, to_eye) >= 0) return;
    point.n = -point.n;
    point.n_geometry = -point.n_geometry;
    point.p_smooth_mm = point.p_mm;
}

LightingSettings without_entry(LightingSettings settings) {
    settings.entry_eta = 1;
    return settings;
}

// As the renderer has them.
bool approximates_reflections_by(const LightingSettings& lighting) {
    return lighting.ambient == AmbientModel::renderer && lighting.specular != SpecularReflection::none;
}

// Steps of the golden ratio through the cells, row by row, so that few samples lie apart (Weyl 1916). Without
// a common divisor every cell is met once.
uint32_t golden_step(int grid) {
    const auto cells = uint32_t(grid * grid);
    auto step = uint32_t(std::lround(double(cells) / std::numbers::phi));
    while (std::gcd(step, cells) != 1) ++step;
    return step;
}

// Of diffuse light, by walks; a second or two, then from the cache.
Vec3 albedo_of(const ScatteringMedium& medium) {
    const std::string hash = Hasher()
                                 .add(std::string_view(hash_of({{}, {}, DipoleProfile{medium}})))
                                 .add(kAlbedoWalks)
                                 .add(kPlainWalks)
                                 .hex();
    Vec3 albedo;
    const auto parts = [&] { return std::tie(albedo.x, albedo.y, albedo.z); };
    if (cache_load("half_space_albedo", hash, parts())) return albedo;
    albedo = guided_half_space_albedo(medium, kAlbedoWalks, 1).mean;
    cache_store("half_space_albedo", hash, parts());
    return albedo;
}

// The media of the profiles, or the one that is set; `width_scale` stretches their lengths.
Result<std::vector<ScatteringMedium>> media_of(const ReferenceSettings& settings,
                                               std::span<const std::string> profiles) {
    std::vector<ScatteringMedium> media;
    if (settings.medium) media.push_back(*settings.medium);
    for (const std::string& name : profiles) {
        if (settings.medium) break;
        DERMIS_TRY_ASSIGN(const Profile profile, find_profile(name));
        media.push_back(walk_medium_of(profile));
    }
    for (ScatteringMedium& medium : media) {
        DERMIS_TRY(check(medium));
        for (size_t c = 0; c < 3 && settings.width_scale > 0; ++c) {
            medium.sigma_s_per_mm[c] /= settings.width_scale;
            medium.sigma_a_per_mm[c] /= settings.width_scale;
        }
    }
    return media;
}

}  // namespace

Result<std::shared_ptr<const TracedScene>> TracedScene::load(const Scene& scene,
                                                             const ReferenceSettings& settings) {
    const bool approximates = approximates_reflections_by(settings.lighting);
    DERMIS_TRY_ASSIGN(std::vector<Flesh> flesh, find_flesh(scene.objects, settings.cavities));
    DERMIS_TRY_ASSIGN(RayScene rays, RayScene::build(scene.objects, flesh));
    DERMIS_TRY_ASSIGN(MaterialSet materials, MaterialSet::load(scene));
    DERMIS_TRY_ASSIGN(EnvironmentSampler environment, EnvironmentSampler::load(scene.environment));
    DERMIS_TRY_ASSIGN(SplitSumReflection reflection,
                      SplitSumReflection::load(approximates ? scene.environment
                                                            : Environment{.kind = EnvironmentKind::none}));
    std::optional<BrdfTable> brdf;
    if (scene.skin.specular_reduces_diffuse) {
        DERMIS_TRY_ASSIGN(BrdfTable loaded, BrdfTable::load());
        brdf = std::move(loaded);
    }
    return std::make_shared<const TracedScene>(TracedScene{.cavities = settings.cavities,
                                                           .approximates_reflections = approximates,
                                                           .rays = std::move(rays),
                                                           .materials = std::move(materials),
                                                           .environment = std::move(environment),
                                                           .reflection = std::move(reflection),
                                                           .brdf = std::move(brdf)});
}

Result<std::shared_ptr<const TracedScene>> SharedTracing::of(const Scene& scene,
                                                             const ReferenceSettings& settings) {
    if (!kept_ || kept_->cavities != settings.cavities ||
        kept_->approximates_reflections != approximates_reflections_by(settings.lighting)) {
        DERMIS_TRY_ASSIGN(kept_, TracedScene::load(scene, settings));
    }
    return kept_;
}

PixelSampler::PixelSampler(const Scene& scene, const ReferenceSettings& settings,
                           std::shared_ptr<const TracedScene> traced, const LightingSettings& lighting,
                           Measure measure)
    : scene_(scene),
      settings_(settings),
      traced_(std::move(traced)),
      rays_(traced_->rays),
      materials_(traced_->materials),
      environment_(traced_->environment),
      lighting_(scene_, rays_, materials_, environment_, lighting, &traced_->reflection,
                traced_->brdf ? &*traced_->brdf : nullptr),
      unscattered_lighting_(scene_, rays_, materials_, environment_, without_entry(lighting),
                            &traced_->reflection, traced_->brdf ? &*traced_->brdf : nullptr),
      measure_(measure),
      cell_step_(golden_step(settings.grid)) {
    const float aspect = float(settings.width) / float(settings.height);
    inverse_view_projection_ = camera_matrices(scene.camera, aspect).inverse_view_projection;
}

void PixelSampler::use_profile(const Profile& profile) {
    surface_.emplace_back(rays_, lighting_, ProfileSampler(profile, settings_.width_scale),
                          SurfaceIntegratorSettings{.probes_of_run = probes_of(settings_) / kRuns,
                                                    .normalisation = settings_.normalisation});
}

void PixelSampler::use_medium(const ScatteringMedium& medium) {
    WalkIntegratorSettings walk{.walks = probes_of(settings_)};
    if (settings_.normalisation == Normalisation::by_area) {
        walk.normalisation = albedo_of(medium);
        for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z})
            walk.normalisation.*c = std::max(walk.normalisation.*c, 1e-6f);
    }
    walk.subtracts_flat = subtracts_flat();
    walk_.emplace_back(rays_, lighting_, medium, walk);
}

Result<std::unique_ptr<PixelSampler>> PixelSampler::create(const Scene& scene,
                                                           const ReferenceSettings& settings,
                                                           Measure measure) {
    std::shared_ptr<const TracedScene> traced;
    if (settings.tracing) {
        DERMIS_TRY_ASSIGN(traced, settings.tracing->of(scene, settings));
    } else {
        DERMIS_TRY_ASSIGN(traced, TracedScene::load(scene, settings));
    }
    LightingSettings lighting = settings.lighting;
    const bool walks = settings.integrator == Integrator::walk && settings.width_scale > 0;
    const std::vector<std::string> profiles = skin_profiles(scene);
    std::vector<ScatteringMedium> media;
    if (settings.integrator == Integrator::walk) {
        DERMIS_TRY_ASSIGN(media, media_of(settings, profiles));
        lighting.entry_eta = settings.entry == LightEntry::fresnel ? media.front().eta : 1;
    }
    std::unique_ptr<PixelSampler> sampler(
        new PixelSampler(scene, settings, std::move(traced), lighting, measure));
    if (media.size() != 1) sampler->profiles_ = profiles;
    for (const ScatteringMedium& medium : media)
        if (walks) sampler->use_medium(medium);
    if (settings.integrator == Integrator::surface && settings.width_scale > 0)
        for (const std::string& name : profiles) {
            DERMIS_TRY_ASSIGN(const Profile profile, find_profile(name));
            sampler->use_profile(profile);
        }
    const size_t pixels = size_t(settings.width) * size_t(settings.height);
    sampler->reflectance_ = std::vector<std::atomic<float>>(3 * pixels * sampler->surface_.size());
    return sampler;
}

// Each round over the cells begins at a cell by chance, so that the mean over a part of a round has no bias.
Vec2 PixelSampler::place_in_pixel(uint32_t pixel, uint32_t index) const {
    if (settings_.filter == PixelFilter::box) return OwenSequence(pixel, index).next_2d();
    if (settings_.filter == PixelFilter::center) return {0.5f, 0.5f};
    const auto side = uint32_t(settings_.grid);
    const uint32_t cells = side * side, first = hash_u32(hash_u32(pixel, 0), index / cells) % cells;
    const uint32_t cell = (first + index % cells * cell_step_) % cells;
    return Vec2{float(cell % side) + 0.5f, float(cell / side) + 0.5f} * (1 / float(side));
}

Ray PixelSampler::camera_ray(int x, int y, Vec2 within) const {
    return dermis::camera_ray(inverse_view_projection_, float(x) + within.x, float(y) + within.y,
                              settings_.width, settings_.height);
}

// Igehy 1999, "Tracing Ray Differentials": where the rays of the neighbouring pixels, or cells, meet the
// plane of the triangle.
UvFootprint PixelSampler::footprint(const Seen& seen, Vec3 p_mm) const {
    if (settings_.filter == PixelFilter::box) return {};
    const float side = settings_.filter == PixelFilter::grid ? 1 / float(settings_.grid) : 1;
    const auto step = [&](float dx, float dy) -> Vec2 {
        const Ray ray = camera_ray(seen.x, seen.y, {seen.within.x + dx, seen.within.y + dy});
        const float along = dot(ray.direction, seen.hit.n_face);
        if (std::abs(along) < 1e-6f) return {};
        const float distance_mm = dot(p_mm - ray.origin_mm, seen.hit.n_face) / along;
        return rays_.uv_step(seen.hit, ray.origin_mm + ray.direction * distance_mm - p_mm);
    };
    return {step(side, 0), step(0, side)};
}

size_t PixelSampler::profile_at(const RayHit& hit) const {
    const SceneObject& object = scene_.objects[hit.object];
    return profile_index(scene_, profiles_, object, material_of_triangle(object.mesh, hit.triangle));
}

std::optional<Vec3> PixelSampler::reflectance_seen(const Seen& seen, size_t profile, uint32_t place) const {
    const uint32_t pixel = hash_u32(settings_.seed, uint32_t(seen.x), uint32_t(seen.y));
    const Vec2 within = settings_.filter == PixelFilter::center
                            ? Vec2{0.5f, 0.5f}
                            : OwenSequence(hash_u32(pixel, kReflectanceStream), place).next_2d();
    const auto hit = rays_.closest_hit(RaySet::opaque, camera_ray(seen.x, seen.y, within));
    if (!hit) return std::nullopt;
    const SceneObject& object = scene_.objects[hit->object];
    const uint32_t material = material_of_triangle(object.mesh, hit->triangle);
    if (object.classes[material] != MaterialClass::skin || profile_at(*hit) != profile) return std::nullopt;
    const SurfaceAttributes surface = rays_.surface_at(*hit);
    return surface_[profile].reflectance_around({surface.p_world_mm, surface.n_geometry_world, hit->n_face},
                                                kReflectanceProbes,
                                                hash_u32(pixel, kReflectanceStream, place));
}

Vec3 PixelSampler::reflectance_around(const Seen& seen, size_t profile, const DiffusePoint& point,
                                      uint32_t seed) const {
    const size_t pixel = size_t(seen.y) * size_t(settings_.width) + size_t(seen.x);
    std::atomic<float>* const kept =
        &reflectance_[3 * (profile * size_t(settings_.width) * size_t(settings_.height) + pixel)];
    const Vec3 made = {kept[0].load(std::memory_order_relaxed), kept[1].load(std::memory_order_relaxed),
                       kept[2].load(std::memory_order_relaxed)};
    if (made.x > 0 && made.y > 0 && made.z > 0) return made;
    Vec3 sum;
    int places = 0;
    for (uint32_t place = 0; place < kReflectancePlaces; ++place)
        if (const std::optional<Vec3> found = reflectance_seen(seen, profile, place)) sum += *found, ++places;
    // A sliver that no place met: by its own point, for this sample alone.
    if (places == 0)
        return surface_[profile].reflectance_around(point, kReflectanceProbes,
                                                    hash_u32(seed, kReflectanceStream));
    const Vec3 mean = sum * (1 / float(places));
    kept[0].store(mean.x, std::memory_order_relaxed);
    kept[1].store(mean.y, std::memory_order_relaxed);
    kept[2].store(mean.z, std::memory_order_relaxed);
    return mean;
}

// Skin that scatters in part: the rest of its light leaves where it entered.
PixelSampler::DiffuseLight PixelSampler::diffuse_light(const Seen& seen, const ShadingPoint& point,
                                                       const UvFootprint& footprint,
                                                       const LightingRandom& random, uint32_t seed,
                                                       PixelSample& sample) const {
    const Receiver receiver = receiver_of(point);
    if (point.material_class != MaterialClass::skin)
        return {lighting_.irradiance(receiver, lighting_.choose(random)), {}};
    const float scatter = surface_.empty() && walk_.empty() ? 0 : point.scatter;
    const bool reflects = lighting_.settings().entry_eta > 1;  // where light enters the medium
    const bool measures = measure_ == Measure::effect;
    const int probes = probes_of(settings_);
    const int lights = settings_.integrator == Integrator::surface ? std::max(probes, kLeastLights) : probes;
    // Without scattering, all samples of a pixel have points of the lights that lie evenly together.
    if (scatter == 0)
        return {mean_irradiance(lighting_, receiver, seen.pixel_seed, lights, seen.index * uint32_t(lights)),
                {}};
    const auto own_light = [&](const Lighting& lighting) {
        return mean_irradiance(lighting, receiver, seed, lights);
    };
    const DiffusePoint diffuse{point.p_mm, point.n_geometry, point.n_face, footprint};
    const size_t profile = profile_at(seen.hit);
    if (walk_.empty()) {
        const Vec3 around = reflectance_around(seen, profile, diffuse, seed);
        const uint32_t first = seen.index * uint32_t(lights);
        const SurfaceIntegrator::Result found =
            surface_[profile].estimate(diffuse, receiver, around, {seen.pixel_seed, seen.index, first});
        const Vec3 scattered = found.scattered * scatter;
        if (measures || lights == probes) return {found.own + scattered, scattered};
        const float part = float(probes) / float(lights);
        const Vec3 others =
            mean_irradiance(lighting_, receiver, seen.pixel_seed, lights - probes, first + uint32_t(probes));
        return {mix(others, found.own, part) + scattered, scattered};
    }
    Vec3 own;
    if (scatter < 1 || subtracts_flat() || (measures && !reflects)) own = own_light(lighting_);
    const WalkIntegrator::Result walked = walk_[profile].exitance(diffuse, receiver, own, seed);
    sample.walks += probes;
    sample.lost_walks += walked.lost;
    const Vec3 exitance = own * (1 - scatter) + walked.exitance * scatter;
    if (!measures) return {exitance, {}};
    return {exitance, exitance - (reflects ? own_light(unscattered_lighting_) : own)};
}

MaterialClass PixelSampler::add_surface(const Seen& seen, Vec3 weight, uint32_t seed,
                                        PixelSample& sample) const {
    const Vec3 to_eye = -seen.ray.direction;
    SurfaceAttributes surface = rays_.surface_at(seen.hit);
    surface.footprint = footprint(seen, surface.p_world_mm);
    ShadingPoint point = materials_.shade(surface, seen.hit);
    face_the_eye(point, to_eye);
    OwenSequence uniform(seed, 0);
    const LightingRandom random{uniform.next_2d(), uniform.next_2d(), uniform.next_1d()};
    const DiffuseLight light = diffuse_light(seen, point, surface.footprint, random, seed, sample);
    const Vec3 leaves = point.albedo_linear * ((1 - point.metallic) * lighting_.diffuse_exit(point, to_eye) *
                                               (point.opacity / kPi));
    sample.diffuse += weight * (leaves * light.exitance + point.emission_linear);
    sample.scattered += weight * leaves * light.scattered;
    if (measure_ == Measure::picture)
        sample.specular += weight * lighting_.specular_radiance(point, to_eye, random);
    return point.material_class;
}

float PixelSampler::opacity_at(const RayHit& hit) const {
    const SceneObject& object = scene_.objects[hit.object];
    const uint32_t number = material_of_triangle(object.mesh, hit.triangle);
    const Material& material = object.mesh.materials[number];
    const bool blends = object.classes[number] == MaterialClass::other && is_blended(material);
    return blends ? material.opacity * rays_.alpha_at(hit) : 1;
}

// Translucent surfaces lie over what is behind them by their opacity, front to back. Returns what is left of
// `through`.
template <class Shade>
float PixelSampler::add_translucent(Seen seen, float through, uint32_t& seed, PixelSample& sample,
                                    const Shade& shade) const {
    for (int layer = 0; layer < kMostLayers && rays_.has(RaySet::translucent); ++layer) {
        const std::optional<RayHit> glass = rays_.closest_hit(RaySet::translucent, seen.ray);
        if (!glass) break;
        seen.hit = *glass;
        const SurfaceAttributes surface = rays_.surface_at(seen.hit);
        const float opacity = scene_.objects[glass->object].mesh.materials[surface.material].opacity;
        shade(seen, through, seed = hash_u32(seed), sample);
        sample.coverage += through * opacity;
        through *= 1 - opacity;
        seen.ray.min_mm = glass->distance_mm + 4 * rays_.epsilon_mm();
    }
    return through;
}

template <class Shade>
PixelSample PixelSampler::trace(uint32_t of_seed, int x, int y, uint32_t index, const Shade& shade) const {
    const uint32_t pixel = hash_u32(of_seed, uint32_t(x), uint32_t(y));
    const Vec2 within = place_in_pixel(pixel, index);
    Ray ray = camera_ray(x, y, within);
    PixelSample result;
    float through = 1;
    uint32_t seed = hash_u32(pixel, index + 1);
    // So do blended ones; the last that counts hides the rest.
    ray.blends = true;
    for (int layer = 1; layer <= kMostLayers; ++layer) {
        const std::optional<RayHit> solid = rays_.closest_hit(RaySet::opaque, ray);
        if (solid) ray.max_mm = solid->distance_mm;
        through = add_translucent({{}, ray, x, y, within, pixel, index}, through, seed, result, shade);
        if (!solid) break;
        const float opacity = layer < kMostLayers ? opacity_at(*solid) : 1;
        const MaterialClass seen = shade({*solid, ray, x, y, within, pixel, index}, through * opacity,
                                         seed = hash_u32(seed), result);
        result.coverage += through * opacity;
        if (seen == MaterialClass::skin) result.skin = through;
        if (opacity == 1) return result;
        through *= 1 - opacity;
        ray.min_mm = solid->distance_mm + 4 * rays_.epsilon_mm();
        ray.max_mm = Ray{}.max_mm;
    }
    const bool shown = scene_.environment.visible && !environment_.dark();
    result.background = (shown ? environment_.radiance(ray.direction) : scene_.background_linear) * through;
    return result;
}

PixelSample PixelSampler::sample(uint32_t of_seed, int x, int y, uint32_t index) const {
    return trace(of_seed, x, y, index,
                 [this](const Seen& seen, float weight, uint32_t seed, PixelSample& result) {
                     return add_surface(seen, Vec3{1, 1, 1} * weight, seed, result);
                 });
}

float PixelSampler::skin(uint32_t of_seed, int x, int y, uint32_t index) const {
    const auto class_of = [this](const Seen& seen, float, uint32_t, PixelSample&) {
        const SceneObject& object = scene_.objects[seen.hit.object];
        return object.classes[material_of_triangle(object.mesh, seen.hit.triangle)];
    };
    return trace(of_seed, x, y, index, class_of).skin;
}

}  // namespace dermis::inline reference
