// What the subset has is read; everything else is an error of one line with file, line and what to write
// instead.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/shading/shading.h"

using namespace dermis;
using namespace dermis::shading;
using testing::HasSubstr;

namespace {

Result<std::vector<Unit>> read(const std::string& text) {
    return read_sources(std::vector<Source>{{"skin.glsl", text}});
}

std::string error_of(const std::string& text) {
    const auto units = read(text);
    return units ? "no error" : units.error().message;
}

struct Wrong {
    const char* text;
    const char* message;
};

TEST(Parser, what_the_subset_lacks_is_an_error_with_line_and_mend) {
    const Wrong all[] = {
        {"\nstruct A { float b; };", "skin.glsl:2: 'struct' is not of the subset; write a function"},
        {"uniform float a;", "skin.glsl:1: 'uniform' is not of the subset"},
        {"#define A 1\n", "skin.glsl:1: '#define A 1' is not of the subset"},
        {"/* a */", "skin.glsl:1: a comment in /* */; write //"},
        {"float f(float a[2]) { return a[0]; }", "'[' is not of the subset"},
        {"float f(out float a) { return 1.0; }", "'out' at a parameter: WGSL has none; return the value"},
        {"float f(mat3 m) { return 1.0; }", "'mat3' is not a type of the subset; it has float, vec2"},
        {"float f(float a) { while (a > 1.0) return a; }", "'while' is not of the subset"},
        {"float f(float a);", "'f' is declared without a body"},
        {"float f(float a) {\n    return a\n}", "skin.glsl:3: ';' is missing before '}'"},
        {"float f(float a) { return a; // b", "'}' is missing at the end of the file"},
        {"float f(float a) { return 1.0f; }", "a number with a suffix"},
        {"float f(float a) { return max(a,  // b\n 1.0); }", "a comment within an expression"},
        {"float f(float a) { a = 1.0; return a; }",
         "'a' is a parameter, a counter or a constant, which WGSL"},
        {"float f(float a) { vec2 b = vec2(a); b.xy = vec2(1.0); return a; }",
         "an assignment to several components"},
        {"float f(float a) { return a; }\nfloat f(vec2 a) { return a.x; }",
         "skin.glsl:2: 'f' is defined twice; WGSL has no overloading"},
        {"float f(float sampler) { return sampler; }", "'sampler' is a word of GLSL; choose another name"},
        {"float f(float near) { return near; }", "'near' is a word of C++"},
        {"float saturate(float a) { return a; }", "'saturate' is a word of HLSL"},
        {"float f(float a) { float b = a; float b = a; return b; }", "'b' is defined twice"},
        {"float f(float a) { return 1 + a; }", "int + float is not of the subset; convert one of them"},
        {"float f(float a) { return alpha; }", "unknown name 'alpha'"},
        {"float f(float a) { return min(a); }", "'min' gets 1 arguments; it has 2"},
        {"float f(vec3 a) { return a; }", "what 'f' returns is vec3, not float"},
        {"float f(vec2 a) { return a.z; }", "'.z' of vec2"},
        {"vec3 f(float a) { return vec3(a, a); }", "'vec3' of 2 components"},
        {"float f(float a) { if (a) return a; return a; }", "a condition is float, not bool"},
        {"float f(float a) { if (a > 1.0) return a; }", "'f' can end without a return"},
        {"float f(float a) { for (float i = 0.0; i < a; ++i) return a; return a; }", "a loop counts one int"},
        {"const float kA;", "constant 'kA' has no value"},
        {"#include \"shaders/include/frame.glsl\"\n",
         "includes shaders/include/frame.glsl, which is none of"},
    };
    for (const Wrong& wrong : all) {
        const std::string message = error_of(wrong.text);
        EXPECT_THAT(message, HasSubstr(wrong.message)) << wrong.text;
        EXPECT_THAT(message, testing::StartsWith("skin.glsl")) << wrong.text;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

// Cut anywhere, a source is read or refused, and never crashes the reader.
TEST(Parser, every_prefix_of_a_source_is_read_or_refused) {
    const std::string text =
        "// Head.\n#ifndef DERMIS_A\n#define DERMIS_A\nconst float kA = 1.0, kB = 2e-3;\n\n// Text.\n"
        "vec3 f(vec3 a, int n) {\n    vec3 b = a;  // behind\n    for (int i = 0; i < n; ++i) {\n"
        "        if (b.x > 1.0 && !(b.y == 2.0)) b += a * kA;\n        else b.x = -kB;\n    }\n"
        "    return n > 1 ? mix(b, a, 0.5) : b.zyx;\n}\n#endif\n";
    ASSERT_TRUE(read(text)) << error_of(text);
    size_t refused = 0;
    for (size_t length = 0; length < text.size(); ++length) refused += !read(text.substr(0, length));
    EXPECT_GT(refused, text.size() / 2);
}

TEST(Parser, files_come_behind_what_they_include) {
    const std::vector<Source> sources = {{"a.glsl", "#include \"b.glsl\"\nconst float kA = kB;\n"},
                                         {"b.glsl", "const float kB = 1.0;\n"}};
    const auto units = read_sources(sources);
    ASSERT_TRUE(units) << units.error().message;
    EXPECT_EQ((*units)[0].path, "b.glsl");
    const std::vector<Source> circle = {{"a.glsl", "#include \"b.glsl\"\n"},
                                        {"b.glsl", "#include \"a.glsl\"\n"}};
    const auto refused = read_sources(circle);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("includes itself through another file"));
}

}  // namespace
