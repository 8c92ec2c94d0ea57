// Shaders compiled while the program runs, and those it carries.

#include "support/temporary_directory.h"
#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ShaderSourceTest : public GpuTest {};

std::string constant_color(const std::string& expression) {
    return kHead + "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(" + expression +
           "); }\n";
}

PassList one_pass() {
    return {.images = {{.name = "out", .format = ImageFormat::rgba32f}},
            .passes = {{.name = "only",
                        .shader = "demo/flat.frag",
                        .vertex_shader = "renderer/fullscreen.vert",
                        .colors = {{.image = "out"}}}}};
}

/// A tree as the repository has it: shaders/include, shaders/renderer, techniques/demo.
class ShaderTree {
  public:
    ShaderTree() { write("shaders/renderer/fullscreen.vert", kFullscreen); }
    void write(const std::string& name, const std::string& text) {
        const Result<void> written = write_text_file(folder_.path / name, text);
        EXPECT_TRUE(written) << written.error().message;
    }
    [[nodiscard]] ShaderSource source() const { return disk_shaders(folder_.path); }

  private:
    TemporaryDirectory folder_;
};

TEST_F(ShaderSourceTest, changed_shaders_and_includes_are_read_again_when_forgotten) {
    ShaderTree tree;
    tree.write("techniques/demo/flat.frag",
               kHead +
                   "#extension GL_GOOGLE_include_directive : require\n"
                   "#include \"shaders/include/value.glsl\"\n"
                   "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(value()); }\n");
    tree.write("shaders/include/value.glsl", "float value() { return 1.0; }\n");
    Executor executor = make_executor(tree.source());
    run(executor, one_pass(), {.width = 1, .height = 1});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(1, 1, 1, 1));

    tree.write("shaders/include/value.glsl", "float value() { return 2.0; }\n");
    run(executor, one_pass(), {.width = 1, .height = 1});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(1, 1, 1, 1));
    executor.forget_shaders();
    run(executor, one_pass(), {.width = 1, .height = 1});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(2, 2, 2, 2));
}

TEST_F(ShaderSourceTest, a_shader_with_a_mistake_gives_the_compilers_message_and_can_be_corrected) {
    ShaderTree tree;
    tree.write("techniques/demo/flat.frag", constant_color("1, oops"));
    Executor executor = make_executor(tree.source());
    const Result<FrameResult> result = executor.run(one_pass(), {.width = 1, .height = 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message,
                AllOf(HasSubstr("pass 'only'"), HasSubstr("flat.frag:4"), HasSubstr("'oops'")));
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);

    tree.write("techniques/demo/flat.frag", constant_color("1, 2, 3, 4"));
    run(executor, one_pass(), {.width = 1, .height = 1});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(1, 2, 3, 4));
}

TEST_F(ShaderSourceTest, a_file_that_is_not_there_is_an_error) {
    const Result<std::vector<uint32_t>> words = ShaderTree().source()("demo/none.frag");
    ASSERT_FALSE(words);
    EXPECT_THAT(words.error().message, HasSubstr("'demo/none.frag' is neither in"));
}

TEST_F(ShaderSourceTest, words_that_are_not_spirv_are_an_error) {
    const ShaderSource junk = [](std::string_view) -> Result<std::vector<uint32_t>> {
        return std::vector<uint32_t>{0x07230203, 1, 2, 3, 4, 5, 6, 7};
    };
    Executor executor = make_executor(junk);
    const Result<FrameResult> result = executor.run(one_pass(), {.width = 1, .height = 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("pass 'only'"));
}

TEST_F(ShaderSourceTest, an_unknown_embedded_shader_is_an_error) {
    const uint32_t words[] = {1, 2, 3};
    const EmbeddedShader built_in[] = {{"renderer/one.frag", words}};
    const ShaderSource source = embedded_shaders(built_in);
    EXPECT_EQ(source("renderer/one.frag").value(), (std::vector<uint32_t>{1, 2, 3}));
    const Result<std::vector<uint32_t>> none = source("renderer/two.frag");
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("unknown shader 'renderer/two.frag'"));
}

}  // namespace
}  // namespace dermis::gpu
