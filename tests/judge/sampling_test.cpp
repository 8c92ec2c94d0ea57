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

    static Result<double> share_of(Renderer& renderer, const Contestant& contestant, const SubjectCase& one,
                                   int grid) {
        const ComparisonSettings settings = comparison_settings(kSide, kSide);
        const float penumbra_mm = settings.reference.lighting.penumbra_mm;
        PictureMaker maker(renderer, built_in_technique("lambert"),
                           {.width = kSide,
                            .height = kSide,
                            .grid = grid,
                            .shadow_map_size = settings.shadow_map_size,
                            .penumbra_mm = penumbra_mm});
        const Result<TechniquePictures> pictures = maker.make(contestant);
        if (!pictures) return pictures.error();
        const Result<Image> exact = exact_effect(one.scene, one.exact, kSide, kSide, grid, penumbra_mm);
        if (!exact) return exact.error();
        // Pixels that skin fills.
        Image mask(kSide, kSide, 1);
        for (size_t i = 0; i < mask.pixel_count(); ++i)
            mask.floats()[i] = pictures->radiance.floats()[4 * i + 3] >= 1 ? 1 : 0;
        const Result<Captured> share = captured(pictures->effect, {*exact, *exact}, mask);
        if (!share) return share.error();
        return share->all.share;
    }
};

}  // namespace

TEST_F(PixelGrids, from_16_to_36_points_of_a_pixel_no_share_moves_by_more_than_0_015) {
    const auto unit = find_subject(built_in_catalog().subjects, "unit");
    ASSERT_TRUE(unit);
    const auto cases = make_cases(**unit);
    ASSERT_TRUE(cases);
    const int standard = ComparisonSettings{}.grid, finer = 6;  // 16 and 36 points
    for (const SubjectCase& one : *cases) {
        if (one.name != "unit/sphere" && one.name != "unit/shadow_edge" && one.name != "unit/relief_0.5mm")
            continue;
        auto renderer =
            Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), one.scene);
        ASSERT_TRUE(renderer) << renderer.error().message;
        const auto list = parse_technique_list(built_in_catalog().techniques,
                                               "preintegrated,texture_space,texture_space_gaussians");
        ASSERT_TRUE(list);
        for (const Contestant& contestant : *list) {
            const auto before = share_of(*renderer, contestant, one, standard),
                       after = share_of(*renderer, contestant, one, finer);
            ASSERT_TRUE(before) << before.error().message;
            ASSERT_TRUE(after) << after.error().message;
            EXPECT_NEAR(*before, *after, 0.015) << one.name << ", " << contestant.name();
            std::printf("%-20s %-24s %7.3f %7.3f\n", one.name.c_str(), contestant.name().c_str(), *before,
                        *after);
        }
    }
}
