#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/scene/scene.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

TEST(LookText, says_what_differs_and_parses_back_to_it) {
    const Scene file;
    Scene seen = file;
    EXPECT_EQ(look_text(seen, file), "");
    seen.exposure_ev = 0.5f;
    seen.skin.albedo_tint_linear = {1, 0.9f, 0.8f};
    seen.skin.profile = "jensen_skin1";
    seen.tone_map = ToneMap::aces;
    seen.environment.visible = true;
    const std::string text = look_text(seen, file);
    EXPECT_EQ(text, "exposure_ev=0.5 tint=1,0.9,0.8 in_the_picture=1 tone_map=aces profile=jensen_skin1");
    Scene again = file;
    again.environment.intensity = 3;
    ASSERT_TRUE(parse_look(text, again));
    EXPECT_EQ(look_text(again, seen), "surroundings=3");  // what is not named stays
}

TEST(LookText, what_is_wrong_is_told_and_changes_nothing) {
    Scene scene;
    for (const auto& [text, told] : {std::pair("exposure_ev=1 tint=1", "tint is three numbers"),
                                     std::pair("exposure=1", "did you mean 'exposure_ev'?"),
                                     std::pair("exposure_ev=1 tone_map=ace", "did you mean 'aces'?"),
                                     std::pair("surroundings=nan", "from 0 to")}) {
        const Result<void> parsed = parse_look(text, scene);
        ASSERT_FALSE(parsed) << text;
        EXPECT_THAT(parsed.error().message, HasSubstr(told));
        EXPECT_EQ(look_text(scene, Scene()), "");
    }
}

}  // namespace
}  // namespace dermis
