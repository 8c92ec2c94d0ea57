// Profiles of glTF materials: what is written is read back, and what is wrong is named.

#include "dermis/optics/gltf_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// A document whose second material has these extensions.
std::string gltf_document(const std::string& extensions) {
    return R"({"asset":{"version":"2.0"},"meshes":[[[[[1]]]]],"materials":[{"name":"cloth"},)"
           R"({"name":"face","extensions":{)" +
           extensions + "}}]}";
}

const std::string kGltfVolume =
    R"("KHR_materials_volume":{"attenuationColor":[0.5,0.25,0.125],"attenuationDistance":0.001})";
const std::string kGltfScatter =
    R"("KHR_materials_volume_scatter":{"multiscatterColorFactor":[0.6,0.4,0.3]})";

std::string glb_of(const std::string& json) {
    const auto u32 = [](size_t value) {
        std::string text(4, '\0');
        for (size_t i = 0; i < 4; ++i) text[i] = char(value >> (8 * i) & 255);
        return text;
    };
    return "glTF" + u32(2) + u32(20 + json.size()) + u32(json.size()) + "JSON" + json;
}

Profile read_profile(const std::string& text) {
    const Result<Profile> profile = parse_gltf_profile(bytes_of(text), "head.glb");
    EXPECT_TRUE(profile) << profile.error().message;
    return profile ? *profile : Profile{};
}

std::string refusal_of(const std::string& text) {
    const Result<Profile> profile = parse_gltf_profile(bytes_of(text), "head.glb");
    EXPECT_FALSE(profile);
    return profile ? "" : profile.error().message;
}

}  // namespace

TEST(GltfProfile, the_attenuation_is_a_mean_free_path_in_metres) {
    for (const std::string& file : {gltf_document(kGltfVolume + "," + kGltfScatter),
                                    glb_of(gltf_document(kGltfVolume + "," + kGltfScatter))}) {
        const Profile profile = read_profile(file);
        EXPECT_EQ(profile.name, "face");
        const auto& burley = std::get<BurleyProfile>(profile.model);
        EXPECT_EQ(burley.albedo, (std::array{0.6, 0.4, 0.3}));
        const ScatteringMedium medium = medium_of(burley, 0, 1.4);
        for (int c = 0; c < 3; ++c)  // 1 mm / -ln(colour)
            EXPECT_NEAR(mean_free_path_mm(medium, c), 1 / ((c + 1) * std::log(2.0)), 1e-9);
        EXPECT_THAT(profile.source, HasSubstr("head.glb: material 'face', KHR_materials_volume_scatter"));
        EXPECT_THAT(profile.source, HasSubstr("linear Rec. 709"));
    }
}

TEST(GltfProfile, every_preset_comes_back_with_its_mean_radius) {
    const Rgb surface = {0.6, 0.45, 0.35};
    for (const std::string& name : profile_names()) {
        const Profile profile = *find_profile(name);
        const GltfVolume volume = gltf_volume(profile, surface);
        const auto list = [](const Rgb& c) {
            return "[" + to_text(c[0]) + "," + to_text(c[1]) + "," + to_text(c[2]) + "]";
        };
        const Profile back = read_profile(
            gltf_document(R"("KHR_materials_volume":{"attenuationColor":)" + list(volume.attenuation_color) +
                          R"(,"attenuationDistance":)" + to_text(volume.attenuation_distance_m) +
                          R"(},"KHR_materials_volume_scatter":{"multiscatterColorFactor":)" +
                          list(volume.multiscatter_color) + "}"));
        const BurleyProfile expected = burley_equivalent(profile);
        const bool blur = expected.albedo == Rgb{1, 1, 1};
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean_radius_mm(back, c), mean_radius_mm(profile, c), 1e-9) << name;
            EXPECT_NEAR(diffuse_albedo(back, c), (blur ? surface : expected.albedo)[size_t(c)], 1e-9) << name;
        }
        EXPECT_EQ(gltf_note(profile).find("is lost") == std::string::npos,
                  std::holds_alternative<BurleyProfile>(profile.model));
        EXPECT_EQ(gltf_note(profile).find("becomes that of the map") != std::string::npos, blur);
    }
}

