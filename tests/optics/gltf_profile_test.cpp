// Profiles of glTF materials: what is written is read back, and what is wrong is named.

#include "dermis/optics/gltf_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/profile_file.h"

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

std::string list(const Rgb& c) {
    return "[" + to_text(c[0]) + "," + to_text(c[1]) + "," + to_text(c[2]) + "]";
}

// A material with the volume of one profile and the extras of the other.
std::string document_of(const Profile& volume_of, const std::string& extras) {
    const GltfVolume volume = gltf_volume(volume_of, {0.6, 0.45, 0.35});
    return R"({"materials":[{"name":"face","extras":)" + extras +
           R"(,"extensions":{"KHR_materials_volume":{"attenuationColor":)" + list(volume.attenuation_color) +
           R"(,"attenuationDistance":)" + to_text(volume.attenuation_distance_m) +
           R"(},"KHR_materials_volume_scatter":{"multiscatterColorFactor":)" +
           list(volume.multiscatter_color) + "}}}]}";
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
        const Profile back = read_profile(document_of(profile, "{}"));
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

TEST(GltfProfile, every_model_comes_back_exactly_from_the_extras) {
    std::vector<Profile> profiles;
    for (const std::string& name : profile_names()) profiles.push_back(*find_profile(name));
    const std::vector<double> radii = {0.1, 0.5, 2, 9};
    profiles.push_back(*parse_profile_csv(profile_csv(*find_profile("jensen_skin1"), radii), "table.csv"));
    for (const Profile& profile : profiles) {
        const Profile back = read_profile(document_of(profile, gltf_extras(profile)));
        EXPECT_EQ(model_name(back), model_name(profile));
        EXPECT_EQ(back.name, profile.name);
        for (int c = 0; c < 3; ++c)
            for (const double r_mm : {0.05, 0.7, 4.0})
                EXPECT_EQ(reflectance_per_mm2(back, c, r_mm), reflectance_per_mm2(profile, c, r_mm))
                    << profile.name;
        EXPECT_THAT(back.source, HasSubstr("extras.dermis_profile, the exact profile"));
        EXPECT_THAT(gltf_note(profile), HasSubstr("Dermis reads it exactly"));
    }
}

TEST(GltfProfile, extras_that_are_not_those_of_the_volume_are_named_and_not_read) {
    const Profile skin = *find_profile("gpu_gems_3"), other = *find_profile("jensen_skin1");
    const auto source = [&](const std::string& extras) {
        const Profile read = read_profile(document_of(skin, extras));
        EXPECT_TRUE(std::holds_alternative<BurleyProfile>(read.model)) << extras;
        EXPECT_EQ(read.name, "face");
        return read.source;
    };
    EXPECT_THAT(source(gltf_extras(other)), HasSubstr("the volume was changed since"));
    const auto wrong = [&](const std::string& profile) {
        return source(R"({"dermis_profile":)" + profile + "}");
    };
    EXPECT_THAT(wrong("3"), HasSubstr("model is missing or of another type"));
    EXPECT_THAT(wrong(R"({"model":"gausians","name":"","source":""})"),
                HasSubstr("did you mean 'gaussians'"));
    EXPECT_THAT(wrong(R"({"model":"gaussians","name":"","source":"","variance_mm2":[1],"weight":[]})"),
                HasSubstr("differ in number"));
    EXPECT_THAT(
        wrong(R"({"model":"gaussians","name":"","source":"","variance_mm2":[-1],"weight":[[1,1,1]]})"),
        HasSubstr("variance_mm2 of term 1 is -1"));
    EXPECT_THAT(
        wrong(R"({"model":"table","name":"","source":"","r_mm":[1],"reflectance_per_mm2":[[1,1,1]]})"),
        HasSubstr("is not read"));
    EXPECT_THAT(wrong(R"({"model":"dipole","name":"","source":"","g":"a"})"), HasSubstr("sigma_s_per_mm"));
}

TEST(GltfProfile, textures_of_the_scattering_colour_are_named) {
    const std::string texture =
        R"("KHR_materials_volume_scatter":{"multiscatterColorFactor":[0.6,0.4,0.3],"multiscatterColorTexture":{"index":0}})";
    EXPECT_THAT(read_profile(gltf_document(kGltfVolume + "," + texture)).source,
                HasSubstr("multiscatterColorTexture is not read"));
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
    EXPECT_EQ(std::get<BurleyProfile>(forward.model).g, g);
    const ScatteringMedium walked = walk_medium_of(forward);
    EXPECT_EQ(walked.g, g) << "the walk keeps it";
    for (int c = 0; c < 3; ++c) {
        const double path_mm = mean_free_path_mm(walked, c);
        const double length_mm = std::get<BurleyProfile>(isotropic.model).d_mm[size_t(c)] *
                                 mean_free_path_per_d(diffuse_albedo(isotropic, c));
        EXPECT_NEAR(path_mm, length_mm, 1e-9 * length_mm) << "the mean free path of the file";
    }
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
