#include "dermis/judge/reference_cache.h"

#include <cmath>
#include <cstring>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/judge/reference_version.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline judge {
namespace {

// The integrator's view of a profile: its values, whatever its model and name.
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
    hasher.add(reference_version());
    DERMIS_TRY_ASSIGN(const std::string content, hash_of(scene));
    hasher.add(content);
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    add(hasher, profile);
    add(hasher, settings);
    return hasher.hex();
}

Result<CachedReference> cached_reference(const Scene& scene, const ReferenceSettings& settings,
                                         const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    DERMIS_TRY_ASSIGN(const std::string hash, reference_hash(scene, settings));
    if (const auto bytes = cache_load("reference", hash))
        if (auto picture = unpack(*bytes, settings)) return CachedReference{std::move(*picture), true};
    DERMIS_TRY_ASSIGN(ReferencePicture picture, render_reference(scene, settings, progress, stop));
    if (!stop || !stop->load()) cache_store("reference", hash, pack(picture));
    return CachedReference{std::move(picture), false};
}

}  // namespace dermis::inline judge
