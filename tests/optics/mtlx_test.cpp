// MaterialX documents with an OpenPBR surface: round trips, meanings of colour and radius, refusals, and
// every prefix of a file.

#include "dermis/optics/mtlx.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/presets.h"
#include "test_parts.h"

using namespace dermis;

#if DERMIS_WITH_MATERIALX
using testing::HasSubstr;

namespace {

std::string document(const std::string& inputs, const std::string& attributes = "") {
    return "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\"" + attributes +
           ">\n<open_pbr_surface name=\"s\" type=\"surfaceshader\">\n" + inputs +
           "</open_pbr_surface>\n</materialx>\n";
}
std::string input(const std::string& name, const std::string& value, const std::string& more = "") {
    return "<input name=\"" + name + "\" type=\"any\" value=\"" + value + "\" " + more + "/>\n";
}
const std::string kOn = input("subsurface_weight", "1");

std::string mtlx_verdict(const std::string& text) {
    const Result<Profile> profile = parse_mtlx(text, "skin.mtlx");
    return profile ? std::string("valid") : profile.error().message;
}
Profile read(const std::string& text) {
    const Result<Profile> profile = parse_mtlx(text, "skin.mtlx");
    EXPECT_TRUE(profile) << profile.error().message;
    return profile ? *profile : *find_profile("burley:1");
}
BurleyProfile burley_read(const std::string& text) {
    return burley_equivalent(read(text));
}

}  // namespace

TEST(Mtlx, every_preset_comes_back_with_its_albedo_and_mean_radius) {
    for (const std::string& name : profile_names()) {
        const Profile skin = *find_profile(name);
        const Profile back = read(mtlx_text(skin));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(diffuse_albedo(back, c), diffuse_albedo(skin, c), 1e-9) << name;
            EXPECT_NEAR(mean_radius_mm(back, c), mean_radius_mm(skin, c), 1e-9 * mean_radius_mm(skin, c))
                << name;
        }
    }
}

TEST(Mtlx, the_radius_is_a_mean_free_path_in_the_unit_of_the_file) {
    const std::string scale = input("subsurface_radius_scale", "1, 0.5, 0.25");
    const std::string color = input("subsurface_color", "0.5, 0.4, 0.3");
    const BurleyProfile cm = burley_read(document(kOn + color + input("subsurface_radius", "0.2") + scale));
    EXPECT_NEAR(cm.d_mm[0], 2.0 / mean_free_path_per_d(0.5), 1e-12);
    EXPECT_NEAR(cm.d_mm[2], 0.5 / mean_free_path_per_d(0.3), 1e-12);
    const std::string mm = input("subsurface_radius", "2", "unittype=\"distance\" unit=\"millimeter\"");
    EXPECT_NEAR(burley_read(document(kOn + color + mm + scale)).d_mm[0], cm.d_mm[0], 1e-12);
    EXPECT_THAT(read(document(kOn)).source, HasSubstr("subsurface_radius has no unit: taken as cm"));
    EXPECT_THAT(read(document(kOn)).source, HasSubstr("mean free path"));
}

TEST(Mtlx, what_the_file_leaves_out_has_the_default_of_openpbr) {
    const BurleyProfile skin = burley_read(document(kOn));
    EXPECT_EQ(skin.albedo, (std::array{0.8, 0.8, 0.8}));
    EXPECT_NEAR(skin.d_mm[1], 5 / mean_free_path_per_d(0.8), 1e-12);
}

TEST(Mtlx, colours_are_converted_from_the_space_that_the_file_names_and_it_is_told) {
    // OpenPBR's example skin IV in ACEScg is Jensen's skin1 in Rec. 709.
    const std::string color = input("subsurface_color", "0.351, 0.240, 0.148");
    const Profile converted = read(document(kOn + color, " colorspace=\"acescg\""));
    const Profile skin = *find_profile("openpbr_skin_4");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(diffuse_albedo(converted, c), diffuse_albedo(skin, c), 1e-12);
    EXPECT_THAT(converted.source, HasSubstr("subsurface_color converted from acescg to linear Rec. 709"));
    const Profile as_is = read(document(kOn + color, " colorspace=\"lin_rec709\""));
    EXPECT_NEAR(diffuse_albedo(as_is, 0), 0.351, 1e-12);
    const Profile unnamed = read(document(kOn + color));
    EXPECT_NEAR(diffuse_albedo(unnamed, 0), 0.351, 1e-12);
    EXPECT_THAT(unnamed.source, HasSubstr("names no colour space: taken as linear Rec. 709"));
    const std::string encoded = input("subsurface_color", "0.5, 0.5, 0.5", "colorspace=\"srgb_texture\"");
    EXPECT_NEAR(diffuse_albedo(read(document(kOn + encoded, " colorspace=\"acescg\"")), 0), 0.2140, 1e-4);
}

