// Conversions: every tool to {A, d} and back, the published numbers, and the errors of wrong numbers.

#include "dermis/optics/conversions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/bake/profile_report.h"
#include "dermis/base/file.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/presets.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

const BurleyProfile kSkin{.albedo = {0.62, 0.43, 0.34}, .d_mm = {1.14, 0.48, 0.31}};

bool keeps_albedo(ToolId tool) {
    return tool != ToolId::faceworks && tool != ToolId::separable_sss && tool != ToolId::hdrp &&
           tool != ToolId::babylon;
}

}  // namespace

TEST(Conversions, every_tool_gives_back_what_it_was_given) {
    for (const ToolConvention& tool : tool_conventions()) {
        const Result<BurleyProfile> back = to_canonical(to_tool(tool.id, kSkin));
        ASSERT_TRUE(back) << tool.name;
        // pbrt holds no albedo but coefficients: the fitted inversion's own error comes in.
        const double tolerance = tool.id == ToolId::pbrt ? 1e-4 : 1e-9;
        for (size_t c = 0; c < 3; ++c) {
            if (tool.id == ToolId::faceworks && c > 0) continue;  // one length for all channels
            EXPECT_NEAR(back->d_mm[c], kSkin.d_mm[c], tolerance) << tool.name;
            EXPECT_NEAR(back->albedo[c], keeps_albedo(tool.id) ? kSkin.albedo[c] : 1, tolerance) << tool.name;
        }
        EXPECT_EQ(tool.lost.empty(), keeps_albedo(tool.id)) << tool.name << " must say what it loses";
    }
}

TEST(Conversions, settings_lie_within_the_ranges_their_tool_states) {
    for (const ToolConvention& tool : tool_conventions())
        for (const ToolSettings& settings : {to_tool(tool.id, kSkin), default_settings(tool.id)}) {
            ASSERT_EQ(settings.values.size(), tool.keys.size()) << tool.name;
            for (size_t k = 0; k < tool.keys.size(); ++k)
                for (int c = 0; c < tool.keys[k].count; ++c) {
                    EXPECT_GE(settings.values[k][size_t(c)], tool.keys[k].min) << tool.keys[k].name;
                    EXPECT_LE(settings.values[k][size_t(c)], tool.keys[k].max) << tool.keys[k].name;
                }
            EXPECT_FALSE(tool.length.empty() || tool.boundary.empty()) << tool.name;
        }
}

TEST(Conversions, published_settings_give_the_published_d) {
    const auto d_of = [](ToolId tool) { return to_canonical(default_settings(tool))->d_mm; };
    EXPECT_NEAR(d_of(ToolId::unreal)[0], .180, 5.1e-4);
    EXPECT_NEAR(d_of(ToolId::unreal)[1], .068, 5.1e-4);
    EXPECT_NEAR(d_of(ToolId::unreal)[2], .055, 5.1e-4);
    // 50 mm / (4 pi s(0.8)), s = 1.1: a default for objects, ten times skin.
    EXPECT_NEAR(d_of(ToolId::blender_burley)[0], 50 / (4 * std::numbers::pi * 1.1), 1e-12);
    EXPECT_NEAR(d_of(ToolId::blender_burley)[2], 0.362, 5.1e-4);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(d_of(ToolId::faceworks)[c], burley_equivalent(*find_profile("gpu_gems_3")).d_mm[c],
                    1e-12);
        EXPECT_NEAR(d_of(ToolId::separable_sss)[c], burley_equivalent(*find_profile("separable_sss")).d_mm[c],
                    1e-12);
    }
}

TEST(Conversions, the_openpbr_skins_are_diffuse_mean_free_paths_in_cm) {
    // Skin IV: radius scale .367 .137 .068. Read as the tool that takes that length.
    ToolSettings skin = default_settings(ToolId::blender_random_walk_skin);
    const Profile preset = *find_profile("openpbr_skin_4");
    const auto& burley = std::get<BurleyProfile>(preset.model);
    ASSERT_TRUE(set_value(skin, "base_color", {burley.albedo.begin(), burley.albedo.end()}));
    ASSERT_TRUE(set_value(skin, "subsurface_radius", {.367, .137, .068}));
    ASSERT_TRUE(set_value(skin, "subsurface_scale", {0.01}));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(to_canonical(skin)->d_mm[c], burley.d_mm[c], 1e-12);
}

