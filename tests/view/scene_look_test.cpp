// The user's changes that are kept when a scene's files are read again.

#include "dermis/view/scene_look.h"
#include "support/built_in.h"

#include <gtest/gtest.h>

#include "dermis/scene/scene_words.h"

namespace dermis::view {
namespace {

struct Read {
    Scene before, seen, fresh;
    Read() {
        before = *load_built_in_scene("builtin:spheres");
        seen = fresh = before;
        EXPECT_TRUE(set_section(seen, "camera", "yaw_deg=40"));
        seen.lights[0].intensity = 2;
        seen.environment.yaw_rad = 1;
        seen.skin.profile = "jensen_skin1";
        seen.exposure_ev = 1;
    }
};

TEST(SceneLook, what_the_file_does_not_touch_stays_as_it_was_seen) {
    Read read;
    read.fresh.name = "renamed";
    keep_look(read.before, read.seen, read.fresh);
    EXPECT_EQ(camera_text(read.fresh.camera), camera_text(read.seen.camera));
    EXPECT_EQ(read.fresh.lights[0].intensity, 2);
    EXPECT_EQ(read.fresh.environment.yaw_rad, 1);
    EXPECT_EQ(read.fresh.skin.profile, "jensen_skin1");
    EXPECT_EQ(read.fresh.exposure_ev, 1);
    EXPECT_EQ(read.fresh.name, "renamed");
}

TEST(SceneLook, what_the_file_newly_says_replaces_a_change) {
    Read read;
    EXPECT_TRUE(set_section(read.fresh, "camera", "pitch_deg=10"));
    read.fresh.lights[0].intensity = 5;
    read.fresh.environment.intensity = 0.5f;
    read.fresh.skin.albedo_tint_linear = {0.5f, 1, 1};
    read.fresh.exposure_ev = -1;
    const Scene said = read.fresh;
    keep_look(read.before, read.seen, read.fresh);
    EXPECT_EQ(camera_text(read.fresh.camera), camera_text(said.camera));
    EXPECT_EQ(read.fresh.lights[0].intensity, 5);
    EXPECT_EQ(read.fresh.environment.yaw_rad, 0);
    EXPECT_EQ(read.fresh.skin.profile, said.skin.profile);
    EXPECT_EQ(read.fresh.exposure_ev, -1);
}

TEST(SceneLook, another_mesh_moves_no_camera) {
    Read read;
    EXPECT_TRUE(set_section(read.fresh, "camera", "distance_mm=999"));  // as framing a larger one does
    put_look(read.seen, read.fresh);
    EXPECT_EQ(camera_text(read.fresh.camera), camera_text(read.seen.camera));
}

}  // namespace
}  // namespace dermis::view
