#include "dermis/scene/blood_tint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/text.h"
#include "dermis/image/image.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "dermis/optics/tissue/pigment_table.h"
#include "dermis/optics/tissue/skin_model.h"

namespace dermis::inline scene {
namespace {

// The table covers factors of the blood from e^-8 to e^8. Smaller ones leave no colour of blood; larger ones
// exceed kMostBlood.
constexpr float kMostLogBlood = 8;
constexpr int kIntervals = 128;

// Colours outside of Rec. 709 have channels of 0 and below.
Vec3 visible_albedo(const SkinModel& model) {
    const Rgb albedo = skin_albedo(model);
    const auto channel = [](double value) { return std::max(float(value), 1e-3f); };
    return {channel(albedo[0]), channel(albedo[1]), channel(albedo[2])};
}

std::vector<bool> vertices_of_skin(const SceneObject& object) {
    std::vector<bool> is_skin(object.mesh.positions_mm.size());
    for (const Submesh& submesh : object.mesh.submeshes) {
        if (object.classes[submesh.material] != MaterialClass::skin) continue;
        for (uint32_t i = 0; i < submesh.index_count; ++i)
            is_skin[object.mesh.indices[submesh.first_index + i]] = true;
    }
    return is_skin;
}

// Logarithm of the blood's factor at each vertex.
std::vector<float> log_blood_of(const SceneObject& object, const Skin& skin) {
    std::vector<float> all(object.mesh.positions_mm.size());
    for (size_t v = 0; v < object.mesh.tensions.size(); ++v)
        all[v] = -skin.blood_by_tension * object.mesh.tensions[v];
    for (const auto& [target, changes] : object.blood_by_target) {
        const auto weight = object.target_weights.find(target);
        if (weight == object.target_weights.end()) continue;
        for (size_t v = 0; v < all.size(); ++v) all[v] += weight->second * changes[v];
    }
    return all;
}

// Without a pose no vertex needs a colour for its blood.
bool has_tint(const SceneObject& object) {
    const auto weighs = [&](const auto& change) { return object.target_weights.contains(change.first); };
    return !object.mesh.tensions.empty() || std::ranges::any_of(object.blood_by_target, weighs);
}

template <class Change>
std::vector<Vec4> changed_colors(const SceneObject& object, const Skin& skin, std::span<const Vec4> from,
                                 const Change& change) {
    std::vector<Vec4> colors(from.begin(), from.end());
    colors.resize(object.mesh.positions_mm.size(), Vec4{1, 1, 1, 1});
    const std::vector<bool> is_skin = vertices_of_skin(object);
    const std::vector<float> log_blood = log_blood_of(object, skin);
    for (size_t v = 0; v < colors.size(); ++v) {
        if (!is_skin[v]) continue;
        const Vec4 c = colors[v];
        const Vec3 changed = change(Vec3{c.x, c.y, c.z}, log_blood[v]);
        colors[v] = {changed.x, changed.y, changed.z, c.w};
    }
    return colors;
}

// Outside of 0..1 a map repeats.
float repeated(float coordinate) {
    return coordinate >= 0 && coordinate <= 1 ? coordinate : coordinate - std::floor(coordinate);
}

}  // namespace

Result<std::optional<BloodTint>> BloodTint::of(const Skin& skin) {
    if (!skin.blood_moves()) return std::optional<BloodTint>();
    if (!is_skin_model(skin.profile))
        return Error{
            std::string(skin.blood_by_tension != 0 ? "skin.blood_by_tension" : "skin.blood_by_target") +
            ": needs a skin of pigments (skin.melanin or skin.blood, or their maps), and the skin's profile "
            "is '" +
            skin.profile + "'"};
    DERMIS_TRY_ASSIGN(const SkinModel model, parse_skin_model(skin.profile));
    const Vec3 at_rest = visible_albedo(model);
    BloodTint tint;
    for (int i = 0; i <= kIntervals; ++i) {
        SkinModel changed = model;
        changed.blood = std::min(model.blood * std::exp(double(kMostLogBlood) * (2.0 * i / kIntervals - 1)),
                                 std::max(model.blood, kMostBlood));
        const Vec3 albedo = visible_albedo(changed);
        tint.samples_.push_back({albedo.x / at_rest.x, albedo.y / at_rest.y, albedo.z / at_rest.z});
    }
    return std::optional(std::move(tint));
}

Vec3 BloodTint::at(float log_blood) const {
    const float place = std::clamp((log_blood / kMostLogBlood + 1) * 0.5f, 0.0f, 1.0f) * kIntervals;
    const int i = std::min(int(place), kIntervals - 1);
    return samples_[size_t(i)] + (samples_[size_t(i) + 1] - samples_[size_t(i)]) * (place - float(i));
}

Result<void> add_blood_by_target(const std::string& target, const std::filesystem::path& map, Scene& scene) {
    std::vector<std::string> targets;
    for (const SceneObject& object : scene.objects)
        targets.insert(targets.end(), object.motion.targets.begin(), object.motion.targets.end());
    if (std::ranges::count(targets, target) == 0)
        return Error{targets.empty() ? "no mesh has morph targets"
                                     : unknown_name("morph target", target, targets)};
    DERMIS_TRY_ASSIGN(const LoadedImage read, read_image(map, ImageUse::data));
    const Image image = to_linear_float(read.image);
    for (SceneObject& object : scene.objects) {
        if (std::ranges::count(object.motion.targets, target) == 0) continue;
        if (object.mesh.uvs.empty()) return Error{"'" + object.name + "' has no UVs to place a map by"};
        std::vector<float>& changes = object.blood_by_target[target];
        for (const Vec2 uv : object.mesh.uvs)
            changes.push_back((sample_bilinear(image, {repeated(uv.x), repeated(uv.y)}).x - 0.5f) * 4 *
                              std::numbers::ln2_v<float>);
    }
    return {};
}

std::vector<Vec4> untinted_colors(const SceneObject& object, const Skin& skin, const BloodTint& tint) {
    const Mesh& mesh = object.mesh;
    if (!has_tint(object)) return mesh.colors_linear;
    return changed_colors(object, skin, mesh.colors_linear, [&](Vec3 color, float log_blood) {
        const Vec3 by = tint.at(log_blood);
        return Vec3{color.x / by.x, color.y / by.y, color.z / by.z};
    });
}

void tint_by_blood(SceneObject& object, const Skin& skin, const BloodTint& tint,
                   std::span<const Vec4> untinted) {
    if (!has_tint(object)) return;
    object.mesh.colors_linear = changed_colors(
        object, skin, untinted, [&](Vec3 color, float log_blood) { return color * tint.at(log_blood); });
}

Result<void> apply_moving_blood(Scene& scene) {
    DERMIS_TRY_ASSIGN(const std::optional<BloodTint> tint, BloodTint::of(scene.skin));
    if (!tint) return {};
    for (SceneObject& object : scene.objects)
        tint_by_blood(object, scene.skin, *tint, std::vector(object.mesh.colors_linear));
    return {};
}

}  // namespace dermis::inline scene
