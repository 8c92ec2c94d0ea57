#include "dermis/judge/reference_cache.h"

#include <cmath>
#include <cstring>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/optics/presets.h"

namespace dermis {
namespace {

// Part of every hash: to be raised when the ground truth's algorithm changes its pictures.
constexpr std::string_view kVersion = "reference 3";

void add(Hasher& hasher, Vec3 v) {
    hasher.add(v.x).add(v.y).add(v.z);
}

template <class T>
void add_all(Hasher& hasher, const std::vector<T>& values) {
    hasher.add(std::as_bytes(std::span(values)));
}

// Pixels and embedded bytes as they are, files by what is in them.
Result<void> add(Hasher& hasher, const ImageSource& source) {
    hasher.add(source.present());
    if (!source.present()) return {};
    hasher.add(source.width).add(source.height).add(source.channels);
    hasher.add(std::span(source.encoded)).add(std::span(source.pixels));
    if (!source.encoded.empty() || !source.pixels.empty()) return {};
    const Result<std::vector<std::byte>> file = read_file(source.name);
    if (!file) return file.error();
    hasher.add(std::span(*file));
    return {};
}

Result<void> add(Hasher& hasher, const Material& m) {
    add(hasher, m.base_color_linear);
    add(hasher, m.emission_linear);
    hasher.add(m.opacity).add(m.alpha_mode).add(m.roughness).add(m.metallic).add(m.specular).add(m.ior);
    hasher.add(m.double_sided).add(m.normal_space).add(m.normal_scale).add(m.dilate_texels);
    for (const ImageSource* source : {&m.base_color_map, &m.normal_map, &m.metallic_roughness_map,
                                      &m.specular_map, &m.occlusion_map, &m.opacity_map, &m.roughness_map})
        if (Result<void> added = add(hasher, *source); !added) return added;
    return {};
}

Result<void> add(Hasher& hasher, const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    add_all(hasher, mesh.positions_mm);
    add_all(hasher, mesh.normals);
    add_all(hasher, mesh.tangents);
    add_all(hasher, mesh.uvs);
    add_all(hasher, mesh.occlusions);
    add_all(hasher, mesh.indices);
    for (const Submesh& part : mesh.submeshes)
        hasher.add(part.first_index).add(part.index_count).add(part.material);
    for (const MaterialClass material_class : object.classes) hasher.add(material_class);
    for (const Material& material : mesh.materials)
        if (Result<void> added = add(hasher, material); !added) return added;
    return {};
}

void add(Hasher& hasher, const Light& light) {
    add(hasher, light.color_linear);
    add(hasher, light.to_light_world);
    add(hasher, light.position_mm);
    hasher.add(light.kind).add(light.intensity).add(light.inner_angle_rad).add(light.outer_angle_rad);
    hasher.add(light.is_key);
}

void add(Hasher& hasher, const Camera& camera) {
    add(hasher, camera.eye_mm);
    add(hasher, camera.target_mm);
    add(hasher, camera.up_world);
    hasher.add(camera.vertical_fov_rad).add(camera.near_mm).add(camera.far_mm);
}

Result<void> add(Hasher& hasher, const Environment& environment) {
    hasher.add(environment.kind).add(environment.intensity).add(environment.yaw_rad).add(environment.visible);
    if (environment.kind != EnvironmentKind::file) return {};
    const Result<std::vector<std::byte>> file = read_file(environment.file);
    if (!file) return file.error();
    hasher.add(std::span(*file));
    return {};
}

// What a profile is to the integrator: its values, whatever its model and name.
void add(Hasher& hasher, const Profile& profile) {
    hasher.add(profile.model.index());
    for (int channel = 0; channel < 3; ++channel)
        for (int i = 0; i <= 64; ++i)
            hasher.add(reflectance_per_mm2(profile, channel, std::pow(10.0, -3 + 5.0 * i / 64)));
    if (const auto* dipole = std::get_if<DipoleProfile>(&profile.model)) {
        for (const double sigma : dipole->medium.sigma_s_per_mm) hasher.add(sigma);
        for (const double sigma : dipole->medium.sigma_a_per_mm) hasher.add(sigma);
        hasher.add(dipole->medium.g).add(dipole->medium.eta);
    }
}

void add(Hasher& hasher, const ReferenceSettings& s) {
    hasher.add(s.integrator).add(s.width).add(s.height).add(s.samples).add(s.noise.value_or(0)).add(s.seed);
    hasher.add(s.probes).add(s.width_scale).add(s.normalisation).add(s.cavities).add(s.filter);
    hasher.add(s.filter == PixelFilter::grid ? s.grid : 0);
    hasher.add(s.lighting.shadows).add(s.lighting.ambient).add(s.lighting.specular);
    hasher.add(s.lighting.penumbra_mm).add(s.lighting.entry_eta);
    hasher.add(s.medium.has_value());
    if (!s.medium) return;
    for (const double sigma : s.medium->sigma_s_per_mm) hasher.add(sigma);
    for (const double sigma : s.medium->sigma_a_per_mm) hasher.add(sigma);
    hasher.add(s.medium->g).add(s.medium->eta);
}

// The stored picture: four numbers, then the floats of every image in this order.
struct Header {
    int32_t width = 0, height = 0, passes = 0, padding = 0;
    double relative_error = 0, time_ms = 0;
};

std::array<std::pair<Image ReferencePicture::*, int>, 6> layers() {
    return {{{&ReferencePicture::radiance, 4},
             {&ReferencePicture::diffuse, 3},
             {&ReferencePicture::specular, 3},
             {&ReferencePicture::variance, 3},
             {&ReferencePicture::samples, 1},
             {&ReferencePicture::skin, 1}}};
}

std::vector<std::byte> pack(const ReferencePicture& picture) {
    const Header header{.width = picture.radiance.width,
                        .height = picture.radiance.height,
                        .passes = picture.passes,
                        .relative_error = picture.relative_error,
                        .time_ms = picture.time_ms};
    std::vector<std::byte> bytes(sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
    for (const auto& [layer, channels] : layers())
        bytes.insert(bytes.end(), (picture.*layer).bytes.begin(), (picture.*layer).bytes.end());
    return bytes;
}

std::optional<ReferencePicture> unpack(const std::vector<std::byte>& bytes,
                                       const ReferenceSettings& settings) {
    Header header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.width != settings.width || header.height != settings.height) return std::nullopt;
    ReferencePicture picture{
        .relative_error = header.relative_error, .passes = header.passes, .time_ms = header.time_ms};
    size_t at = sizeof header;
    for (const auto& [layer, channels] : layers()) {
        Image image(header.width, header.height, channels);
        if (bytes.size() - at < image.bytes.size()) return std::nullopt;
        std::memcpy(image.bytes.data(), bytes.data() + at, image.bytes.size());
        at += image.bytes.size();
        picture.*layer = std::move(image);
    }
    return picture;
}

}  // namespace

Result<std::string> reference_hash(const Scene& scene, const ReferenceSettings& settings) {
    Hasher hasher;
    hasher.add(kVersion);
    for (const SceneObject& object : scene.objects)
        if (Result<void> added = add(hasher, object); !added) return added.error();
    for (const Light& light : scene.lights) add(hasher, light);
    add(hasher, scene.camera);
    if (Result<void> added = add(hasher, scene.environment); !added) return added.error();
    add(hasher, scene.skin.albedo_tint_linear);
    add(hasher, scene.background_linear);
    const Result<Profile> profile = find_profile(scene.skin.profile);
    if (!profile) return profile.error();
    add(hasher, *profile);
    add(hasher, settings);
    return hasher.hex();
}

Result<CachedReference> cached_reference(const Scene& scene, const ReferenceSettings& settings,
                                         const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    const Result<std::string> hash = reference_hash(scene, settings);
    if (!hash) return hash.error();
    if (const auto bytes = cache_load("reference", *hash))
        if (auto picture = unpack(*bytes, settings)) return CachedReference{std::move(*picture), true};
    Result<ReferencePicture> picture = render_reference(scene, settings, progress, stop);
    if (!picture) return picture.error();
    if (!stop || !stop->load()) cache_store("reference", *hash, pack(*picture));
    return CachedReference{std::move(*picture), false};
}

}  // namespace dermis
