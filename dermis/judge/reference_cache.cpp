#include "dermis/judge/reference_cache.h"

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/judge/reference_version.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline judge {
namespace {

void add(Hasher& hasher, const ReferenceSettings& s) {
    hasher.add(s.integrator).add(s.width).add(s.height).add(s.samples).add(s.noise.value_or(0)).add(s.seed);
    hasher.add(probes_of(s)).add(s.width_scale).add(s.normalisation).add(s.cavities).add(s.filter);
    hasher.add(s.filter == PixelFilter::grid ? s.grid : 0);
    hasher.add(s.lighting.shadows).add(s.lighting.ambient).add(s.lighting.specular);
    hasher.add(s.lighting.penumbra_mm).add(s.lighting.entry_eta).add(s.entry);
    hasher.add(s.medium ? hash_of({.name = {}, .source = {}, .model = DipoleProfile{*s.medium}}) : "");
}

// What is stored of a picture, and one without content to load it into.
auto parts_of(ReferencePicture& picture) {
    return std::tie(picture.passes, picture.relative_error, picture.time_ms, picture.radiance.bytes,
                    picture.diffuse.bytes, picture.specular.bytes, picture.variance.bytes,
                    picture.samples.bytes, picture.skin.bytes);
}

ReferencePicture blank_picture(const ReferenceSettings& s) {
    const auto image = [&](int channels) { return Image(s.width, s.height, channels); };
    return {.radiance = image(4),
            .diffuse = image(3),
            .specular = image(3),
            .variance = image(3),
            .samples = image(1),
            .skin = image(1)};
}

}  // namespace

Result<std::string> reference_hash(const Scene& scene, const ReferenceSettings& settings) {
    Hasher hasher;
    hasher.add(reference_version());
    DERMIS_TRY_ASSIGN(const std::string content, hash_of(scene));
    hasher.add(content);
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    hasher.add(hash_of(profile));
    add(hasher, settings);
    return hasher.hex();
}

Result<CachedReference> cached_reference(const Scene& scene, const ReferenceSettings& settings,
                                         const ReferenceProgress& progress, const std::atomic<bool>* stop,
                                         const ReferencePreview& preview) {
    DERMIS_TRY_ASSIGN(const std::string hash, reference_hash(scene, settings));
    CachedReference found{blank_picture(settings), true};
    if (cache_load("reference", hash, parts_of(found.picture))) return found;
    DERMIS_TRY_ASSIGN(ReferencePicture picture, render_reference(scene, settings, progress, stop, preview));
    if (!stop || !stop->load()) cache_store("reference", hash, parts_of(picture));
    return CachedReference{std::move(picture), false};
}

}  // namespace dermis::inline judge