TEST(Mtlx, forward_scattering_becomes_isotropic_scattering_of_the_same_reduced_mean_free_path) {
    const std::string g = input("subsurface_scatter_anisotropy", "0.8");
    const BurleyProfile isotropic = burley_read(document(kOn)), forward = burley_read(document(kOn + g));
    const ScatteringMedium medium = medium_of({0.8, 0.8, 0.8}, {10, 5, 2.5}, 0.8, 1.4);
    EXPECT_NEAR(forward.d_mm[0] * mean_free_path_per_d(0.8), 1 / reduced_sigma_t_per_mm(medium, 0), 1e-9);
    EXPECT_GT(forward.d_mm[0], 3 * isotropic.d_mm[0]);
    EXPECT_EQ(forward.albedo, isotropic.albedo);
    EXPECT_EQ(forward.g, 0.8);
    const BurleyProfile back = burley_read(mtlx_text({.name = "forward", .source = {}, .model = forward}));
    EXPECT_EQ(back.g, 0.8);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(back.d_mm[c], forward.d_mm[c], 1e-6 * forward.d_mm[c]);
}

TEST(Mtlx, what_is_not_kept_is_told) {
    const std::string rest = input("specular_roughness", "0.4") + input("coat_weight", "0.1");
    EXPECT_THAT(read(document(kOn + rest)).source,
                HasSubstr("not in a profile: specular_roughness, coat_weight"));
    EXPECT_THAT(read(document(input("subsurface_weight", "0.5"))).source,
                HasSubstr("subsurface_weight 0.5 is read as 1"));
    EXPECT_THAT(mtlx_notes(*find_profile("jensen_skin1"), *find_profile("jensen_skin1"))[0],
                HasSubstr("shape of jensen_skin1 (dipole) is lost"));
    EXPECT_THAT(mtlx_notes(*find_profile("openpbr_skin_5"), *find_profile("openpbr_skin_5"))[0],
                HasSubstr("mean free path in cm"));
}

TEST(Mtlx, numbers_of_the_surface_are_checked_where_a_profile_is_read) {
    const auto with = [](const std::string& name, const std::string& value, const std::string& more = "") {
        return mtlx_verdict(document(kOn + input(name, value, more)));
    };
    EXPECT_EQ(with("specular_ior", "1.4"), "valid");
    EXPECT_EQ(with("specular_roughness", "0", " nodename=\"map\""), "valid") << "a map";
    for (const char* wrong : {"nan", "inf", "0.9", "-1", "1e9"})
        EXPECT_THAT(with("specular_ior", wrong), HasSubstr("specular_ior")) << wrong;
    EXPECT_THAT(with("specular_ior", "nan"), HasSubstr("1 to 3"));
    EXPECT_THAT(with("specular_ior", "glass"), HasSubstr("specular_ior: 'glass' is not a number"));
    EXPECT_THAT(with("specular_roughness", "1.5"), HasSubstr("0 to 1"));
}

TEST(Mtlx, refusals_name_the_place_the_value_and_what_would_be_right) {
    EXPECT_EQ(mtlx_verdict(document(kOn)), "valid");
    EXPECT_THAT(mtlx_verdict("<materialx>\n<open_pbr"), HasSubstr("skin.mtlx:2: no complete XML"));
    EXPECT_THAT(mtlx_verdict("<materialx/>"), HasSubstr("skin.mtlx: no open_pbr_surface"));
    EXPECT_THAT(mtlx_verdict(document("")), HasSubstr("skin.mtlx:3: subsurface_weight is 0"));
    EXPECT_THAT(mtlx_verdict("<m>\n<open_pbr_surface/>\n<open_pbr_surface/></m>"),
                HasSubstr("skin.mtlx:3: a second open_pbr_surface; keep one"));
    EXPECT_THAT(mtlx_verdict(document(kOn + "<input name=\"subsurface_color\" nodename=\"image\"/>\n")),
                HasSubstr("skin.mtlx:5: subsurface_color is connected to a node"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_color", "1, x, 1"))),
                HasSubstr("' x' is not a number"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_color", "1, 1"))),
                HasSubstr("takes 3 numbers, not 2"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_color", "2, 1, 1"))),
                HasSubstr("subsurface_color is 2"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_radius", "-1"))),
                HasSubstr("subsurface_radius is -1"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_radius", "1", "unit=\"milimeter\""))),
                HasSubstr("did you mean 'millimeter'"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_color", "1, 1, 1"), " colorspace=\"acescgg\"")),
                HasSubstr("did you mean 'acescg'"));
    EXPECT_THAT(mtlx_verdict(document(kOn + input("subsurface_scatter_anisotropy", "1"))),
                HasSubstr("subsurface_scatter_anisotropy is 1"));
}

TEST(Mtlx, every_prefix_is_read_or_refused_in_one_line) {
    const std::string file = mtlx_text(*find_profile("openpbr_skin_5"));
    for (size_t length = 0; length < file.size(); ++length) {
        const Result<Profile> profile = parse_mtlx(std::string_view(file).substr(0, length), "skin.mtlx");
        if (profile) {  // only the line break at the end may be missing
            EXPECT_TRUE(check(*profile));
            EXPECT_GE(length + 1, file.size());
        } else {
            EXPECT_THAT(profile.error().message, HasSubstr("skin.mtlx"));
            EXPECT_EQ(profile.error().message.find('\n'), std::string::npos);
        }
    }
}

#else

TEST(Mtlx, a_profile_in_a_document_is_refused_where_it_is_not_built_in) {
    EXPECT_EQ(find_profile("skin.mtlx").error().message,
              "skin.mtlx: MaterialX is not built in; configure dermis with -DDERMIS_WITH_MATERIALX=ON");
}

#endif
