// The changes of the curvature by morph targets against the curvature of the posed mesh.

#include "dermis/engines/target_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/file.h"
#include "dermis/mesh/curvature.h"
#include "dermis/render/complete_scene.h"
#include "support/built_in.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

constexpr float kStepPerMm = kMostMeanCurvatureChange / float(kCurvatureSteps);

class TargetCurvatureOfASheet : public testing::Test {
  protected:
    Scene lifted(float weight) const {
        const std::string file = (directory_.path / "sheet.gltf").string();
        EXPECT_TRUE(write_text_file(file, test::moving_sheet()));
        auto scene = load_scene(file, {.subjects = built_in_catalog().subjects,
                                       .words = {{"morph.lift", std::to_string(weight)}}});
        EXPECT_TRUE(scene) << scene.error().message;
        EXPECT_TRUE(complete_scene(*scene));
        return std::move(*scene);
    }
    static std::vector<TargetCurvature> targets_of(const Scene& scene) {
        const SceneObject& object = scene.objects[0];
        const auto found = target_curvatures(object, scene.motion.pose(), object.motion.targets);
        EXPECT_TRUE(found) << found.error().message;
        return found ? *found : std::vector<TargetCurvature>();
    }
    static std::vector<float> curvatures(const Scene& scene) {
        std::vector<float> all;
        for (const CurvatureTensor& tensor : scene.objects[0].mesh.curvatures_per_mm)
            all.push_back(mean_curvature(tensor));
        return all;
    }

    TemporaryDirectory directory_;
};

// The largest error of rest + weight * change, and of rest alone.
std::pair<float, float> errors(const std::vector<float>& rest, const TargetCurvature& target, float weight,
                               const std::vector<float>& posed) {
    float followed = 0, kept = 0;
    for (size_t v = 0; v < rest.size(); ++v) {
        const float change = weight * float(target.changes[v]) * kStepPerMm;
        followed = std::max(followed, std::abs(rest[v] + change - posed[v]));
        kept = std::max(kept, std::abs(rest[v] - posed[v]));
    }
    return {followed, kept};
}

}  // namespace

TEST_F(TargetCurvatureOfASheet, is_the_change_from_the_pose_to_the_target) {
    const Scene rest = lifted(0), half = lifted(0.5f), whole = lifted(1);
    for (const auto& [from, to, weight] : {std::tuple{&rest, &whole, 1.0f}, {&whole, &rest, -1.0f}}) {
        const std::vector<TargetCurvature> all = targets_of(*from);
        ASSERT_EQ(all.size(), 1u);
        EXPECT_EQ(all[0].name, "lift");
        const auto [followed, kept] = errors(curvatures(*from), all[0], weight, curvatures(*to));
        EXPECT_GT(kept, 0.01f);
        EXPECT_LT(followed, 0.6f * kStepPerMm);
        const auto [half_way, half_kept] = errors(curvatures(*from), all[0], 0.5f * weight, curvatures(half));
        EXPECT_LT(half_way, 0.3f * half_kept) << "nearly linear in the weight";
    }
}

TEST_F(TargetCurvatureOfASheet, is_nothing_of_what_does_not_move) {
    Scene scene = lifted(0);
    scene.objects[0].mesh.curvatures_per_mm.clear();
    EXPECT_TRUE(targets_of(scene).empty());
    EXPECT_TRUE(target_curvatures(scene.objects[0], {}, {})->empty());
}

TEST(TargetCurvaturePicture, has_the_rows_of_each_target_below_those_before) {
    std::vector<TargetCurvature> targets(2);
    for (TargetCurvature& target : targets) target.changes.resize(3000);
    targets[0].changes[2999] = -127;
    targets[1].changes[5] = 127;
    EXPECT_EQ(curvature_rows(3000), 2);
    Image picture = curvature_picture(targets);
    ASSERT_EQ(picture.width, kCurvaturePictureWidth);
    ASSERT_EQ(picture.height, 4);
    const auto at = [&](int x, int y) {
        return int(picture.values<uint8_t>()[size_t(y * picture.width + x)]);
    };
    EXPECT_EQ(at(2999 - kCurvaturePictureWidth, 1), 1);
    EXPECT_EQ(at(5, 2), 255);
    EXPECT_EQ(at(5, 0), 128);
    EXPECT_EQ(at(kCurvaturePictureWidth - 1, 3), 128);
}

}  // namespace dermis
