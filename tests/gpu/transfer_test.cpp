// Resolve, mips, copy, compute, and images that one pass writes and the next reads.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TransferTest : public GpuTest {};

/// texel (x, y) = (x, y, x + y, 1)
const std::string kRamp = kHead + R"(
layout(location = 0) out vec4 color;
void main() { vec2 p = floor(gl_FragCoord.xy); color = vec4(p, p.x + p.y, 1); })";

Pass ramp_pass(std::string image) {
    return {.name = "ramp", .shader = "ramp.frag", .colors = {{.image = std::move(image)}}};
}

TEST_F(TransferTest, two_images_blur_back_and_forth) {
    const std::string blur = kHead + R"(
uniform texture2D source;
layout(push_constant) uniform Push { vec2 direction; };
layout(location = 0) out vec4 color;
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1, d = ivec2(direction);
    color = 0.25 * texelFetch(source, clamp(p - d, ivec2(0), last), 0) + 0.5 * texelFetch(source, p, 0) +
            0.25 * texelFetch(source, clamp(p + d, ivec2(0), last), 0);
})";
    const std::string extension = "#extension GL_EXT_samplerless_texture_functions : require\n";
    const std::string spot = kHead + R"(
layout(location = 0) out vec4 color;
void main() { color = vec4(ivec2(gl_FragCoord.xy) == ivec2(3) ? 64 : 0); })";
    Executor executor = make_executor(basic_shaders(
        {{"blur.frag", std::string(blur).insert(kHead.size(), extension)}, {"spot.frag", spot}}));
    const auto pass = [](std::string name, std::string from, std::string to, Vec2 direction) {
        return Pass{.name = std::move(name),
                    .shader = "blur.frag",
                    .reads = {{"source", std::move(from)}},
                    .colors = {{.image = std::move(to)}},
                    .values = {{"direction", direction}}};
    };
    const PassList list{
        .images = {{.name = "a", .format = ImageFormat::r32f}, {.name = "b", .format = ImageFormat::r32f}},
        .passes = {{.name = "spot", .shader = "spot.frag", .colors = {{.image = "a"}}},
                   pass("x", "a", "b", {1, 0}),
                   pass("y", "b", "a", {0, 1}),
                   pass("x again", "a", "b", {1, 0}),
                   pass("y again", "b", "a", {0, 1})}};
    run(executor, list, {.width = 7, .height = 7});
    const Image image = read(executor, "a");
    const float row[] = {0, 1, 4, 6, 4, 1, 0};  // the binomial kernel twice: 1 4 6 4 1
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 7; ++x) EXPECT_EQ(image.at(x, y, 0), row[x] * row[y] / 4) << x << ", " << y;
}

TEST_F(TransferTest, resolve_averages_the_samples_of_an_edge) {
    Executor executor = make_executor(basic_shaders());
    // The right edge is in the middle of the second pixel.
    const Geometry mesh = clip_mesh(device(), {-1, -1, 0.5f, -1, 1, 0.5f, -0.25f, -1, 0.5f,  //
                                               -1, 1, 0.5f, -0.25f, 1, 0.5f, -0.25f, -1, 0.5f});
    const PassList list{
        .images = {{.name = "many", .format = ImageFormat::r32f, .samples = 4},
                   {.name = "many depth", .format = ImageFormat::depth32f, .samples = 4},
                   {.name = "one", .format = ImageFormat::r32f},
                   {.name = "one depth", .format = ImageFormat::depth32f}},
        .passes = {
            {.name = "draw",
             .kind = PassKind::geometry_screen,
             .shader = "white.frag",
             .colors = {{.image = "many"}},
             .depth = DepthTarget{.image = "many depth"}},
            {.name = "resolve", .kind = PassKind::resolve, .reads = {"many"}, .colors = {{.image = "one"}}},
            {.name = "resolve depth",
             .kind = PassKind::resolve,
             .reads = {"many depth"},
             .depth = DepthTarget{.image = "one depth"}}}};
    const FrameResult result = run(executor, list, {.width = 4, .height = 4, .draws = {draw_of(mesh, 6)}});
    const Image image = read(executor, "one"), depth = read(executor, "one depth");
    for (int y = 0; y < 4; ++y) {
        EXPECT_EQ(image.at(0, y, 0), 1);
        EXPECT_EQ(image.at(1, y, 0), 0.5f);
        EXPECT_EQ(image.at(2, y, 0), 0);
        EXPECT_EQ(depth.at(0, y, 0), 0.5f);
        EXPECT_EQ(depth.at(2, y, 0), 1);
    }
    EXPECT_EQ(result.passes[0].samples_passed, 4u * (4 + 2));
    const Result<Image> many = executor.read("many");
    ASSERT_FALSE(many);
    EXPECT_THAT(many.error().message, HasSubstr("resolve it first"));
}

