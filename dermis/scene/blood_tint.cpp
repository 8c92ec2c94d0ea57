#include "dermis/scene/blood_tint.h"

#include <algorithm>
#include <cmath>

#include "dermis/mesh/tension.h"
#include "dermis/optics/tissue/pigment_table.h"
#include "dermis/optics/tissue/skin_model.h"

namespace dermis::inline scene {
namespace {

constexpr int kIntervals = 64;

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

template <class Change>
std::vector<Vec4> changed_colors(const SceneObject& object, std::span<const Vec4> from,
                                 const Change& change) {
    std::vector<Vec4> colors(from.begin(), from.end());
    colors.resize(object.mesh.positions_mm.size(), Vec4{1, 1, 1, 1});
    const std::vector<bool> is_skin = vertices_of_skin(object);
    for (size_t v = 0; v < colors.size(); ++v) {
        if (!is_skin[v]) continue;
        const Vec4 c = colors[v];
        const Vec3 changed = change(Vec3{c.x, c.y, c.z}, object.mesh.tensions[v]);
        colors[v] = {changed.x, changed.y, changed.z, c.w};
    }
    return colors;
}

}  // namespace

Result<std::optional<BloodTint>> BloodTint::of(const Skin& skin) {
    if (skin.blood_by_tension == 0) return std::optional<BloodTint>();
    if (!is_skin_model(skin.profile))
        return Error{
            "skin.blood_by_tension: needs a skin of pigments (skin.melanin or skin.blood, or their maps), "
            "and the skin's profile is '" +
            skin.profile + "'"};
    DERMIS_TRY_ASSIGN(const SkinModel model, parse_skin_model(skin.profile));
    const Vec3 at_rest = visible_albedo(model);
    BloodTint tint;
    for (int i = 0; i <= kIntervals; ++i) {
        const double tension = kMostTension * (2.0 * i / kIntervals - 1);
        SkinModel tense = model;
        tense.blood = std::min(model.blood * std::exp(-double(skin.blood_by_tension) * tension),
                               std::max(model.blood, kMostBlood));
        const Vec3 albedo = visible_albedo(tense);
        tint.samples_.push_back({albedo.x / at_rest.x, albedo.y / at_rest.y, albedo.z / at_rest.z});
    }
    return std::optional(std::move(tint));
}

Vec3 BloodTint::at(float tension) const {
    const float place = std::clamp((tension / kMostTension + 1) * 0.5f, 0.0f, 1.0f) * kIntervals;
    const int i = std::min(int(place), kIntervals - 1);
    return samples_[size_t(i)] + (samples_[size_t(i) + 1] - samples_[size_t(i)]) * (place - float(i));
}

std::vector<Vec4> untinted_colors(const SceneObject& object, const BloodTint& tint) {
    const Mesh& mesh = object.mesh;
    if (mesh.tensions.empty()) return mesh.colors_linear;
    return changed_colors(object, mesh.colors_linear, [&](Vec3 color, float tension) {
        const Vec3 by = tint.at(tension);
        return Vec3{color.x / by.x, color.y / by.y, color.z / by.z};
    });
}

void tint_by_tension(SceneObject& object, const BloodTint& tint, std::span<const Vec4> untinted) {
    if (object.mesh.tensions.empty()) return;
    object.mesh.colors_linear =
        changed_colors(object, untinted, [&](Vec3 color, float tension) { return color * tint.at(tension); });
}

Result<void> apply_blood_by_tension(Scene& scene) {
    DERMIS_TRY_ASSIGN(const std::optional<BloodTint> tint, BloodTint::of(scene.skin));
    if (!tint) return {};
    for (SceneObject& object : scene.objects)
        tint_by_tension(object, *tint, std::vector(object.mesh.colors_linear));
    return {};
}

}  // namespace dermis::inline scene
