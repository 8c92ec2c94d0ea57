// Uploads: cubes, mip levels, and data that does not fit its description.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TextureTest : public GpuTest {
  protected:
    /// Draws `fragment` into one texel with `texture` as "map".
    static std::vector<float> sample(const std::string& fragment, const Texture& texture,
                                     std::vector<NamedValue> values) {
        Executor executor = make_executor(basic_shaders({{"test.frag", kHead + fragment}}));
        const PassList list{.images = {{.name = "out", .format = ImageFormat::rgba32f}},
                            .passes = {{.name = "only",
                                        .shader = "test.frag",
                                        .colors = {{.image = "out"}},
                                        .values = std::move(values)}}};
        run(executor, list, {.width = 1, .height = 1, .textures = {{"map", &texture}}});
        return texel(read(executor, "out"), 0, 0);
    }
};

std::vector<std::byte> bytes_of(std::span<const float> values) {
    const auto raw = std::as_bytes(values);
    return {raw.begin(), raw.end()};
}

TEST_F(TextureTest, cube_faces_come_in_the_order_px_nx_py_ny_pz_nz) {
    std::vector<float> faces;
    for (int face = 0; face < 6; ++face) faces.insert(faces.end(), 4, float(face));
    Result<Texture> cube = Texture::upload(device(), {.name = "cube",
                                                      .format = ImageFormat::r32f,
                                                      .width = 2,
                                                      .height = 2,
                                                      .layers = 6,
                                                      .cube = true,
                                                      .bytes = bytes_of(faces)});
    ASSERT_TRUE(cube) << cube.error().message;
    const std::string shader = R"(
uniform textureCube map;
uniform sampler nearest_clamp;
layout(push_constant, scalar) uniform Push { vec3 direction; };
layout(location = 0) out vec4 color;
void main() { color = textureLod(samplerCube(map, nearest_clamp), direction, 0); })";
    const Vec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face)
        EXPECT_EQ(sample(shader, *cube, {{"direction", directions[face]}})[0], float(face));
}

const std::string kLod = R"(
uniform texture2D map;
uniform sampler trilinear_clamp;
layout(push_constant) uniform Push { float lod; };
layout(location = 0) out vec4 color;
void main() { color = textureLod(sampler2D(map, trilinear_clamp), vec2(0.5), lod); })";

TEST_F(TextureTest, mip_levels_can_be_supplied) {
    const float levels[] = {1, 1, 1, 1, 5};
    Result<Texture> map = Texture::upload(device(), {.name = "levels",
                                                     .format = ImageFormat::r32f,
                                                     .width = 2,
                                                     .height = 2,
                                                     .mips = 2,
                                                     .bytes = bytes_of(levels)});
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(sample(kLod, *map, {{"lod", 0.f}})[0], 1);
    EXPECT_EQ(sample(kLod, *map, {{"lod", 0.5f}})[0], 3);
    EXPECT_EQ(sample(kLod, *map, {{"lod", 1.f}})[0], 5);
}

TEST_F(TextureTest, mip_levels_can_be_generated) {
    const float texels[] = {1, 2, 3, 6};
    Result<Texture> map = Texture::upload(device(), {.name = "generated",
                                                     .format = ImageFormat::r32f,
                                                     .width = 2,
                                                     .height = 2,
                                                     .bytes = bytes_of(texels),
                                                     .generate_mips = true});
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(sample(kLod, *map, {{"lod", 1.f}})[0], 3);
}

// 5000 x 2000 texels of 4 bytes are 38 MiB, more than the staging buffer.
TEST_F(TextureTest, large_ones_arrive_in_several_strips) {
    std::vector<float> texels(5000 * 2000);
    for (size_t y = 0; y < 2000; ++y) texels[5000 * y + 7] = float(y);
    Result<Texture> map = Texture::upload(device(), {.name = "large",
                                                     .format = ImageFormat::r32f,
                                                     .width = 5000,
                                                     .height = 2000,
                                                     .bytes = bytes_of(texels)});
    ASSERT_TRUE(map) << map.error().message;
    const std::string shader = R"(
uniform texture2D map;
uniform sampler nearest_clamp;
layout(push_constant) uniform Push { int y; };
layout(location = 0) out vec4 color;
void main() { color = texelFetch(sampler2D(map, nearest_clamp), ivec2(7, y), 0); })";
    for (const int y : {0, 1000, 1676, 1677, 1678, 1999})
        EXPECT_EQ(sample(shader, *map, {{"y", y}})[0], float(y));
}