TEST_F(TransferTest, every_mip_is_the_mean_of_the_one_above) {
    Executor executor = make_executor(basic_shaders({{"ramp.frag", kRamp}}));
    const PassList list{
        .images = {{.name = "out", .format = ImageFormat::rgba32f, .mips = 0}},
        .passes = {ramp_pass("out"), {.name = "mips", .kind = PassKind::generate_mips, .reads = {"out"}}}};
    run(executor, list, {.width = 8, .height = 8});
    EXPECT_THAT(texel(read(executor, "out", 1), 1, 0), ElementsAre(2.5f, 0.5f, 3, 1));
    EXPECT_THAT(texel(read(executor, "out", 2), 0, 1), ElementsAre(1.5f, 5.5f, 7, 1));
    const Image last = read(executor, "out", 3);
    EXPECT_EQ(last.width, 1);
    EXPECT_THAT(texel(last, 0, 0), ElementsAre(3.5f, 3.5f, 7, 1));
    EXPECT_FALSE(executor.read("out", 4));
}

TEST_F(TransferTest, a_pass_draws_into_one_mip_level) {
    Executor executor = make_executor(basic_shaders({{"ramp.frag", kRamp}}));
    Pass into_second = ramp_pass("out");
    into_second.colors[0].mip = 1;
    const PassList list{.images = {{.name = "out", .format = ImageFormat::rgba32f, .mips = 2}},
                        .passes = {clear_pass("out", {9, 9, 9, 9}), into_second}};
    run(executor, list, {.width = 8, .height = 8});
    EXPECT_THAT(texel(read(executor, "out", 0), 7, 7), ElementsAre(9, 9, 9, 9));
    EXPECT_THAT(texel(read(executor, "out", 1), 3, 2), ElementsAre(3, 2, 5, 1));
}

TEST_F(TransferTest, a_copy_keeps_or_rescales) {
    Executor executor = make_executor(basic_shaders({{"ramp.frag", kRamp}}));
    const auto copy = [](std::string target) {
        return Pass{.name = "copy to " + target,
                    .kind = PassKind::copy,
                    .reads = {"from"},
                    .colors = {{.image = target}}};
    };
    const PassList list{
        .images = {{.name = "from", .format = ImageFormat::rgba32f},
                   {.name = "same", .format = ImageFormat::rgba32f},
                   {.name = "half", .format = ImageFormat::rgba16f, .size = {.frame_scale = 0.5f}}},
        .passes = {ramp_pass("from"), copy("same"), copy("half")}};
    run(executor, list, {.width = 8, .height = 4});
    EXPECT_THAT(texel(read(executor, "same"), 7, 3), ElementsAre(7, 3, 10, 1));
    const Image half = read(executor, "half");
    EXPECT_EQ(half.width, 4);
    EXPECT_EQ(half.height, 2);
    EXPECT_THAT(texel(half, 3, 1), ElementsAre(6.5f, 2.5f, 9, 1));
}

