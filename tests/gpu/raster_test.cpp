// Depth, culling, blending, masks, filters: the fixed-function state of raster passes.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;

class RasterTest : public GpuTest {};

/// A clip-space square of half side `size` at depth z, counter-clockwise as seen on screen.
std::vector<float> square(float size, float z) {
    const float s = size;
    return {-s, -s, z, -s, s, z, s, s, z, -s, -s, z, s, s, z, s, -s, z};
}

Pass white_pass(std::string name, std::optional<DepthTarget> depth = std::nullopt) {
    return {.name = std::move(name),
            .kind = PassKind::geometry_screen,
            .shader = "white.frag",
            .colors = {{.image = "out"}},
            .depth = std::move(depth)};
}

PassList out_list(std::vector<Pass> passes, ImageFormat format = ImageFormat::rgba32f) {
    return {.images = {{.name = "out", .format = format}, {.name = "depth", .format = ImageFormat::depth32f}},
            .passes = std::move(passes)};
}

/// Full screen in a colour given as the push constant `value`.
const std::string kConstant = kHead + R"(
layout(push_constant) uniform Push { vec4 value; };
layout(location = 0) out vec4 color;
void main() { color = value; })";

TEST_F(RasterTest, the_uv_atlas_is_drawn_at_uv_times_two_minus_one) {
    const std::string vertex = kHead + R"(
layout(location = 0) in vec2 uv;
void main() { gl_Position = vec4(uv * 2 - 1, 0, 1); })";
    Executor executor = make_executor(basic_shaders({{"renderer/mesh_uv_atlas.vert", vertex}}));
    const std::vector<float> positions(9), uv = {0, 0, 0, 0.5f, 0.5f, 0};  // top left, v down
    const VertexStream streams[] = {{"position_mm", 3, positions}, {"uv", 2, uv}};
    const uint32_t indices[] = {0, 1, 2};
    Result<Geometry> mesh = Geometry::upload(device(), "atlas", streams, indices);
    ASSERT_TRUE(mesh) << mesh.error().message;
    Pass pass = white_pass("atlas");
    pass.kind = PassKind::geometry_uv_atlas;
    PassList list = out_list({pass});
    list.images[0].size = {8, 8};
    run(executor, list, {.width = 100, .height = 50, .draws = {draw_of(*mesh, 3)}});
    const Image image = read(executor, "out");
    EXPECT_EQ(image.width, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            if (x + y != 3) {
                EXPECT_EQ(image.at(x, y, 0), x + y < 3 ? 1.f : 0.f) << x << ", " << y;
            }
}

TEST_F(RasterTest, a_stream_that_is_put_is_drawn) {
    const std::string vertex = kHead + R"(
layout(location = 0) in vec2 uv;
void main() { gl_Position = vec4(uv * 2 - 1, 0, 1); })";
    Executor executor = make_executor(basic_shaders({{"renderer/mesh_uv_atlas.vert", vertex}}));
    const std::vector<float> nowhere(6), everywhere = {0, 0, 0, 2, 2, 0};
    const VertexStream streams[] = {{"uv", 2, nowhere}};
    const uint32_t indices[] = {0, 1, 2};
    Result<Geometry> mesh = Geometry::upload(device(), "atlas", streams, indices);
    ASSERT_TRUE(mesh) << mesh.error().message;
    Pass pass = white_pass("atlas");
    pass.kind = PassKind::geometry_uv_atlas;
    PassList list = out_list({pass});
    list.images[0].size = {4, 4};
    const auto drawn = [&] {
        run(executor, list, {.width = 4, .height = 4, .draws = {draw_of(*mesh, 3)}});
        return read(executor, "out").at(1, 1, 0);
    };
    EXPECT_EQ(drawn(), 0.f);
    ASSERT_TRUE(mesh->put(device(), {"uv", 2, everywhere}));
    EXPECT_EQ(drawn(), 1.f);
    EXPECT_EQ(mesh->put(device(), {"uv", 3, everywhere}).error().message,
              "geometry 'atlas': stream 'uv' does not fit its vertices");
    EXPECT_TRUE(mesh->put(device(), {"normal", 2, everywhere})) << "one that upload() did not get";
    EXPECT_FALSE(mesh->put(device(), {"uv", 2, std::span(nowhere).first(4)}));
}

TEST_F(RasterTest, counter_clockwise_on_screen_is_the_front) {
    Executor executor = make_executor(basic_shaders());
    const Geometry mesh = clip_mesh(device(), square(1, 0));
    Pass back_culled = white_pass("back culled"), front_culled = white_pass("front culled");
    back_culled.cull = Cull::back;
    front_culled.cull = Cull::front;
    const FrameResult result = run(executor, out_list({back_culled, front_culled}),
                                   {.width = 4, .height = 4, .draws = {draw_of(mesh, 6)}});
    EXPECT_EQ(result.passes[0].samples_passed, 16u);
    EXPECT_EQ(result.passes[1].samples_passed, 0u);
}