TEST(Conversions, a_longer_unit_in_is_a_longer_length_out) {
    for (const ToolConvention& tool : tool_conventions()) {
        BurleyProfile large = kSkin;
        for (double& d : large.d_mm) d *= 10;
        const Result<BurleyProfile> back = to_canonical(to_tool(tool.id, large));
        ASSERT_TRUE(back) << tool.name;
        EXPECT_NEAR(back->d_mm[0], 10 * kSkin.d_mm[0], 1e-3) << tool.name;
    }
}

TEST(Conversions, wrong_keys_and_numbers_are_named) {
    ToolSettings settings = default_settings(ToolId::unreal);
    EXPECT_THAT(set_value(settings, "surface_albdo", {1}).error().message,
                HasSubstr("unknown unreal key 'surface_albdo'; did you mean 'surface_albedo'?"));
    EXPECT_THAT(set_value(settings, "surface_albedo", {1.5}).error().message,
                HasSubstr("surface_albedo is 1.5; it must be 0 to 1"));
    EXPECT_THAT(set_value(settings, "surface_albedo", {1, 1}).error().message,
                HasSubstr("takes 3 numbers, not 2"));
    EXPECT_THAT(set_value(settings, "mean_free_path_distance", {std::nan("")}).error().message,
                HasSubstr("mean_free_path_distance is nan"));
    EXPECT_THAT(find_tool("blender_burly").error().message, HasSubstr("did you mean 'blender_burley'?"));
    ToolSettings pbrt = default_settings(ToolId::pbrt);
    ASSERT_TRUE(set_value(pbrt, "sigma_a", {0, 1, 1}));
    ASSERT_TRUE(set_value(pbrt, "sigma_s", {0, 1, 1}));
    EXPECT_THAT(to_canonical(pbrt).error().message, HasSubstr("sigma_a + sigma_s of red is 0"));
}

TEST(Medium, albedo_inversion_undoes_multiple_scattering) {
    for (const double g : {0.0, 0.5, 0.8})
        for (double c = 0; c <= 1.0001; c += 0.05) {
            const double alpha = single_scatter_albedo_of(std::min(c, 1.0), g);
            EXPECT_GE(alpha, 0);
            EXPECT_LE(alpha, 1);
            EXPECT_NEAR(multiscatter_albedo(alpha, g), std::min(c, 1.0), 1e-4) << c << " g " << g;
        }
}

TEST(Medium, lengths_follow_from_the_coefficients) {
    const ScatteringMedium medium{.sigma_s_per_mm = {4, 4, 4}, .sigma_a_per_mm = {1, 1, 1}, .g = 0.75};
    EXPECT_DOUBLE_EQ(mean_free_path_mm(medium, kRed), 0.2);
    EXPECT_DOUBLE_EQ(reduced_sigma_t_per_mm(medium, kRed), 2);
    EXPECT_DOUBLE_EQ(single_scatter_albedo(medium, kRed), 0.8);
    EXPECT_DOUBLE_EQ(reduced_albedo(medium, kRed), 0.5);
    EXPECT_DOUBLE_EQ(diffuse_mean_free_path_mm(medium, kRed), 1 / std::sqrt(6.0));
}

TEST(Medium, the_medium_of_a_profile_has_its_albedo_and_d_whatever_the_anisotropy) {
    for (const double g : {0.0, 0.8}) {
        const ScatteringMedium medium = medium_of(kSkin, g, 1.4);
        ASSERT_TRUE(check(medium));
        const BurleyProfile back = burley_of(medium);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(back.albedo[c], kSkin.albedo[c], 1e-4) << g;
            EXPECT_NEAR(back.d_mm[c], kSkin.d_mm[c], 1e-4) << g;
        }
        EXPECT_NEAR(1 / reduced_sigma_t_per_mm(medium, kRed), kSkin.d_mm[0] * mean_free_path_per_d(0.62),
                    1e-12)
            << g;
    }
}

TEST(Documentation, its_table_of_tools_is_what_the_code_says) {
    const Result<std::string> page = read_text_file(DERMIS_SOURCE_DIR "/docs/profiles.md");
    ASSERT_TRUE(page);
    const std::string tables = profile_tables_markdown();
    const size_t begin = tables.find("### What each tool means"), end = tables.find("\n\n### One skin");
    ASSERT_LT(begin, end);
    EXPECT_TRUE(page->ends_with(tables.substr(begin, end - begin) + "\n"))
        << "regenerate: the page ends with this table of `dermis profile table`";
}