TEST_F(TransferTest, compute_covers_sizes_that_its_groups_do_not_divide) {
    const std::string compute = kHead + R"(
layout(local_size_x = 8, local_size_y = 4) in;
layout(rgba32f) uniform writeonly image2D target;
layout(push_constant) uniform Push { float gain; };
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(p, imageSize(target)))) imageStore(target, p, vec4(vec2(p) * gain, 0, 1));
})";
    Executor executor = make_executor(basic_shaders({{"fill.comp", compute}}));
    const PassList list{.images = {{.name = "filled", .format = ImageFormat::rgba32f},
                                   {.name = "scaled", .format = ImageFormat::rgba32f}},
                        .passes = {{.name = "fill",
                                    .kind = PassKind::compute,
                                    .shader = "fill.comp",
                                    .storage = {{"target", "filled"}},
                                    .values = {{"gain", 2.f}}},
                                   {.name = "scale",
                                    .shader = "scaled.frag",
                                    .reads = {{"source", "filled"}},
                                    .colors = {{.image = "scaled"}},
                                    .values = {{"scale", 10.f}}}}};
    const FrameResult result = run(executor, list, {.width = 9, .height = 5});
    EXPECT_THAT(texel(read(executor, "filled"), 8, 4), ElementsAre(16, 8, 0, 1));
    EXPECT_THAT(texel(read(executor, "scaled"), 8, 4), ElementsAre(160, 80, 0, 10));
    EXPECT_EQ(result.passes[0].samples_passed, 0u);
}

// Of two writes without a barrier between them, synchronization validation reports those of copies only: it
// is silent about storage images and about the targets of dynamic rendering.
TEST_F(TransferTest, two_copies_to_one_image_follow_each_other) {
    Executor executor = make_executor(basic_shaders());
    const auto copy = [](std::string from) {
        return Pass{
            .name = "copy " + from, .kind = PassKind::copy, .reads = {from}, .colors = {{.image = "to"}}};
    };
    const PassList list{.images = {{.name = "one"}, {.name = "two"}, {.name = "to"}},
                        .passes = {clear_pass("one", {1, 1, 1, 1}), clear_pass("two", {2, 2, 2, 2}),
                                   copy("one"), copy("two")}};
    run(executor, list, {.width = 16, .height = 16});
    EXPECT_THAT(texel(read(executor, "to"), 15, 15), ElementsAre(2, 2, 2, 2));
}

TEST_F(TransferTest, passes_that_write_the_same_image_follow_each_other) {
    const std::string compute = kHead + R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f) uniform image2D total;
layout(push_constant) uniform Push { float gain, offset; };
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(p, imageSize(total)))) imageStore(total, p, imageLoad(total, p) * gain + offset);
})";
    Executor executor = make_executor(basic_shaders({{"add.comp", compute}}));
    const auto add = [](std::string name, float gain, float offset) {
        return Pass{.name = std::move(name),
                    .kind = PassKind::compute,
                    .shader = "add.comp",
                    .storage = {"total"},
                    .values = {{"gain", gain}, {"offset", offset}}};
    };
    const PassList list{.images = {{.name = "total", .format = ImageFormat::r32f}},
                        .passes = {clear_pass("total", {5, 0, 0, 0}), add("add", 1, 2), add("scale", 10, 0),
                                   add("add again", 1, 3)}};
    run(executor, list, {.width = 33, .height = 17});
    EXPECT_EQ(read(executor, "total").at(32, 16, 0), 73);
}

TEST_F(TransferTest, a_storage_image_of_another_format_is_an_error) {
    const std::string compute = kHead + R"(
layout(local_size_x = 1) in;
layout(rgba16f) uniform writeonly image2D target;
void main() { imageStore(target, ivec2(0), vec4(1)); })";
    Executor executor = make_executor(basic_shaders({{"fill.comp", compute}}));
    const PassList list{
        .images = {{.name = "target", .format = ImageFormat::rgba32f}},
        .passes = {
            {.name = "fill", .kind = PassKind::compute, .shader = "fill.comp", .storage = {"target"}}}};
    const Result<FrameResult> result = executor.run(list, {.width = 1, .height = 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("must be declared layout(rgba32f)"));
}

