// Heads whose UVs Dermis has to lay out again are drawn as well as with one clean atlas.

#include <gtest/gtest.h>

#include "dermis/judge/comparison.h"
#include "render/render_test.h"
#include "support/uv_variants.h"

using namespace dermis;

namespace {

class AtlasShares : public RenderTest {
  protected:
    static constexpr const char* kTechniques =
        "lambert,texture_space_gaussians[gain=none],preintegrated[gain=none]";

    static Comparison compared(const Scene& scene, const std::vector<OwnPicture>& pictures, int samples) {
        const auto list = parse_technique_list(built_in_catalog().techniques, kTechniques);
        ComparisonSettings settings = comparison_settings(96, 96);
        settings.frames = 0;
        settings.grid = 3;
        settings.samples = samples;
        settings.pictures = pictures;
        Result<Comparison> made = compare_techniques(device(), built_in_catalog(), scene, *list, settings);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
};

}  // namespace

// Each picture of the same head with other UVs is judged beside that of the clean head.
TEST_F(AtlasShares, of_other_uvs_are_near_those_of_one_clean_atlas) {
    const Scene clean = bust_without_maps();
    std::vector<OwnPicture> pictures;
    for (const UvVariant& variant : uv_variants(clean)) {
        const Comparison drawn = compared(variant.scene, {}, 18);
        for (size_t i = 1; i < drawn.rows.size(); ++i)
            pictures.push_back(
                {variant.name + "-" + std::to_string(i), drawn.rows[i].radiance, drawn.rows[0].radiance});
    }
    const Comparison judged = compared(clean, pictures, 256);
    const size_t techniques = judged.rows.size() - pictures.size();
    for (size_t i = 0; i < pictures.size(); ++i) {
        const size_t row = 1 + i % (techniques - 1);
        const double share = judged.rows[techniques + i].first.captured.all.share,
                     of_clean = judged.rows[row].first.captured.all.share;
        const bool has_uvs = !pictures[i].name.starts_with("none");
        EXPECT_GT(share, of_clean - (has_uvs ? 0.03 : 0.08))
            << pictures[i].name << ", " << judged.rows[row].contestant.name() << ": " << share
            << ", of one clean atlas " << of_clean;
    }
}
