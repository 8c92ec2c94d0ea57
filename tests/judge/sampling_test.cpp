// How many points of a pixel are enough: shares against exact answers, which have no noise.

#include "dermis/judge/comparison.h"
#include "dermis/judge/exact_effect.h"
#include "dermis/judge/technique_pictures.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

class PixelGrids : public RenderTest {
  protected:
    static constexpr int kSide =
        64;  // a shadow's edge wants pixels below 0.2 mm: at 0.3 mm shares move by .03

    static std::vector<double> shares_of(Renderer& renderer, std::span<const Contestant> contestants,
                                         const SubjectCase& one, int grid) {
        const ComparisonSettings settings = comparison_settings(kSide, kSide);
        const float penumbra_mm = settings.reference.lighting.penumbra_mm;
        PictureMaker maker(renderer, built_in_technique("lambert"),
                           {.width = kSide,
                            .height = kSide,
                            .grid = grid,
                            .shadow_map_size = settings.shadow_map_size,
                            .penumbra_mm = penumbra_mm});
        const Result<Image> exact = exact_effect(one.scene, one.exact, kSide, kSide, grid, penumbra_mm);
        EXPECT_TRUE(exact) << exact.error().message;
        std::vector<double> shares;
        for (const Contestant& contestant : contestants) {
            const Result<TechniquePictures> pictures = maker.make(contestant);
            EXPECT_TRUE(pictures) << pictures.error().message;
            // Pixels that skin fills.
            Image mask(kSide, kSide, 1);
            for (size_t i = 0; i < mask.pixel_count(); ++i)
                mask.floats()[i] = pictures->radiance.floats()[4 * i + 3] >= 1 ? 1 : 0;
            const Result<Captured> share = captured(pictures->effect, {*exact, *exact}, mask);
            EXPECT_TRUE(share) << share.error().message;
            shares.push_back(share->all.share);
        }
        return shares;
    }
};

}  // namespace

TEST_F(PixelGrids, nearly_twice_the_points_of_a_pixel_move_no_share_by_more_than_a_hundredth) {
    const auto unit = find_subject(built_in_catalog().subjects, "unit");
    ASSERT_TRUE(unit);
    const auto cases = make_cases(**unit);
    ASSERT_TRUE(cases);
    const auto list = parse_technique_list(built_in_catalog().techniques,
                                           "preintegrated,texture_space,texture_space_gaussians");
    ASSERT_TRUE(list);
    const int standard = ComparisonSettings{}.grid, finer = 8;
    ASSERT_EQ(standard, 6);
    for (const SubjectCase& one : *cases) {
        if (one.name != "unit/sphere" && one.name != "unit/shadow_edge" && one.name != "unit/relief_0.5mm")
            continue;
        auto renderer =
            Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), one.scene);
        ASSERT_TRUE(renderer) << renderer.error().message;
        const std::vector<double> before = shares_of(*renderer, *list, one, standard),
                                  after = shares_of(*renderer, *list, one, finer);
        for (size_t i = 0; i < list->size(); ++i) {
            EXPECT_NEAR(before[i], after[i], 0.01) << one.name << ", " << (*list)[i].name();
            std::printf("%-20s %-24s %7.3f %7.3f\n", one.name.c_str(), (*list)[i].name().c_str(), before[i],
                        after[i]);
        }
    }
}