TEST_F(TextureTest, each_texture_has_its_own_address_modes) {
    const std::string shader = R"(
uniform sampler2D map;
layout(push_constant, scalar) uniform Push { vec2 uv; };
layout(location = 0) out vec4 color;
void main() { color = textureLod(map, uv, 0); })";
    const float texels[] = {1, 2, 3, 4};
    // At the middle of texel 5 of a row of 4, and one to the left of the row.
    const auto read = [&](AddressMode u, Vec2 uv, AddressMode v = AddressMode::repeat) {
        Result<Texture> map = Texture::upload(device(), {.name = "row",
                                                         .format = ImageFormat::r32f,
                                                         .width = v == AddressMode::repeat ? 4 : 1,
                                                         .height = v == AddressMode::repeat ? 1 : 4,
                                                         .bytes = bytes_of(texels),
                                                         .address_u = u,
                                                         .address_v = v});
        EXPECT_TRUE(map) << map.error().message;
        return sample(shader, *map, {{"uv", uv}})[0];
    };
    const Vec2 right = {1.375f, 0.5f}, left = {-0.375f, 0.5f};
    EXPECT_EQ(read(AddressMode::repeat, right), 2);
    EXPECT_EQ(read(AddressMode::clamp, right), 4);
    EXPECT_EQ(read(AddressMode::mirror, right), 3);
    EXPECT_EQ(read(AddressMode::repeat, left), 3);
    EXPECT_EQ(read(AddressMode::clamp, left), 1);
    EXPECT_EQ(read(AddressMode::mirror, left), 2);
    EXPECT_EQ(read(AddressMode::repeat, {0.5f, 1.375f}, AddressMode::mirror), 3);
    EXPECT_EQ(read(AddressMode::repeat, {0.5f, 1.375f}, AddressMode::clamp), 4);
}

TEST_F(TextureTest, outside_the_shadow_map_is_lit) {
    const float depth[] = {0.5f};
    Result<Texture> map = Texture::upload(
        device(), {.name = "depth", .format = ImageFormat::depth32f, .bytes = bytes_of(depth)});
    ASSERT_TRUE(map) << map.error().message;
    const std::string shader = R"(
uniform texture2D map;
uniform samplerShadow shadow_compare;
layout(push_constant, scalar) uniform Push { vec3 coordinate; };
layout(location = 0) out vec4 color;
void main() { color = vec4(texture(sampler2DShadow(map, shadow_compare), coordinate)); })";
    EXPECT_EQ(sample(shader, *map, {{"coordinate", Vec3{0.5f, 0.5f, 0.4f}}})[0], 1);
    EXPECT_EQ(sample(shader, *map, {{"coordinate", Vec3{0.5f, 0.5f, 0.6f}}})[0], 0);
    EXPECT_EQ(sample(shader, *map, {{"coordinate", Vec3{3.5f, 0.5f, 0.6f}}})[0], 1);
}

TEST_F(TextureTest, data_that_does_not_fit_is_an_error) {
    const auto error = [](const TextureData& data) {
        const Result<Texture> texture = Texture::upload(device(), data);
        return texture ? std::string() : texture.error().message;
    };
    EXPECT_THAT(error({.name = "short", .format = ImageFormat::rgba8, .bytes = std::vector<std::byte>(3)}),
                HasSubstr("texture 'short': has 3 bytes instead of 4"));
    EXPECT_THAT(error({.name = "none", .width = 0}), HasSubstr("size 0x1"));
    EXPECT_THAT(error({.name = "deep", .mips = 2}), HasSubstr("2 mip levels; 1 to 1"));
    EXPECT_THAT(error({.name = "box", .layers = 5, .cube = true}), HasSubstr("six square layers"));
    EXPECT_THAT(error({.name = "float", .format = ImageFormat::r32f, .srgb = true}),
                HasSubstr("only rgba8 can be sRGB"));
}

TEST_F(TextureTest, geometry_that_does_not_fit_is_an_error) {
    const std::vector<float> three(9), two(4);
    const auto error = [](std::vector<VertexStream> streams, std::vector<uint32_t> indices) {
        const Result<Geometry> mesh = Geometry::upload(device(), "bad", streams, indices);
        return mesh ? std::string() : mesh.error().message;
    };
    EXPECT_THAT(error({{"position_mm", 3, three}, {"uv", 2, two}}, {0, 1, 2}),
                HasSubstr("'uv' has 2 vertices, 'position_mm' has 3"));
    EXPECT_THAT(error({{"position_mm", 3, three}}, {0, 1, 3}), HasSubstr("index 3 of only 3 vertices"));
    EXPECT_THAT(error({{"position_mm", 3, three}}, {0, 1}), HasSubstr("no whole number of triangles"));
    EXPECT_THAT(error({}, {}), HasSubstr("no vertices"));
}

}  // namespace
}  // namespace dermis::gpu
