#include <gtest/gtest.h>

#include <filesystem>

#include "bust/standard_bust.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/load_scene.h"
#include "subjects/bust/export.h"

namespace dermis {
namespace {

/// The shared bust with one small texel field for each map: encoding four 2048s is not what is tested.
Bust with_small_maps() {
    Bust bust = standard_bust();
    bust.albedo = Image(8, 8, 3, PixelFormat::u8, Encoding::srgb);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) bust.albedo.set(x, y, c, 0.8f - 0.2f * float(c));
    bust.normal = Image(8, 8, 3, PixelFormat::u8);
    bust.roughness = Image(8, 8, 1, PixelFormat::u8);
    bust.roughness.set(3, 2, 0, 0.4f);
    bust.specular = Image(8, 8, 1, PixelFormat::u8);
    bust.specular.set(5, 6, 0, 0.8f);
    bust.kernel_size = bust.melanin = bust.blood = Image(8, 8, 1, PixelFormat::u8);
    return bust;
}

TEST(BustExport, GlbReadsBackWithItsMapsInGltfsChannels) {
    const std::filesystem::path path = TestCache::folder() / "bust.glb";
    const Bust bust = with_small_maps();
    ASSERT_TRUE(write_bust(path, bust, *find_profile("gpu_gems_3")).ok());
    const Result<LoadedMesh> read = read_mesh(path);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->mesh.indices.size(), bust.mesh.indices.size());
    ASSERT_EQ(read->mesh.materials.size(), 1u);
    const Material& skin = read->mesh.materials[0];
    EXPECT_FALSE(skin.base_color_map.encoded.empty());
    EXPECT_FALSE(skin.normal_map.encoded.empty());
    const auto roughness = decode_image(skin.metallic_roughness_map.encoded, "roughness", ImageUse::data);
    ASSERT_TRUE(roughness.ok());
    EXPECT_NEAR(roughness->image.at(3, 2, 1), 0.4f, 0.002f);
    EXPECT_EQ(roughness->image.at(3, 2, 2), 0);
    const auto specular = decode_image(skin.specular_map.encoded, "specular", ImageUse::data);
    ASSERT_TRUE(specular.ok());
    EXPECT_NEAR(specular->image.at(5, 6, 3), 0.8f, 0.002f);
}

TEST(BustExport, GlbCarriesTheProfileThatItIsReadBackAs) {
    const std::filesystem::path path = TestCache::folder() / "bust_profile.glb";
    for (const char* name : {"gpu_gems_3", "openpbr_skin_5"}) {
        const Profile profile = *find_profile(name);
        ASSERT_TRUE(write_bust(path, with_small_maps(), profile));
        const Result<Profile> read = find_profile(path.string());
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(model_name(*read), model_name(profile));
        for (int c = 0; c < 3; ++c)
            for (const double r_mm : {0.1, 1.0, 10.0})
                EXPECT_EQ(reflectance_per_mm2(*read, c, r_mm), reflectance_per_mm2(profile, c, r_mm)) << name;
        const Result<Scene> scene = load_scene(path.string(), {});
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->skin.profile, path.string());
        // The head has the colours of light skin.
        for (const std::string& warning : scene->warnings)
            EXPECT_TRUE(name == std::string("openpbr_skin_5") &&
                        warning.find("choose a profile of its tone") != std::string::npos)
                << warning;
        EXPECT_EQ(scene->objects[0].classes[0], MaterialClass::skin);
    }
}

// A blur has no albedo: the volume that other programs read has that of the map.
TEST(BustExport, TheVolumeOfABlurHasTheAlbedoOfTheMap) {
    const std::filesystem::path path = TestCache::folder() / "bust_blur.glb";
    ASSERT_TRUE(write_bust(path, with_small_maps(), *find_profile("gpu_gems_3")));
    const Result<LoadedMesh> read = read_mesh(path);
    ASSERT_TRUE(read) << read.error().message;
    const Vec3 color = read->mesh.materials[0].scattering.value_or(Material::Scattering{}).multiscatter_color;
    EXPECT_NEAR(color.x, srgb_decode(0.8f), 0.004);
    EXPECT_NEAR(color.y, srgb_decode(0.6f), 0.004);
    EXPECT_NEAR(color.z, srgb_decode(0.4f), 0.004);
}

TEST(BustExport, MapsAreAFolderOfPngsThatASceneCanPaintItsSkinOf) {
    const std::filesystem::path folder = TestCache::folder() / "maps";
    ASSERT_TRUE(write_bust(TestCache::folder() / "bust_maps.obj", with_small_maps(),
                           *find_profile("gpu_gems_3"), folder));
    for (const std::string_view name : kBustMaps) EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    const auto residue = read_image(folder / "residue.png", ImageUse::data);
    ASSERT_TRUE(residue) << residue.error().message;
    EXPECT_EQ(residue->image.channels, 3);
    EXPECT_EQ(residue->image.format, PixelFormat::u16);
}

TEST(BustExport, AnUnknownExtensionIsRefusedAndNothingIsWritten) {
    const std::filesystem::path path = TestCache::folder() / "bust.stl";
    const Result<void> written = write_bust(path, with_small_maps(), *find_profile("gpu_gems_3"));
    ASSERT_FALSE(written.ok());
    EXPECT_NE(written.error().message.find(".glb or .obj"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace dermis
