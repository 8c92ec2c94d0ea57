// Values and images reach shaders by name, and what is missing or of another type is said in one line.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;

class BindingTest : public GpuTest {
  protected:
    /// Draws `fragment` full screen into one rgba32f texel.
    static PassList list(std::vector<NamedValue> values = {},
                         std::vector<std::pair<std::string, int32_t>> constants = {}) {
        return {.images = {{.name = "out", .format = ImageFormat::rgba32f, .size = {1, 1}}},
                .passes = {{.name = "only",
                            .shader = "test.frag",
                            .colors = {{.image = "out"}},
                            .constants = std::move(constants),
                            .values = std::move(values)}}};
    }

    static std::vector<float> result_of(const std::string& fragment, const PassList& list,
                                        FrameInputs inputs = {}) {
        Executor executor = make_executor(basic_shaders({{"test.frag", kHead + fragment}}));
        inputs.width = inputs.height = 1;
        run(executor, list, inputs);
        return texel(read(executor, "out"), 0, 0);
    }

    static std::string error_of(const std::string& fragment, const PassList& list, FrameInputs inputs = {}) {
        Executor executor = make_executor(basic_shaders({{"test.frag", kHead + fragment}}));
        inputs.width = inputs.height = 1;
        const Result<FrameResult> result = executor.run(list, inputs);
        return result ? "" : result.error().message;
    }
};

const std::string kPush = R"(
layout(push_constant, scalar) uniform Push { vec3 a; int b; float c; };
layout(location = 0) out vec4 color;
void main() { color = vec4(a.x, a.z, b, c); })";

TEST_F(BindingTest, push_constants_are_set_by_member_name) {
    EXPECT_THAT(result_of(kPush, list({{"c", 4.f}, {"b", 3}, {"a", Vec3{1, 9, 2}}})),
                ElementsAre(1, 2, 3, 4));
}

TEST_F(BindingTest, a_push_constant_without_value_is_an_error) {
    EXPECT_THAT(error_of(kPush, list({{"c", 4.f}, {"a", Vec3{}}})),
                AllOf(HasSubstr("pass 'only'"), HasSubstr("test.frag"), HasSubstr("'b' (int)")));
}

TEST_F(BindingTest, specialisation_constants_are_set_by_name) {
    const std::string shader = R"(
layout(constant_id = 7) const int kTaps = 5;
layout(constant_id = 2) const bool kFlip = false;
layout(location = 0) out vec4 color;
void main() { color = vec4(kTaps, kFlip ? 1 : 0, 0, 0); })";
    EXPECT_THAT(result_of(shader, list()), ElementsAre(5, 0, 0, 0));
    EXPECT_THAT(result_of(shader, list({}, {{"kTaps", 9}, {"kFlip", 1}})), ElementsAre(9, 1, 0, 0));
}

TEST_F(BindingTest, a_constant_of_the_list_reaches_each_shader_that_has_it_and_a_pass_own_one_wins) {
    const std::string shader = R"(
layout(constant_id = 7) const int kTaps = 5;
layout(constant_id = 8) const int on_cpu = 7;
layout(location = 0) out vec4 color;
void main() { color = vec4(kTaps, on_cpu, 0, 0); })";
    PassList with = list();
    with.constants = {{"kTaps", 6}, {"no_shader_has_this", 1}};
    const float on_cpu = device().info().is_cpu ? 1 : 0;
    EXPECT_THAT(result_of(shader, with), ElementsAre(6, on_cpu, 0, 0));
    with.passes[0].constants = {{"kTaps", 9}};
    EXPECT_THAT(result_of(shader, with), ElementsAre(9, on_cpu, 0, 0));
    with.constants.emplace_back("on_cpu", 3);
    EXPECT_THAT(result_of(shader, with), ElementsAre(9, 3, 0, 0));
}

TEST_F(BindingTest, a_specialisation_constant_that_no_shader_has_is_an_error) {
    const std::string shader = R"(
layout(constant_id = 7) const int kTaps = 5;
layout(location = 0) out vec4 color;
void main() { color = vec4(kTaps); })";
    EXPECT_THAT(error_of(shader, list({}, {{"kTap", 9}})),
                HasSubstr("unknown specialisation constant 'kTap'; did you mean 'kTaps'?"));
}

const std::string kFrame = R"(
layout(scalar) uniform Frame { vec3 eye; float gain; mat4 turn; int count; vec2 taps[3]; };
layout(location = 0) out vec4 color;
void main() { color = vec4(eye.y, gain, turn[3].x, taps[2].y + count); })";

Values frame_values() {
    Mat4 turn;
    turn.m[12] = 7;
    return {{"eye", Vec3{0, 2, 0}}, {"gain", 3.f},       {"turn", turn},          {"count", 10},
            {"taps[0]", Vec2{}},    {"taps[1]", Vec2{}}, {"taps[2]", Vec2{0, 5}}, {"unused", 1.f}};
}

TEST_F(BindingTest, uniform_blocks_are_filled_by_member_name) {
    EXPECT_THAT(result_of(kFrame, list(), {.blocks = {{"Frame", frame_values()}}}), ElementsAre(2, 3, 7, 15));
}

