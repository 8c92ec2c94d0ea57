#include <gtest/gtest.h>

#include <filesystem>

#include "bust/standard_bust.h"
#include "dermis/image/io.h"
#include "dermis/mesh/read_mesh.h"
#include "subjects/bust/export.h"

namespace dermis {
namespace {

/// The shared bust with one small texel field for each map: encoding four 2048s is not what is tested.
Bust with_small_maps() {
    Bust bust = standard_bust();
    bust.albedo = Image(8, 8, 3, PixelFormat::u8, Encoding::srgb);
    bust.normal = Image(8, 8, 3, PixelFormat::u8);
    bust.roughness = Image(8, 8, 1, PixelFormat::u8);
    bust.roughness.set(3, 2, 0, 0.4f);
    bust.specular = Image(8, 8, 1, PixelFormat::u8);
    bust.specular.set(5, 6, 0, 0.8f);
    bust.kernel_size = Image(8, 8, 1, PixelFormat::u8);
    return bust;
}

TEST(BustExport, GlbReadsBackWithItsMapsInGltfsChannels) {
    const std::filesystem::path path = TestCache::folder() / "bust.glb";
    const Bust bust = with_small_maps();
    ASSERT_TRUE(write_bust(path, bust).ok());
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

TEST(BustExport, AnUnknownExtensionIsRefusedAndNothingIsWritten) {
    const std::filesystem::path path = TestCache::folder() / "bust.stl";
    const Result<void> written = write_bust(path, with_small_maps());
    ASSERT_FALSE(written.ok());
    EXPECT_NE(written.error().message.find(".glb or .obj"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace dermis
