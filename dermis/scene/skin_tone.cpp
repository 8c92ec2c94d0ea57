#include "dermis/scene/skin_tone.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/image_source.h"
#include "dermis/scene/placement.h"

namespace dermis::inline scene {
namespace {

constexpr float kMaxTint = 4;  // what a scene file allows

struct Mean {
    Vec3 sum;
    size_t count = 0;
    void add(Vec3 color) { sum += color, ++count; }
};

// Nearest texel.
Vec3 texel_at(const Image& image, Vec2 uv) {
    const auto index = [](float t, int size) { return std::clamp(int(t * float(size)), 0, size - 1); };
    const int x = index(uv.x, image.width), y = index(uv.y, image.height);
    const auto channel = [&](int c) {
        const float value = image.at(x, y, image.channels >= 3 ? c : 0);
        return image.encoding == Encoding::srgb ? srgb_decode(value) : value;
    };
    return {channel(0), channel(1), channel(2)};
}

Result<void> add_submesh(const Mesh& mesh, const Submesh& submesh, Mean& mean) {
    const Material& material = mesh.materials[submesh.material];
    Image map;
    if (material.base_color_map.present() && mesh.uvs.size() == mesh.positions_mm.size()) {
        DERMIS_TRY_ASSIGN(Image decoded, load_image_source(material.base_color_map, ImageUse::color));
        map = std::move(decoded);
    }
    for (uint32_t i = 0; i < submesh.index_count; ++i) {
        const uint32_t vertex = mesh.indices[submesh.first_index + i];
        mean.add(map.empty() ? material.base_color_linear
                             : material.base_color_linear *
                                   texel_at(map, inside_image(material.base_color_map, mesh.uvs[vertex])));
    }
    return {};
}

// The albedo of a profile whose colour is that of skin; nothing for blur kernels, which are white.
std::optional<Vec3> skin_albedo_of(const Skin& skin) {
    const Result<Profile> profile = find_profile(skin.profile);
    if (!profile) return std::nullopt;
    const Vec3 albedo = {float(diffuse_albedo(*profile, 0)), float(diffuse_albedo(*profile, 1)),
                         float(diffuse_albedo(*profile, 2))};
    constexpr float kWhite = 0.98f;
    if (!(albedo.x < kWhite && albedo.x > albedo.y && albedo.y > albedo.z)) return std::nullopt;
    return albedo;
}

std::string rounded(float value) {
    return to_text(std::round(value * 100) / 100);
}

std::string bright_profile(const Skin& skin) {
    const Result<Profile> profile = find_profile(skin.profile);
    if (!profile) return {};
    float most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, float(diffuse_albedo(*profile, c)));
    if (most <= 1.001f) return {};
    return "profile '" + skin.profile + "' has an albedo of " + rounded(most) +
           ", and skin reflects 1 at most; the albedo is the sum of the weights of Gaussians, or the "
           "integral "
           "of 2 pi r R(r) dr of a table in mm and 1/mm^2. Divide the values by it";
}

std::string other_tone(const Scene& scene) {
    const std::optional<Vec3> of_profile = skin_albedo_of(scene.skin);
    if (!of_profile) return {};
    const Result<Vec3> mean = mean_skin_albedo(scene);
    if (!mean) return {};
    constexpr float kFactor = 2;
    const float profile = luminance(*of_profile), skin = luminance(*mean * scene.skin.albedo_tint_linear);
    if (profile < kFactor * skin && skin < kFactor * profile) return {};
    return "skin.profile = \"" + scene.skin.profile + "\" is of skin with a luminance of " +
           rounded(profile) + ", and this skin has " + rounded(skin) +
           "; choose a profile of its tone, or set skin.tone = 1 (light) to 6 (dark) for both";
}

}  // namespace

Vec3 stated_tint(const Skin& skin) {
    const Vec3 tint = skin.albedo_tint_linear, loaded = skin.loaded_tint_linear;
    const auto rest = [](float all, float part) { return part > 0 ? all / part : 1; };
    return {rest(tint.x, loaded.x), rest(tint.y, loaded.y), rest(tint.z, loaded.z)};
}

std::string tone_profile(int tone) {
    return "openpbr_skin_" + std::to_string(tone);
}

Skin with_profile_of_tone(Skin skin) {
    if (skin.tone > 0 && skin.profile == Skin{}.profile) skin.profile = tone_profile(skin.tone);
    return skin;
}

Vec3 usual_skin_albedo(const Skin& skin) {
    constexpr Vec3 kLight = {0.70f, 0.43f, 0.32f};
    if (skin.tone > 0) return skin_tone_albedo_linear(skin.tone);
    return skin_albedo_of(skin).value_or(kLight);
}

Result<void> apply_tone(Scene& scene) {
    if (scene.skin.tone == 0) return {};
    const Result<Vec3> mean = mean_skin_albedo(scene);
    if (!mean) return mean.error().within("skin.tone");
    Skin& skin = scene.skin;
    skin.loaded_tint_linear = tint_towards(skin_tone_albedo_linear(skin.tone), *mean);
    skin.albedo_tint_linear = skin.albedo_tint_linear * skin.loaded_tint_linear;
    skin.loaded_tone = std::exchange(skin.tone, 0);
    return {};
}

std::vector<std::string> skin_warnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (std::string text : {surface_difference(scene.skin), bright_profile(scene.skin), other_tone(scene)})
        if (!text.empty()) warnings.push_back(std::move(text));
    return warnings;
}

Result<Vec3> mean_skin_albedo(const Scene& scene) {
    Mean mean;
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes)
            if (object.classes[submesh.material] == MaterialClass::skin)
                DERMIS_TRY(add_submesh(object.mesh, submesh, mean));
    if (mean.count == 0) return Error{scene.name + " has no skin to give a tone"};
    return mean.sum * (1.0f / float(mean.count));
}

Vec3 tint_towards(Vec3 albedo_linear, Vec3 mean_linear) {
    const auto ratio = [](float wanted, float mean) {
        return mean > 1e-4f ? std::clamp(wanted / mean, 0.0f, kMaxTint) : 1.0f;
    };
    return {ratio(albedo_linear.x, mean_linear.x), ratio(albedo_linear.y, mean_linear.y),
            ratio(albedo_linear.z, mean_linear.z)};
}

}  // namespace dermis::inline scene
