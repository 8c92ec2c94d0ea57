#pragma once
// Captured shares of techniques held against an exact answer, which has no noise.

#include <gtest/gtest.h>

#include "dermis/judge/comparison.h"
#include "dermis/judge/effect_reference.h"
#include "dermis/judge/technique_pictures.h"
#include "dermis/render/complete_scene.h"
#include "dermis/technique/gain.h"
#include "support/built_in.h"

namespace dermis {

/// One case of the built-in subject `unit`.
inline SubjectCase unit_case(const std::string& name) {
    const auto unit = find_subject(built_in_catalog().subjects, "unit");
    auto cases = make_cases(**unit);
    EXPECT_TRUE(cases) << cases.error().message;
    const auto found = std::ranges::find(*cases, "unit/" + name, &SubjectCase::name);
    EXPECT_NE(found, cases->end()) << name;
    EXPECT_TRUE(complete_scene(found->scene));
    return std::move(*found);
}

/// In the order of the contestants, over the pixels that skin fills; a picture of `side` x `side` pixels with
/// `grid` x `grid` points each.
inline std::vector<double> exact_shares(Renderer& renderer, std::span<const Contestant> contestants,
                                        const Scene& scene, const ExactExitance& answer, int side, int grid) {
    const ComparisonSettings settings = comparison_settings(side, side);
    const float penumbra_mm = settings.reference.lighting.penumbra_mm;
    PictureMaker maker(renderer, built_in_technique("lambert"),
                       {.width = side,
                        .height = side,
                        .grid = grid,
                        .shadow_map_size = settings.shadow_map_size,
                        .penumbra_mm = penumbra_mm});
    const Result<Image> exact = exact_effect(scene, answer, side, side, grid, penumbra_mm);
    EXPECT_TRUE(exact) << exact.error().message;
    std::vector<double> shares;
    for (Contestant contestant : contestants) {
        contestant.values = without_gain(contestant.values);  // the answers are the profile's
        const Result<TechniquePictures> pictures = maker.make(contestant);
        EXPECT_TRUE(pictures) << pictures.error().message;
        Image mask(side, side, 1);
        for (size_t i = 0; i < mask.pixel_count(); ++i)
            mask.floats()[i] = pictures->radiance.floats()[4 * i + 3] >= 1 ? 1 : 0;
        const Result<Captured> share = captured(pictures->effect, {*exact, *exact}, mask);
        EXPECT_TRUE(share) << share.error().message;
        shares.push_back(share->all.share);
    }
    return shares;
}

}  // namespace dermis