TEST_F(BindingTest, a_member_without_value_is_an_error) {
    Values values = frame_values();
    values.erase("turn");
    EXPECT_THAT(error_of(kFrame, list(), {.blocks = {{"Frame", values}}}),
                AllOf(HasSubstr("pass 'only'"), HasSubstr("test.frag"), HasSubstr("'Frame'"),
                      HasSubstr("'turn' (mat4)")));
}

TEST_F(BindingTest, a_value_of_another_type_is_an_error) {
    Values values = frame_values();
    values["gain"] = 3;
    EXPECT_THAT(error_of(kFrame, list(), {.blocks = {{"Frame", values}}}),
                HasSubstr("member 'gain' is float in the shader, but its value is int"));
}

TEST_F(BindingTest, a_block_nobody_supplies_is_an_error) {
    EXPECT_THAT(error_of(kFrame, list(), {.blocks = {{"Frames", frame_values()}}}),
                AllOf(HasSubstr("uniform block 'Frame': nothing supplies it"), HasSubstr("'Frames'?")));
}

const std::string kLights = R"(
struct Light { vec3 direction; int kind; float power; };
layout(scalar) readonly buffer Lights { Light lights[]; };
layout(scalar) readonly buffer Weights { float weights[]; };
layout(location = 0) out vec4 color;
void main() { color = vec4(lights[0].power, lights[1].direction.z, lights[2].kind, weights[1]); })";

TEST_F(BindingTest, storage_buffers_are_arrays_of_named_values) {
    const auto light = [](Vec3 direction, int kind, float power) {
        return Values{{"direction", direction}, {"kind", kind}, {"power", power}};
    };
    const FrameInputs inputs{
        .arrays = {{"Lights", {light({}, 0, 2), light({0, 0, 3}, 0, 0), light({}, 4, 0)}},
                   {"Weights", {Values{{"weights", 8.f}}, Values{{"weights", 9.f}}}}}};
    EXPECT_THAT(result_of(kLights, list(), inputs), ElementsAre(2, 3, 4, 9));
}

TEST_F(BindingTest, a_structure_in_a_block_is_filled_by_both_names) {
    const std::string shader = R"(
struct Light { vec3 direction; float power; };
layout(scalar) uniform Frame { float gain; Light first; float last; };
layout(location = 0) out vec4 color;
void main() { color = vec4(gain, first.direction.y, first.power, last); })";
    const FrameInputs inputs{
        .blocks = {
            {"Frame",
             {{"gain", 2.f}, {"first.direction", Vec3{3, 4, 5}}, {"first.power", 6.f}, {"last", 7.f}}}}};
    EXPECT_THAT(result_of(shader, list(), inputs), ElementsAre(2, 4, 6, 7));
}

TEST_F(BindingTest, an_empty_array_still_binds) {
    const std::string shader = R"(
layout(scalar) readonly buffer Weights { float weights[]; };
layout(location = 0) out vec4 color;
layout(push_constant) uniform Push { int count; };
void main() { color = vec4(5); for (int i = 0; i < count; ++i) color.x += weights[i]; })";
    EXPECT_THAT(result_of(shader, list({{"count", 0}}), {.arrays = {{"Weights", {}}}}),
                ElementsAre(5, 5, 5, 5));
}

Texture one_texel(Device& device, ImageFormat format, std::vector<uint8_t> bytes, bool srgb = false) {
    const auto raw = std::as_bytes(std::span(bytes));
    Result<Texture> texture = Texture::upload(
        device, {.name = "texel", .format = format, .srgb = srgb, .bytes = {raw.begin(), raw.end()}});
    EXPECT_TRUE(texture) << texture.error().message;
    return std::move(*texture);
}

const std::string kTexture = R"(
uniform texture2D albedo;
uniform sampler linear_clamp;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(albedo, linear_clamp), vec2(0.5)); })";

TEST_F(BindingTest, srgb_textures_are_decoded) {
    const Texture linear = one_texel(device(), ImageFormat::rgba8, {188, 0, 255, 188});
    const Texture srgb = one_texel(device(), ImageFormat::rgba8, {188, 0, 255, 188}, true);
    EXPECT_THAT(result_of(kTexture, list(), {.textures = {{"albedo", &linear}}})[0], 188 / 255.f);
    const std::vector<float> decoded = result_of(kTexture, list(), {.textures = {{"albedo", &srgb}}});
    EXPECT_NEAR(decoded[0], 0.503f, 0.004f);
    EXPECT_FLOAT_EQ(decoded[3], 188 / 255.f);
}

TEST_F(BindingTest, a_texture_nobody_supplies_is_an_error) {
    const Texture texture = one_texel(device(), ImageFormat::r8, {1});
    EXPECT_THAT(error_of(kTexture, list(), {.textures = {{"albedos", &texture}}}),
                AllOf(HasSubstr("pass 'only'"), HasSubstr("texture 'albedo': nothing supplies it"),
                      HasSubstr("'albedos'?")));
}

