// Materials with a profile of their own, and with a weight of scattering, by each technique.

#include "dermis/scene/skin_profiles.h"

#include <gmock/gmock.h>

#include "dermis/mesh/primitives.h"
#include "dermis/render/profile_passes.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/skin_atlas.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

constexpr const char* kWide = "gpu_gems_3";
constexpr const char* kNarrow = "openpbr_skin_6";

class SkinProfiles : public RenderTest {
  protected:
    static inline const DrawSettings kSmall = {
        .width = 128, .height = 64, .view = "diffuse", .deep = true, .shadow_map_size = 512};

    // Two balls of skin side by side, each with a material.
    static Scene two_balls(const std::string& left, const std::string& right) {
        Scene scene;
        for (int i = 0; i < 2; ++i) {
            SceneObject ball{.name = "ball", .mesh = make_sphere(10, 48), .classes = {MaterialClass::skin}};
            for (Vec3& p : ball.mesh.positions_mm) p.x += i == 0 ? -14.0f : 14.0f;
            ball.mesh.materials[0].name = i == 0 ? "left" : "right";
            ball.mesh.materials[0].profile = i == 0 ? left : right;
            scene.objects.push_back(std::move(ball));
        }
        scene.skin.profile = kWide;
        place_in_studio(scene);
        scene.camera.vertical_fov_rad *= 0.6f;
        EXPECT_TRUE(complete_scene(scene));
        return scene;
    }

    static std::vector<std::string> scattering() {
        std::vector<std::string> ids;
        for (const Technique& technique : built_in_catalog().techniques)
            if (technique.id != "lambert" && technique.id != "oren_nayar") ids.push_back(technique.id);
        return ids;
    }

    static Image drawn(const Scene& scene, const std::string& id) {
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, built_in_technique(id), kSmall);
    }

    // Root mean square of the colours' differences in the columns of [begin, end).
    static double difference(const Image& a, const Image& b, int begin, int end) {
        double sum = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = begin; x < end; ++x)
                for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c) - b.at(x, y, c)), 2);
        return std::sqrt(sum / (3.0 * a.height * (end - begin)));
    }
};

}  // namespace

TEST_F(SkinProfiles, two_profiles_are_each_drawn_as_alone) {
    const Scene wide = two_balls("", ""), narrow = two_balls(kNarrow, kNarrow), both = two_balls("", kNarrow);
    EXPECT_THAT(skin_profiles(wide), testing::ElementsAre(kWide));
    EXPECT_THAT(skin_profiles(both), testing::ElementsAre(kWide, kNarrow));
    for (const std::string& id : scattering()) {
        const Image of_wide = drawn(wide, id), of_narrow = drawn(narrow, id), of_both = drawn(both, id);
        const int half = kSmall.width / 2;
        const double effect = difference(of_wide, of_narrow, 0, kSmall.width);
        EXPECT_GT(effect, 1e-3) << id << ": the profiles look the same";
        EXPECT_LT(difference(of_both, of_wide, 0, half), 0.01 * effect) << id;
        EXPECT_LT(difference(of_both, of_narrow, half, kSmall.width), 0.01 * effect) << id;
    }
}

TEST_F(SkinProfiles, skin_of_no_scatter_is_lambert_and_of_full_scatter_unchanged) {
    const Scene plain = two_balls("", "");
    Scene weighted = plain, lit = plain;
    weighted.objects[0].mesh.materials[0].scatter = 0;
    EXPECT_FALSE(has_scatter_weights(plain));
    EXPECT_TRUE(has_scatter_weights(weighted));
    const Image lambert = drawn(plain, "lambert");
    for (const std::string& id : scattering()) {
        const Image full = drawn(plain, id), part = drawn(weighted, id);
        const int half = kSmall.width / 2;
        const double effect = difference(full, lambert, 0, kSmall.width);
        EXPECT_LT(difference(part, lambert, 0, half), 0.05 * effect) << id;
        EXPECT_LT(difference(part, full, half, kSmall.width), 1e-3 * effect) << id;
    }
}

TEST_F(SkinProfiles, a_weight_in_between_mixes_both) {
    const Scene plain = two_balls("", "");
    Scene mixed = plain, none = plain;
    for (SceneObject& object : mixed.objects) object.mesh.materials[0].scatter = 0.25f;
    for (SceneObject& object : none.objects) object.mesh.materials[0].scatter = 0;
    for (const std::string& id : scattering()) {
        const Image full = drawn(plain, id), part = drawn(mixed, id), off = drawn(none, id);
        Image wanted = off;
        for (size_t i = 0; i < wanted.floats().size(); ++i)
            wanted.floats()[i] = 0.75f * off.floats()[i] + 0.25f * full.floats()[i];
        EXPECT_LT(difference(part, wanted, 0, kSmall.width), 0.01 * difference(full, off, 0, kSmall.width))
            << id;
    }
}

TEST_F(SkinProfiles, the_scatter_map_is_the_weight_of_each_texel) {
    const Scene plain = two_balls("", "");
    Scene mapped = plain, constant = plain;
    for (SceneObject& object : mapped.objects)
        object.mesh.materials[0].scatter_map = {.name = "half of scatter",
                                                .encoded = {},
                                                .width = 1,
                                                .height = 1,
                                                .channels = 1,
                                                .pixels = {std::byte{128}}};
    for (SceneObject& object : constant.objects) object.mesh.materials[0].scatter = 128 / 255.0f;
    for (const std::string& id : scattering()) {
        const Image a = drawn(mapped, id), b = drawn(constant, id);
        EXPECT_LT(difference(a, b, 0, kSmall.width), 0.01 * difference(drawn(plain, id), b, 0, kSmall.width))
            << id;
    }
}

TEST(JoinProfiles, give_each_list_images_tables_and_skin_of_its_own) {
    PassList list;
    list.images = {{.name = "blurred"}};
    list.passes = {
        {.name = "blur", .shader = "blur.frag", .reads = {"shadow_map"}, .colors = {{.image = "blurred"}}},
        {.name = "final",
         .kind = PassKind::geometry_screen,
         .shader = "final.frag",
         .reads = {"blurred", ImageRead("table", "named_table")},
         .colors = {{.image = "radiance"}}}};
    const PassList lists[] = {list, list};
    const std::vector<std::string> tables = {"profile_table", "named_table"};
    const PassList all = join_profiles(lists, tables);
    ASSERT_EQ(all.images.size(), 2u);
    EXPECT_EQ(all.images[1].name, "blurred@1");
    ASSERT_EQ(all.passes.size(), 4u);
    const Pass &blur = all.passes[2], &last = all.passes[3];
    EXPECT_EQ(blur.colors[0].image, "blurred@1");
    EXPECT_EQ(blur.reads[0].image, "shadow_map") << "an image of the frame";
    EXPECT_EQ(blur.reads[1].image, "profile_table@1");
    EXPECT_FALSE(blur.only_profile) << "it blurs the light of all skin";
    EXPECT_TRUE(last.only_profile);
    EXPECT_EQ(last.profile, 1);
    EXPECT_EQ(last.reads[0].texture, "blurred");
    EXPECT_EQ(last.reads[0].image, "blurred@1");
    EXPECT_EQ(last.reads[1].image, "named_table@1");
    EXPECT_EQ(join_profiles({lists, 1}, tables).passes[1].only_profile, false);
}