TEST_F(RasterTest, the_nearer_depth_wins) {
    Executor executor = make_executor(basic_shaders());
    const Geometry near = clip_mesh(device(), square(0.5f, 0.25f)),
                   far = clip_mesh(device(), square(1, 0.75f));
    const FrameResult result = run(executor, out_list({white_pass("draw", DepthTarget{.image = "depth"})}),
                                   {.width = 4, .height = 4, .draws = {draw_of(near, 6), draw_of(far, 6)}});
    EXPECT_EQ(result.passes[0].samples_passed, 4u + 12u);
    const Image depth = read(executor, "depth");
    EXPECT_EQ(depth.channels, 1);
    EXPECT_EQ(depth.at(0, 0, 0), 0.75f);
    EXPECT_EQ(depth.at(1, 1, 0), 0.25f);
}

// The mask of texture-space passes: the geometry writes depth, full-screen passes test EQUAL.
TEST_F(RasterTest, an_equal_mask_stops_what_it_does_not_cover) {
    const std::string at_quarter = kHead + R"(
void main() {
    vec2 uv = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(uv * 2 - 1, 0.25, 1);
})";
    Executor executor = make_executor(basic_shaders({{"quarter.vert", at_quarter}}));
    const Geometry mesh = clip_mesh(device(), square(0.5f, 0.25f));
    Pass mask{.name = "mask", .kind = PassKind::geometry_screen, .depth = DepthTarget{.image = "depth"}};
    Pass masked{.name = "masked",
                .shader = "white.frag",
                .vertex_shader = "quarter.vert",
                .colors = {{.image = "out"}},
                .depth = DepthTarget{
                    .image = "depth", .load = LoadOp::load, .write = false, .compare = Compare::equal}};
    const FrameResult result =
        run(executor, out_list({mask, masked}), {.width = 8, .height = 8, .draws = {draw_of(mesh, 6)}});
    EXPECT_EQ(result.passes[0].samples_passed, 16u);
    EXPECT_EQ(result.passes[1].samples_passed, 16u);
    const Image image = read(executor, "out");
    EXPECT_EQ(image.at(1, 1, 0), 0);
    EXPECT_EQ(image.at(2, 2, 0), 1);
}

TEST_F(RasterTest, depth_that_is_only_tested_can_be_sampled_in_the_same_pass) {
    const std::string show_depth = kHead + R"(
uniform texture2D depth;
uniform sampler nearest_clamp;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(depth, nearest_clamp), uv); })";
    Executor executor = make_executor(basic_shaders({{"show_depth.frag", show_depth}}));
    const Geometry mesh = clip_mesh(device(), square(0.5f, 0.25f));
    Pass lay{.name = "lay", .kind = PassKind::geometry_screen, .depth = DepthTarget{.image = "depth"}};
    // Full-screen triangles have z = 0, which passes everywhere: the result is the sampled depth.
    Pass show{.name = "show",
              .shader = "show_depth.frag",
              .reads = {"depth"},
              .colors = {{.image = "out"}},
              .depth = DepthTarget{.image = "depth", .load = LoadOp::load, .write = false}};
    for (int twice = 0; twice < 2; ++twice)
        run(executor, out_list({lay, show}), {.width = 8, .height = 8, .draws = {draw_of(mesh, 6)}});
    const Image image = read(executor, "out");
    EXPECT_EQ(image.at(0, 0, 0), 1);
    EXPECT_EQ(image.at(4, 4, 0), 0.25f);
}

TEST_F(RasterTest, depth_bias_moves_depth_away) {
    Executor executor = make_executor(basic_shaders());
    const Geometry mesh = clip_mesh(device(), square(1, 0.5f));
    Pass biased{.name = "biased",
                .kind = PassKind::geometry_screen,
                .depth = DepthTarget{.image = "depth"},
                .depth_bias_constant = 1000};
    run(executor, out_list({biased}), {.width = 2, .height = 2, .draws = {draw_of(mesh, 6)}});
    const float depth = read(executor, "depth").at(0, 0, 0);
    EXPECT_GT(depth, 0.5f);
    EXPECT_LT(depth, 0.501f);
}

TEST_F(RasterTest, blending_and_write_masks_combine_with_what_is_there) {
    Executor executor = make_executor(basic_shaders({{"constant.frag", kConstant}}));
    const auto blended = [](Blend blend, uint32_t mask) {
        return Pass{.name = "blend",
                    .shader = "constant.frag",
                    .colors = {{.image = "out", .load = LoadOp::load, .blend = blend, .write_mask = mask}},
                    .values = {{"value", Vec4{0.5f, 0.25f, 2, 0.5f}}}};
    };
    const auto result = [&](Blend blend, uint32_t mask) {
        run(executor, out_list({clear_pass("out", {1, 2, 3, 4}), blended(blend, mask)}),
            {.width = 1, .height = 1});
        return texel(read(executor, "out"), 0, 0);
    };
    EXPECT_THAT(result(Blend::none, 0xF), ElementsAre(0.5f, 0.25f, 2, 0.5f));
    EXPECT_THAT(result(Blend::none, 0b0101), ElementsAre(0.5f, 2, 2, 4));
    EXPECT_THAT(result(Blend::additive, 0xF), ElementsAre(1.5f, 2.25f, 5, 4.5f));
    EXPECT_THAT(result(Blend::alpha, 0xF), ElementsAre(0.75f, 1.125f, 2.5f, 2.5f));
    EXPECT_THAT(result(Blend::multiply, 0xF), ElementsAre(0.5f, 0.5f, 6, 2));
}

