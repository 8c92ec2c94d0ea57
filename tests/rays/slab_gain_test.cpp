#include "dermis/rays/slab_gain.h"

#include <gtest/gtest.h>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/guided_walk.h"

namespace dermis {
namespace {

TEST(SlabGain, AThinSlabPassesAllThatEntersAndAThickOneNothing) {
    const Profile skin = *find_profile("openpbr_skin_3");
    const HalfSpaceAlbedo flat = guided_half_space_albedo(walk_medium_of(skin), 30000, 5);
    EXPECT_NEAR(walked_slab_passes(skin, 1, 1e-4, 1 << 14, 2) * double(flat.mean.y), 1, 0.02);
    EXPECT_LT(walked_slab_passes(skin, 1, 40 * mean_radius_mm(skin, 1), 1 << 12, 2), 1e-3);
}

TEST(SlabGain, OneNumberAChannelHoldsForThicknessesUpToTheMeanRadius) {
    for (const char* name : {"openpbr_skin_1", "openpbr_skin_3", "openpbr_skin_6", "jensen_skin1"}) {
        const Profile skin = *find_profile(name);
        const Rgb gain = walked_slab_gain(skin);
        const HalfSpaceAlbedo flat = guided_half_space_albedo(walk_medium_of(skin), 30000, 5);
        const double albedo[] = {flat.mean.x, flat.mean.y, flat.mean.z};
        for (int c = 0; c < 3; ++c) {
            const auto over_profile = [&](double radii) {
                const double thickness_mm = radii * mean_radius_mm(skin, c);
                return walked_slab_passes(skin, c, thickness_mm, 1 << 14, 99) /
                       slab_passes(skin, c, thickness_mm);
            };
            for (const double radii : {0.25, 0.5, 1.0})
                EXPECT_NEAR(over_profile(radii) / gain[size_t(c)], 1, 0.2)
                    << name << ", " << radii << ", channel " << c;
            EXPECT_NEAR(over_profile(2) / gain[size_t(c)], 1, 0.45) << name << ", channel " << c;
            EXPECT_NEAR(gain[size_t(c)] * albedo[c], 1.5, 0.25) << name << ", channel " << c;
        }
    }
}

}  // namespace
}  // namespace dermis
