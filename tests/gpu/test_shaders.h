#pragma once
// The smallest shaders that draw something, shared by the tests of this folder.

#include "support/gpu_fixture.h"

namespace dermis::gpu {

inline const std::string kHead =
    "#version 460\n"
    "#extension GL_EXT_scalar_block_layout : require\n";

/// One triangle over everything; uv 0..1 from the top left, z at `depth_value`.
inline const std::string kFullscreen = kHead + R"(
layout(location = 0) out vec2 uv;
void main() {
    uv = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(uv * 2 - 1, 0, 1);
})";

/// Positions are clip space.
inline const std::string kClipMesh = kHead + R"(
layout(location = 0) in vec3 position_mm;
void main() { gl_Position = vec4(position_mm, 1); })";

inline const std::string kWhite = kHead + R"(
layout(location = 0) out vec4 color;
void main() { color = vec4(1); })";

/// A copy of `source` with the push constant `scale`.
inline const std::string kScaled = kHead + R"(
uniform texture2D source;
uniform sampler nearest_clamp;
layout(push_constant, scalar) uniform Push { float scale; };
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(source, nearest_clamp), uv) * scale; })";

inline ShaderSource basic_shaders(std::map<std::string, std::string, std::less<>> more = {}) {
    more.emplace("renderer/fullscreen.vert", kFullscreen);
    more.emplace("renderer/mesh_screen.vert", kClipMesh);
    more.emplace("white.frag", kWhite);
    more.emplace("scaled.frag", kScaled);
    return glsl_shaders(std::move(more));
}

inline Pass clear_pass(std::string image, std::array<float, 4> color) {
    return {.name = "clear " + image, .colors = {{.image = image, .clear = color}}};
}

/// Triangles in clip space.
inline Geometry clip_mesh(Device& device, std::vector<float> positions) {
    std::vector<uint32_t> indices(positions.size() / 3);
    for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    const VertexStream stream{"position_mm", 3, positions};
    Result<Geometry> mesh = Geometry::upload(device, "clip mesh", std::span(&stream, 1), indices);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return std::move(*mesh);
}

inline Draw draw_of(const Geometry& geometry, uint32_t index_count, DrawClass draw_class = DrawClass::skin) {
    return {.geometry = &geometry, .index_count = index_count, .draw_class = draw_class};
}

/// One texel's channels as floats; works for u8 (0..1), f16 and f32.
std::vector<float> texel(const Image& image, int x, int y);

}  // namespace dermis::gpu