TEST(GltfProfile, the_newer_extension_and_the_older_key_are_read) {
    const std::string newer =
        R"("KHR_materials_scatter":{"multiscatterColorFactor":[0.5,0.4,0.3],"scatterStrengthFactor":0.5})";
    EXPECT_NEAR(
        diffuse_albedo(read_profile(gltf_document(kGltfVolume + "," + kGltfScatter + "," + newer)), 0), 0.5,
        1e-12);
    EXPECT_THAT(read_profile(gltf_document(kGltfVolume + "," + newer)).source,
                HasSubstr("scatterStrengthFactor is read as 1"));
    const std::string older = R"("KHR_materials_volume_scatter":{"multiscatterColor":[0.7,0.4,0.3]})";
    EXPECT_NEAR(diffuse_albedo(read_profile(gltf_document(kGltfVolume + "," + older)), 0), 0.7, 1e-12);
}

TEST(GltfProfile, anisotropic_scattering_keeps_its_reduced_mean_free_path) {
    const double g = 0.8;
    const Profile isotropic = read_profile(gltf_document(kGltfVolume + "," + kGltfScatter));
    const Profile forward = read_profile(gltf_document(
        kGltfVolume +
        R"(,"KHR_materials_volume_scatter":{"multiscatterColorFactor":[0.6,0.4,0.3],"scatterAnisotropy":0.8})"));
    for (int c = 0; c < 3; ++c) {
        const double alpha = single_scatter_albedo_of(diffuse_albedo(forward, c), g);
        EXPECT_NEAR(mean_radius_mm(forward, c) * (1 - alpha * g), mean_radius_mm(isotropic, c), 1e-9);
    }
    EXPECT_THAT(forward.source, HasSubstr("isotropic scattering of the same reduced mean free path"));
}

TEST(GltfProfile, what_is_missing_or_wrong_is_named) {
    EXPECT_THAT(refusal_of("{}"), HasSubstr("head.glb: no material that scatters"));
    EXPECT_THAT(refusal_of("no json"), HasSubstr("no material that scatters"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfVolume)), HasSubstr("no material that scatters"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfScatter)), HasSubstr("without KHR_materials_volume"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfScatter +
                                         R"(,"KHR_materials_volume":{"attenuationColor":[0.5,0.5,0.5]})")),
                HasSubstr("material 'face' has no attenuationDistance"));
    EXPECT_THAT(
        refusal_of(gltf_document(kGltfScatter + R"(,"KHR_materials_volume":{"attenuationDistance":0.001})")),
        HasSubstr("has no attenuationColor"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfVolume + R"(,"KHR_materials_volume_scatter":{})")),
                HasSubstr("has no multiscatterColorFactor"));
    EXPECT_THAT(refusal_of(gltf_document(
                    kGltfVolume + R"(,"KHR_materials_volume_scatter":{"multiscatterColorFactor":[2,1,1]})")),
                HasSubstr("multiscatterColorFactor"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfVolume + R"(,"KHR_materials_scatter":{})")),
                HasSubstr("does not scatter"));
    EXPECT_THAT(refusal_of(gltf_document(kGltfVolume + "," + kGltfScatter).replace(0, 1, "glTF")),
                HasSubstr("GLB"));
    EXPECT_THAT(refusal_of("glTF"), HasSubstr("truncated"));
    const std::string deep = std::string(100000, '[');
    EXPECT_FALSE(parse_gltf_profile(bytes_of(R"({"materials":)" + deep), "a"));
}

TEST(GltfProfile, every_prefix_of_a_file_is_an_error_of_one_line) {
    const std::string file = glb_of(gltf_document(kGltfVolume + "," + kGltfScatter));
    for (size_t length = 0; length < file.size(); ++length) {
        const Result<Profile> profile = parse_gltf_profile(bytes_of(file).first(length), "head.glb");
        ASSERT_FALSE(profile) << length;
        EXPECT_EQ(profile.error().message.find('\n'), std::string::npos);
    }
}
