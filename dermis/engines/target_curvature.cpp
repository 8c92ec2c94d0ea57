#include "dermis/engines/target_curvature.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/progress.h"
#include "dermis/mesh/curvature.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::inline engines {
namespace {

int8_t steps_of(float change_per_mm) {
    const float part = std::clamp(change_per_mm / kMostMeanCurvatureChange, -1.0f, 1.0f);
    return int8_t(std::lround(part * kCurvatureSteps));
}

}  // namespace

Result<std::vector<TargetCurvature>> target_curvatures(const SceneObject& object, const Pose& pose,
                                                       std::span<const std::string> names) {
    std::vector<TargetCurvature> all;
    const std::vector<CurvatureTensor>& in_pose = object.mesh.curvatures_per_mm;
    if (in_pose.empty() || !ScenePoser::can_pose(object)) return all;
    Scene alone;
    alone.objects = {object};
    DERMIS_TRY_ASSIGN(const ScenePoser poser, ScenePoser::create(alone));
    Progress progress("curvature of morph targets", names.size());
    for (const std::string& name : names) {
        const auto found = object.target_weights.find(name);
        const float before = found == object.target_weights.end() ? 0 : found->second,
                    after = before < 0.5f ? 1.0f : 0.0f;
        Pose changed = pose;
        changed.morph[name] = after;
        DERMIS_TRY(poser.pose(changed, alone));
        DERMIS_TRY_ASSIGN(const std::vector<CurvatureTensor> then, cached_curvature(alone.objects[0]));
        TargetCurvature target{.name = name, .changes = {}};
        for (size_t v = 0; v < then.size(); ++v)
            target.changes.push_back(
                steps_of((mean_curvature(then[v]) - mean_curvature(in_pose[v])) / (after - before)));
        if (std::ranges::any_of(target.changes, [](int8_t change) { return change != 0; }))
            all.push_back(std::move(target));
        progress.advance(1);
    }
    return all;
}

int curvature_rows(size_t vertex_count) {
    return (int(vertex_count) + kCurvaturePictureWidth - 1) / kCurvaturePictureWidth;
}

Image curvature_picture(std::span<const TargetCurvature> targets) {
    const int rows = curvature_rows(targets.front().changes.size());
    Image picture(kCurvaturePictureWidth, rows * int(targets.size()), 1, PixelFormat::u8);
    std::ranges::fill(picture.values<uint8_t>(), uint8_t(128));
    for (size_t t = 0; t < targets.size(); ++t)
        for (size_t v = 0; v < targets[t].changes.size(); ++v)
            picture.values<uint8_t>()[t * size_t(rows) * kCurvaturePictureWidth + v] =
                uint8_t(128 + targets[t].changes[v]);
    return picture;
}

}  // namespace dermis::inline engines