TEST_F(RasterTest, a_pass_fills_several_targets) {
    const std::string two = kHead + R"(
layout(location = 0) out vec4 first;
layout(location = 1) out float second;
void main() { first = vec4(1, 2, 3, 4); second = 5; })";
    Executor executor = make_executor(basic_shaders({{"two.frag", two}}));
    PassList list =
        out_list({{.name = "two", .shader = "two.frag", .colors = {{.image = "out"}, {.image = "second"}}}});
    list.images.push_back({.name = "second", .format = ImageFormat::r16f});
    run(executor, list, {.width = 3, .height = 3});
    EXPECT_THAT(texel(read(executor, "out"), 2, 2), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(texel(read(executor, "second"), 2, 2), ElementsAre(5));
}

TEST_F(RasterTest, a_filter_takes_its_classes_only) {
    Executor executor = make_executor(basic_shaders());
    const Geometry one = clip_mesh(device(), square(1, 0));
    const Draw skin = draw_of(one, 6, DrawClass::skin), other = draw_of(one, 6, DrawClass::other),
               card = draw_of(one, 6, DrawClass::blended), glass = draw_of(one, 3, DrawClass::translucent);
    const auto samples = [&](GeometryFilter filter) {
        Pass pass = white_pass("draw");
        pass.geometry = filter;
        return run(executor, out_list({pass}),
                   {.width = 2, .height = 2, .draws = {skin, other, other, card, glass}})
            .passes[0]
            .samples_passed;
    };
    const uint64_t glass_samples = samples(GeometryFilter::translucent);
    EXPECT_LT(glass_samples, 4u);
    EXPECT_GT(glass_samples, 0u);
    EXPECT_EQ(samples(GeometryFilter::skin), 4u);
    EXPECT_EQ(samples(GeometryFilter::other), 8u);
    EXPECT_EQ(samples(GeometryFilter::blended), 4u);
    EXPECT_EQ(samples(GeometryFilter::opaque), 16u);
    EXPECT_EQ(samples(GeometryFilter::all), 16u + glass_samples);
}

TEST_F(RasterTest, materials_belong_to_draws) {
    const std::string material = kHead + R"(
layout(scalar) uniform Material { float roughness; };
uniform texture2D albedo;
uniform sampler linear_clamp;
layout(location = 0) out vec4 color;
void main() { color = vec4(roughness, texture(sampler2D(albedo, linear_clamp), vec2(0.5)).rgb); })";
    Executor executor = make_executor(basic_shaders({{"material.frag", material}}));
    const Geometry left = clip_mesh(device(), {-1, -1, 0, -1, 3, 0, 0, -1, 0}),
                   right = clip_mesh(device(), {0, -1, 0, 1, 3, 0, 1, -1, 0});
    const auto map = [](std::byte red) {
        return Texture::upload(device(), {.name = "map", .format = ImageFormat::r8, .bytes = {red}});
    };
    const Result<Texture> own = map(std::byte{255}), shared = map(std::byte{51});
    ASSERT_TRUE(own && shared);
    Draw first = draw_of(left, 3), second = draw_of(right, 3);
    first.values = {{"roughness", 2.f}}, second.values = {{"roughness", 3.f}};
    first.textures = {{"albedo", &*own}};
    Pass pass = white_pass("draw");
    pass.shader = "material.frag";
    run(executor, out_list({pass}),
        {.width = 8, .height = 8, .textures = {{"albedo", &*shared}}, .draws = {first, second}});
    const Image image = read(executor, "out");
    EXPECT_THAT(texel(image, 0, 0), ElementsAre(2, 1, 0, 0));
    EXPECT_THAT(texel(image, 7, 0), ElementsAre(3, FloatEq(51 / 255.f), 0, 0));
}

TEST_F(RasterTest, a_geometry_without_a_wanted_stream_is_an_error) {
    const std::string vertex = kHead + R"(
layout(location = 0) in vec3 position_mm;
layout(location = 1) in float curvature_per_mm;
void main() { gl_Position = vec4(position_mm * curvature_per_mm, 1); })";
    Executor executor = make_executor(basic_shaders({{"curved.vert", vertex}}));
    const Geometry mesh = clip_mesh(device(), square(1, 0));
    Pass pass = white_pass("draw");
    pass.vertex_shader = "curved.vert";
    const Result<FrameResult> result =
        executor.run(out_list({pass}), {.width = 1, .height = 1, .draws = {draw_of(mesh, 6)}});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message,
                HasSubstr("'curved.vert' wants input 'curvature_per_mm', which geometry 'clip mesh' lacks"));
}

}  // namespace
}  // namespace dermis::gpu
