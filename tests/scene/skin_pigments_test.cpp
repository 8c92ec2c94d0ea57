#include "dermis/scene/skin_pigments.h"

#include <gtest/gtest.h>

#include <string>

#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/scene/skin_tone.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

const std::string kPigmentMesh = "[[mesh]]\nfile = \"one.obj\"\nunit_mm = 100\n";

struct PigmentDirectory : TemporaryDirectory {
    Result<Scene> load(const std::string& toml) const {
        const char* mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl face\nf 1/1 2/2 3/3\n";
        DERMIS_TRY(write_text_file(path / "one.obj", mesh));
        DERMIS_TRY(write_text_file(path / "s.toml", toml));
        return load_built_in_scene((path / "s.toml").string());
    }
    std::string file(const char* name) const { return (path / name).string(); }
};

std::string pigment_warnings(const Scene& scene) {
    std::string all;
    for (const std::string& warning : scene.warnings) all += warning + "\n";
    return all;
}

TEST(SkinPigments, skin_from_pigments_has_the_colour_and_the_profile_of_the_model) {
    const PigmentDirectory dir;
    const std::string face = kPigmentMesh + "[material.face]\nalbedo = [0.7, 0.5, 0.4]\n[skin]\n";
    const auto scene = dir.load(face + "melanin = 0.1\nblood = 0.03\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->skin.profile, "skin:melanin=0.1,blood=0.03");
    const Rgb albedo = skin_albedo({.melanin = 0.1, .blood = 0.03});
    const Result<Vec3> mean = mean_skin_albedo(*scene);
    ASSERT_TRUE(mean);
    EXPECT_NEAR(mean->y * scene->skin.albedo_tint_linear.y, albedo[1], 1e-4);
    EXPECT_EQ(pigment_warnings(*scene).find("skin.profile"), std::string::npos) << pigment_warnings(*scene);
    const auto own = dir.load(face + "melanin = 0.1\nprofile = \"jensen_skin1\"\n");
    ASSERT_TRUE(own);
    EXPECT_EQ(own->skin.profile, "jensen_skin1");
    const auto twice = dir.load(face + "melanin = 0.1\ntone = 3\n");
    ASSERT_FALSE(twice);
    EXPECT_NE(twice.error().message.find("state one colour twice"), std::string::npos);
    const auto beyond = dir.load(face + "oxygen = 1.5\n");
    ASSERT_FALSE(beyond);
    EXPECT_NE(beyond.error().message.find("skin.oxygen"), std::string::npos) << beyond.error().message;
}

TEST(SkinPigments, maps_of_pigments_paint_the_skin_and_choose_its_profile) {
    const PigmentDirectory dir;
    Image melanin(4, 4, 1, PixelFormat::u8), blood(4, 4, 1, PixelFormat::u8), mask(4, 4, 1, PixelFormat::u8);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            melanin.set(x, y, 0, 0.2f), blood.set(x, y, 0, 0.4f);
            mask.set(x, y, 0, x < 2 ? 0.0f : 1.0f);
        }
    ASSERT_TRUE(write_image(dir.file("melanin.png"), melanin) && write_image(dir.file("blood.png"), blood) &&
                write_image(dir.file("mask.png"), mask));
    const std::string maps = kPigmentMesh + "[maps]\nmelanin = \"melanin.png\"\nblood = \"blood.png\"\n";
    const auto red_over_green = [](const Scene& scene, size_t texel) {
        const auto& pixels = scene.objects[0].mesh.materials[0].base_color_map.pixels;
        return float(pixels[3 * texel]) / float(pixels[3 * texel + 1]);
    };
    const auto scene = dir.load(maps);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->skin.profile, "skin:blood=0.032") << "0.2 * 0.4^2, and 0.5 * 0.2^2 is the default";
    const auto flushed = dir.load(maps + "pigment_mask = \"mask.png\"\n[skin]\nblood_scale = 3\n");
    ASSERT_TRUE(flushed) << flushed.error().message;
    EXPECT_GT(red_over_green(*flushed, 3), red_over_green(*scene, 3) + 0.1f);
    EXPECT_EQ(red_over_green(*flushed, 0), red_over_green(*scene, 0));
    const auto missing = dir.load(kPigmentMesh + "[maps]\nblood = \"none.png\"\n");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("none.png"), std::string::npos);
    EXPECT_NE(pigment_warnings(*dir.load(kPigmentMesh + "[skin]\nblood_scale = 2\n"))
                  .find("have no effect without"),
              std::string::npos);
}

ImageSource grey_texel(const char* name, int code) {
    return {.name = name, .encoded = {}, .width = 1, .height = 1, .channels = 1, .pixels = {std::byte(code)}};
}

// A subject's skin whose colour was made of pigments, as the built-in head's.
Scene painted_by_code() {
    Scene scene = load_built_in_scene("builtin:spheres").value();
    for (SceneObject& object : scene.objects)
        for (Material& material : object.mesh.materials) {
            material.base_color_map = {.name = "painted",
                                       .encoded = {},
                                       .width = 1,
                                       .height = 1,
                                       .channels = 3,
                                       .pixels = {std::byte{200}, std::byte{150}, std::byte{120}}};
            material.melanin_map = grey_texel("own melanin", 51),
            material.blood_map = grey_texel("own blood", 77);
        }
    return scene;
}
std::vector<int> colour_of(const Scene& scene) {
    std::vector<int> codes;
    for (const std::byte b : scene.objects[0].mesh.materials[0].base_color_map.pixels.span())
        codes.push_back(int(b));
    return codes;
}

TEST(SkinPigments, a_subjects_own_pigments_act_only_where_the_scene_changes_them) {
    Scene plain = painted_by_code();
    const std::string profile = plain.skin.profile;
    ASSERT_TRUE(apply_pigment_maps(plain));
    EXPECT_EQ(colour_of(plain), (std::vector{200, 150, 120}));
    EXPECT_EQ(plain.skin.profile, profile);

    Scene flushed = painted_by_code();
    flushed.skin.blood_scale = 2;
    ASSERT_TRUE(apply_pigment_maps(flushed));
    const std::vector<int> red = colour_of(flushed);
    EXPECT_LT(red[1], 140) << "more blood takes green";
    EXPECT_GT(red[0], 185) << "and leaves red";
    EXPECT_EQ(flushed.skin.profile, "skin:blood=0.0182") << "0.2 * (77 / 255)^2; melanin is the default";
    EXPECT_TRUE(flushed.files.empty());

    Scene moving = painted_by_code();
    moving.skin.blood_by_tension = 1;
    ASSERT_TRUE(apply_pigment_maps(moving));
    EXPECT_EQ(colour_of(moving), (std::vector{200, 150, 120}));
    EXPECT_TRUE(is_skin_model(moving.skin.profile));

    Scene stated = painted_by_code();
    stated.skin.blood_scale = 2, stated.skin.blood = 0.05f;
    ASSERT_TRUE(apply_pigment_maps(stated));
    EXPECT_EQ(colour_of(stated), (std::vector{200, 150, 120}));
    EXPECT_NE(pigment_warnings(stated).find("beside skin.melanin or skin.blood"), std::string::npos);

    Scene other_map = painted_by_code();
    other_map.skin.blood_scale = 2;
    for (SceneObject& object : other_map.objects)
        for (Material& material : object.mesh.materials) material.base_color_map = {.name = "photograph.png"};
    ASSERT_TRUE(apply_pigment_maps(other_map));
    EXPECT_EQ(other_map.objects[0].mesh.materials[0].base_color_map.name, "photograph.png");
}

}  // namespace
}  // namespace dermis
