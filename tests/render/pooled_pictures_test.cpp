// Descriptor sets from a pool draw the same bytes as pushed descriptors.

#include "dermis/gpu/reflection.h"
#include "render/render_test.h"

namespace dermis {
namespace {

class PooledPictures : public RenderTest {
  protected:
    static void SetUpTestSuite() { open_device({.validation = true, .pooled_descriptors = true}); }
};

Image display_of(Renderer& renderer, const Technique& technique, const ParameterValues& values) {
    const Result<gpu::FrameResult> drawn =
        renderer.draw(technique, values, {.width = 64, .height = 48, .samples = 4, .shadow_map_size = 256});
    EXPECT_TRUE(drawn) << technique.id << ": " << drawn.error().message;
    Result<Image> display = renderer.display();
    EXPECT_TRUE(display) << display.error().message;
    return std::move(*display);
}

}  // namespace

// Lavapipe, NVIDIA and AMD push 32.
TEST(PushedBindings, of_every_shader_fit_into_32) {
    for (const gpu::EmbeddedShader& shader : built_in_catalog().shaders) {
        const Result<gpu::ShaderInterface> interface = gpu::reflect(shader.name, shader.words);
        ASSERT_TRUE(interface) << shader.name << ": " << interface.error().message;
        EXPECT_LE(interface->bindings.size(), 32u) << shader.name;
    }
}

TEST_F(PooledPictures, are_those_of_pushed_descriptors_with_every_technique) {
    Result<gpu::Device> pushing = gpu::Device::create({.validation = true});
    ASSERT_TRUE(pushing) << pushing.error().message;
    if (!pushing->info().push_descriptors)
        GTEST_SKIP() << pushing->info().name << " has no VK_KHR_push_descriptor";
    const Scene scene = load("builtin:glasses");
    Renderer pooled_renderer = make_renderer(scene);
    Result<Renderer> pushed_renderer =
        Renderer::create(*pushing, gpu::embedded_shaders(built_in_catalog().shaders), scene);
    ASSERT_TRUE(pushed_renderer) << pushed_renderer.error().message;
    for (const Technique& technique : built_in_catalog().techniques) {
        const ParameterValues values = small_map_values(technique);
        const Image pooled = display_of(pooled_renderer, technique, values);
        const Image pushed = display_of(*pushed_renderer, technique, values);
        ASSERT_EQ(pooled.bytes.size(), pushed.bytes.size()) << technique.id;
        EXPECT_TRUE(pooled.bytes == pushed.bytes) << technique.id;
    }
    EXPECT_THAT(pushing->messages(), ::testing::IsEmpty());
}

}  // namespace dermis
