// The build of the shaders, on a project of one shader and one include.

#include <gtest/gtest.h>

#include <fstream>

#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

}  // namespace

TEST(ShaderBuild, an_edited_include_compiles_its_shaders_again) {
    const TemporaryDirectory directory;
    const std::filesystem::path root = directory.path;
    write(root / "CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.25)\nproject(shaders CXX)\nset(CMAKE_CXX_STANDARD 20)\n"
          "include(" DERMIS_SOURCE_DIR
          "/cmake/Shaders.cmake)\nadd_library(table STATIC)\n"
          "target_include_directories(table PRIVATE " DERMIS_SOURCE_DIR ")\ndermis_embed_shaders(table)\n");
    write(root / "shaders/include/part.glsl", "const float kShade = 0.25;\n");
    write(root / "shaders/renderer/one.frag",
          "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include "
          "\"shaders/include/part.glsl\"\n"
          "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(kShade); }\n");
    const auto build = [&] { return run_shell("cmake --build " + (root / "build").string(), root.string()); };
    const std::string compiled = (root / "build/catalog/shaders/renderer/one.frag.inc").string();
    const ProgramResult configured =
        run_shell("cmake -G Ninja -S " + root.string() + " -B " + (root / "build").string(), root.string());
    ASSERT_EQ(configured.exit_code, 0) << configured.err;
    const ProgramResult built = build();
    ASSERT_EQ(built.exit_code, 0) << built.out;
    const std::string before = slurp(compiled);
    ASSERT_FALSE(before.empty());

    write(root / "shaders/include/part.glsl", "const float kShade = 0.75;\n");
    EXPECT_EQ(build().exit_code, 0);
    EXPECT_NE(slurp(compiled), before);
    EXPECT_NE(build().out.find("no work to do"), std::string::npos);

    write(root / "shaders/include/part.glsl", "const float kShade = true;;;\n");
    EXPECT_NE(build().exit_code, 0);
}