TEST_F(TransferTest, impossible_transfers_are_errors) {
    Executor executor = make_executor(basic_shaders());
    const auto error = [&](ImageDeclaration from, ImageDeclaration to, PassKind kind) {
        from.name = "from", to.name = "to";
        PassList list{.images = {from, to}, .passes = {clear_pass("from", {})}};
        if (from.format == ImageFormat::depth32f)
            list.passes[0] = {.name = "clear depth", .depth = DepthTarget{.image = "from"}};
        list.passes.push_back(
            {.name = "transfer", .kind = kind, .reads = {"from"}, .colors = {{.image = "to"}}});
        const Result<FrameResult> result = executor.run(list, {.width = 4, .height = 4});
        return result ? std::string() : result.error().message;
    };
    EXPECT_THAT(error({.format = ImageFormat::r8}, {.format = ImageFormat::r8}, PassKind::resolve),
                HasSubstr("pass 'transfer': resolve needs a multisampled source"));
    EXPECT_THAT(error({.format = ImageFormat::depth32f}, {.format = ImageFormat::r32f}, PassKind::copy),
                HasSubstr("pass 'transfer': copy of depth"));
    EXPECT_THAT(error({.samples = 4, .mips = 2}, {}, PassKind::resolve), HasSubstr("neither mips nor"));
    EXPECT_THAT(error({.mips = 9}, {}, PassKind::copy), HasSubstr("9 mip levels; at most 3"));
}

TEST_F(TransferTest, every_format_reads_back_what_was_cleared) {
    Executor executor = make_executor(basic_shaders());
    PassList list;
    for (int i = 0; i <= int(ImageFormat::rgba32f); ++i) {
        const auto format = ImageFormat(i);
        const std::string name(format_name(format));
        list.images.push_back({.name = name, .format = format});
        list.passes.push_back(clear_pass(name, {1, 0.25f, 0, 0.625f}));  // no tie between two codes of 8 bits
    }
    list.images.push_back({.name = "depth32f", .format = ImageFormat::depth32f});
    list.passes.push_back({.name = "depth", .depth = DepthTarget{.image = "depth32f", .clear = 0.375f}});
    run(executor, list, {.width = 3, .height = 2});
    EXPECT_THAT(texel(read(executor, "r8"), 2, 1), ElementsAre(1));
    EXPECT_THAT(texel(read(executor, "rgba8"), 2, 1), ElementsAre(1, 64 / 255.f, 0, 159 / 255.f));
    EXPECT_THAT(texel(read(executor, "r16f"), 2, 1), ElementsAre(1));
    EXPECT_THAT(texel(read(executor, "rg16f"), 2, 1), ElementsAre(1, 0.25f));
    EXPECT_THAT(texel(read(executor, "rgba16f"), 2, 1), ElementsAre(1, 0.25f, 0, 0.625f));
    EXPECT_THAT(texel(read(executor, "r32f"), 2, 1), ElementsAre(1));
    EXPECT_THAT(texel(read(executor, "rgba32f"), 2, 1), ElementsAre(1, 0.25f, 0, 0.625f));
    EXPECT_THAT(texel(read(executor, "depth32f"), 2, 1), ElementsAre(0.375f));
    EXPECT_EQ(read(executor, "rgba8").format, PixelFormat::u8);
    EXPECT_EQ(read(executor, "rg16f").format, PixelFormat::f16);
    EXPECT_EQ(read(executor, "depth32f").format, PixelFormat::f32);
}

TEST_F(TransferTest, reading_an_image_that_is_not_there_names_those_that_are) {
    Executor executor = make_executor(basic_shaders());
    run(executor, {.images = {{.name = "radiance"}}, .passes = {clear_pass("radiance", {})}},
        {.width = 1, .height = 1});
    const Result<Image> image = executor.read("radience");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("did you mean 'radiance'?"));
}

}  // namespace
}  // namespace dermis::gpu