TEST_F(BindingTest, a_cube_in_place_of_a_plane_is_an_error) {
    Result<Texture> cube = Texture::upload(device(), {.name = "cube",
                                                      .format = ImageFormat::r8,
                                                      .layers = 6,
                                                      .cube = true,
                                                      .bytes = std::vector<std::byte>(6)});
    ASSERT_TRUE(cube) << cube.error().message;
    EXPECT_THAT(error_of(kTexture, list(), {.textures = {{"albedo", &*cube}}}),
                HasSubstr("'albedo' is texture2D in the shader, but what is bound to it is textureCube"));
}

TEST_F(BindingTest, an_image_of_a_pass_has_no_sampler_of_its_own) {
    const std::string shader = R"(
uniform sampler2D before;
layout(location = 0) out vec4 color;
void main() { color = texture(before, vec2(0.5)); })";
    PassList passes = list();
    passes.images.push_back({.name = "before", .format = ImageFormat::rgba32f});
    Pass first = passes.passes.front();
    first.name = "first", first.shader = "white.frag", first.colors = {{.image = "before"}};
    passes.passes.insert(passes.passes.begin(), first);
    passes.passes.back().reads.push_back("before");
    EXPECT_THAT(error_of(shader, passes), HasSubstr("'before' is a sampler2D in the shader, but an image"));
}

TEST_F(BindingTest, an_unknown_sampler_is_an_error_that_lists_the_known) {
    const std::string shader = R"(
uniform texture2D albedo;
uniform sampler linear_clamped;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(albedo, linear_clamped), vec2(0.5)); })";
    const Texture texture = one_texel(device(), ImageFormat::r8, {1});
    EXPECT_THAT(error_of(shader, list(), {.textures = {{"albedo", &texture}}}),
                AllOf(HasSubstr("unknown sampler 'linear_clamped'; did you mean 'linear_clamp'?"),
                      HasSubstr("shadow_compare")));
}

TEST_F(BindingTest, a_shader_that_does_not_exist_is_an_error) {
    PassList wrong = list();
    wrong.passes[0].shader = "no.frag";
    EXPECT_THAT(error_of(kTexture, wrong), AllOf(HasSubstr("pass 'only'"), HasSubstr("no.frag")));
}

TEST_F(BindingTest, an_input_the_vertex_shader_does_not_write_is_an_error) {
    const std::string shader = R"(
layout(location = 3) in vec2 missing_uv;
layout(location = 0) out vec4 color;
void main() { color = missing_uv.xyxy; })";
    EXPECT_THAT(error_of(shader, list()),
                HasSubstr("input 'missing_uv' at location 3 is not written by vertex shader"));
}

TEST_F(BindingTest, stages_that_disagree_about_a_block_are_an_error) {
    const std::string vertex = kHead + R"(
layout(scalar) uniform Frame { float other; };
void main() { gl_Position = vec4(other); })";
    Executor executor = make_executor(basic_shaders({{"test.frag", kHead + kFrame}, {"other.vert", vertex}}));
    PassList wrong = list();
    wrong.passes[0].vertex_shader = "other.vert";
    const Result<FrameResult> result = executor.run(wrong, {.width = 1, .height = 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("declares 'Frame' otherwise than the other stage"));
}

TEST_F(BindingTest, stages_share_what_has_the_same_name) {
    const std::string vertex = kHead + R"(
layout(scalar) uniform Frame { float shift; };
uniform texture2D only_here;
uniform sampler linear_clamp;
void main() {
    vec2 uv = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    float z = textureLod(sampler2D(only_here, linear_clamp), vec2(0.5), 0).r;
    gl_Position = vec4(uv * 2 - 1 + shift, z, 1);
})";
    const std::string fragment = kHead + R"(
uniform texture2D albedo;
layout(scalar) uniform Frame { float shift; };
uniform sampler linear_clamp;
layout(location = 0) out vec4 color;
void main() {
    float red = texture(sampler2D(albedo, linear_clamp), vec2(0.5)).r;
    color = vec4(red, gl_FragCoord.z, shift, 0);
})";
    Executor executor = make_executor(basic_shaders({{"test.frag", fragment}, {"own.vert", vertex}}));
    const Texture dark = one_texel(device(), ImageFormat::r8, {51});
    const Texture bright = one_texel(device(), ImageFormat::r8, {255});
    PassList shared = list();
    shared.passes[0].vertex_shader = "own.vert";
    run(executor, shared,
        {.width = 1,
         .height = 1,
         .textures = {{"only_here", &dark}, {"albedo", &bright}},
         .blocks = {{"Frame", {{"shift", 0.f}}}}});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(1, FloatEq(0.2f), 0, 0));
}

TEST_F(BindingTest, a_target_without_output_is_an_error) {
    const std::string shader = R"(
layout(location = 1) out vec4 color;
void main() { color = vec4(1); })";
    EXPECT_THAT(error_of(shader, list()), HasSubstr("target 'out' needs an output at location 0"));
}

}  // namespace
}  // namespace dermis::gpu
