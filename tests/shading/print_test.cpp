// The text in each language: what differs between them, and that comments and layout stay.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"
#include "dermis/shading/skin_text.h"

using namespace dermis;
using namespace dermis::shading;
using testing::HasSubstr;
using testing::Not;

namespace {

std::string printed(const std::string& text, Language language) {
    const auto units = read_sources(std::vector<Source>{{"skin.glsl", text}});
    EXPECT_TRUE(units) << units.error().message;
    return units ? print(*units, language, {}) : "";
}

const std::string kSample =
    "// Half, 0 to 1.\n"
    "const float kHalf = 0.5;\n\n"
    "// Two lines of text.\n"
    "vec3 f(vec3 a, float t) {\n"
    "    vec3 b = clamp(mix(a, vec3(t), kHalf), 0.0, 1.0);\n\n"
    "    // Why.\n"
    "    vec3 c = b, d = max(b, t);  // behind\n"
    "    c.x = fract(t);\n"
    "    for (int i = 0; i < 3; ++i) c += d;\n"
    "    if (t < 0.0) return vec3(c.xy, 1.0);\n"
    "    return t > 1.0 ? b : c;\n"
    "}\n";

TEST(Print, glsl_is_what_was_read) {
    EXPECT_EQ(
        printed(kSample, Language::glsl),
        "#ifndef DERMIS_SKIN\n#define DERMIS_SKIN\n\n// Half, 0 to 1.\n" + kSample.substr(17) + "\n#endif\n");
}

TEST(Print, hlsl_has_lerp_saturate_and_scalars_beside_vectors) {
    const std::string text = printed(kSample, Language::hlsl);
    EXPECT_THAT(text, HasSubstr("static const float kHalf = 0.5;\n"));
    EXPECT_THAT(text,
                HasSubstr("float3 f(float3 a, float t) {\n    float3 b = saturate(lerp(a, t, kHalf));\n"));
    EXPECT_THAT(text, HasSubstr("    float3 c = b, d = max(b, t);  // behind\n    c.x = frac(t);\n"));
}

// Where no argument is a vector that stays one, the scalar has to be made one: the result would be a scalar.
TEST(Print, hlsl_casts_where_a_scalar_would_not_become_a_vector) {
    const auto body = [](const std::string& expression) {
        return printed("vec3 f(vec3 a, float t) {\n    return " + expression + ";\n}\n", Language::hlsl);
    };
    EXPECT_THAT(body("min(a, vec3(0.5))"), HasSubstr("return min(a, 0.5);"));
    EXPECT_THAT(body("mix(vec3(0.25), a, vec3(1.0 - t))"), HasSubstr("return lerp(0.25, a, 1.0 - t);"));
    EXPECT_THAT(body("max(vec3(t), vec3(0.5))"), HasSubstr("max((float3)t, float3(0.5, 0.5, 0.5));"));
    EXPECT_THAT(body("pow(a, vec3(2.0))"), HasSubstr("pow(a, float3(2.0, 2.0, 2.0));"));
    EXPECT_THAT(body("a + vec3(t)"), HasSubstr("a + (float3)t;"));
}

TEST(Print, wgsl_has_types_behind_names_and_select) {
    EXPECT_EQ(printed(kSample, Language::wgsl),
              "\n// Half, 0 to 1.\nconst kHalf: f32 = 0.5;\n\n"
              "// Two lines of text.\n"
              "fn f(a: vec3f, t: f32) -> vec3f {\n"
              "    let b = clamp(mix(a, vec3f(t), kHalf), vec3f(0.0), vec3f(1.0));\n\n"
              "    // Why.\n"
              "    var c = b;\n"
              "    let d = max(b, vec3f(t));  // behind\n"
              "    c.x = fract(t);\n"
              "    for (var i = 0; i < 3; i++) {\n"
              "        c += d;\n"
              "    }\n"
              "    if (t < 0.0) {\n"
              "        return vec3f(c.xy, 1.0);\n"
              "    }\n"
              "    return select(c, b, t > 1.0);\n"
              "}\n");
}

TEST(Print, metal_and_cpp_have_their_own) {
    const std::string metal = printed(kSample, Language::msl), cpp = printed(kSample, Language::cpp);
    EXPECT_THAT(metal, HasSubstr("constant float kHalf = 0.5;\n"));
    EXPECT_THAT(metal, HasSubstr("inline float3 f(float3 a, float t) {\n    float3 b = saturate(mix(a, "
                                 "float3(t), float3(kHalf)));\n"));
    EXPECT_THAT(cpp, HasSubstr("constexpr float kHalf = 0.5f;\n"));
    EXPECT_THAT(cpp, HasSubstr("return float3(float2(c.x, c.y), 1.0f);\n"));
    EXPECT_THAT(cpp, HasSubstr("    return t > 1.0f ? b : c;\n"));
}

TEST(Print, long_lines_are_broken_at_the_outermost_place) {
    const std::string sum = "aaaaaaaaaaaaaaaaaaaaaaaa * (bbbbbbbbbbbbbbbbbbbbbbbbbbbb + 1.0)";
    const std::string text =
        printed("float f(float aaaaaaaaaaaaaaaaaaaaaaaa, float bbbbbbbbbbbbbbbbbbbbbbbbbbbb) {\n    return " +
                    sum + " + " + sum + ";\n}\n",
                Language::glsl);
    EXPECT_THAT(text, HasSubstr("    return " + sum + " +\n            " + sum + ";\n"));
}

// Pasted into a shader that has its own `ggx` and `kPi`, it must not meet them: comments, calls and constants
// too.
TEST(Print, every_name_of_the_skin_begins_with_skin) {
    const std::string own = *skin_text(*find_profile("gpu_gems_3"), shading::skin_sources(), Language::glsl);
    const std::regex function("^[a-z]+[2-4]? (\\w+)\\("), constant("^const [a-z]+[2-4]? (\\w+)");
    std::vector<std::string> names;
    for (const std::string_view line : split(own, '\n')) {
        std::cmatch match;
        if (std::regex_search(line.begin(), line.end(), match, function)) {
            names.push_back(match[1]);
            EXPECT_TRUE(names.back().starts_with("skin_")) << line;
        } else if (std::regex_search(line.begin(), line.end(), match, constant)) {
            names.push_back(match[1]);
            EXPECT_TRUE(names.back().starts_with("kSkin")) << line;
        }
    }
    EXPECT_GT(names.size(), 60u);
    for (const char* old : {"ggx", "kPi", "polynomial_6", "curvature_towards"})
        EXPECT_FALSE(std::regex_search(own, std::regex("\\b" + std::string(old) + "\\b"))) << old;
}

TEST(Print, chosen_functions_come_with_what_they_need_alone) {
    const std::string chosen[] = {"skin_thin_light", "skin_baked_skin"};
    const auto text = skin_text(*find_profile("gpu_gems_3"), shading::skin_sources(), Language::hlsl, chosen);
    ASSERT_TRUE(text) << text.error().message;
    for (const char* needed :
         {"float3 skin_thin_light(", "float3 skin_gain_through(", "kSkinLeastDirection = ",
          "//     float3 thin_light = skin_thin_light(here, behind, share_behind, gain_of_place, "
          "gain_of_slabs);"})
        EXPECT_THAT(*text, HasSubstr(needed));
    for (const char* other : {"skin_ggx", "skin_gain_of_curvature", "skin_baked_red(float3", "vec3"})
        EXPECT_THAT(*text, Not(HasSubstr(other)));
    const std::string misspelt[] = {"skin_thin_ligth"};
    EXPECT_THAT(skin_text(*find_profile("gpu_gems_3"), shading::skin_sources(), Language::hlsl, misspelt)
                    .error()
                    .message,
                HasSubstr("unknown function 'skin_thin_ligth'; did you mean 'skin_thin_light'?"));
}

TEST(Print, comments_name_types_and_functions_as_the_language_does) {
    const char* source = "// mix(a, vec3(0.0), x); a mix of light\nvec3 f(vec3 a) {\n    return a;\n}\n";
    EXPECT_THAT(printed(source, Language::hlsl), HasSubstr("// lerp(a, float3(0.0), x); a mix of light\n"));
    EXPECT_THAT(printed(source, Language::glsl), HasSubstr("// mix(a, vec3(0.0), x); a mix of light\n"));
}

// What is handed over: every language, a measured and an OpenPBR skin.
TEST(Print, the_skin_is_printed_in_every_language_the_same_every_time) {
    for (const char* name : {"gpu_gems_3", "openpbr_skin_5", "jensen_skin1"}) {
        const auto profile = find_profile(name);
        ASSERT_TRUE(profile);
        for (const std::string& language : language_names()) {
            const auto text = skin_text(*profile, shading::skin_sources(), *find_language(language));
            ASSERT_TRUE(text) << text.error().message;
            EXPECT_EQ(*text, *skin_text(*profile, shading::skin_sources(), *find_language(language)));
            EXPECT_THAT(*text, HasSubstr(name));
            for (const char* function :
                 {"skin_ggx(", "skin_kelemen_szirmay_kalos(", "skin_wrap(", "skin_ambient_band_1(",
                  "skin_diffuse(", "skin_spherical_gaussians(", "skin_shadow_edge(", "skin_transmittance("})
                EXPECT_THAT(*text, HasSubstr(function)) << language;
            EXPECT_THAT(*text, Not(HasSubstr("shaders/include"))) << language;
            for (const std::string_view line : split(*text, '\n')) {
                EXPECT_TRUE(line.size() <= (language == "cpp" ? 130u : 120u) ||
                            line.starts_with("// Source: "))
                    << language << ": " << line;
                EXPECT_EQ(line.find_first_of("\t\x80"), std::string_view::npos) << line;
            }
        }
    }
}

}  // namespace
