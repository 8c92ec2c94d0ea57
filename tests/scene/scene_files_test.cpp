#include "dermis/scene/scene_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "dermis/scene/scene.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

using ::testing::Contains;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class SceneFiles : public ::testing::Test {
  protected:
    std::filesystem::path path(const std::string& name) { return directory_.path / name; }
    void write(const std::string& name, const std::string& text) {
        EXPECT_TRUE(write_text_file(path(name), text));
    }
    std::vector<std::filesystem::path> files(const std::string& name) {
        const Result<Scene> scene = load_built_in_scene(path(name).string());
        EXPECT_TRUE(scene) << scene.error().message;
        return scene ? files_of(*scene) : std::vector<std::filesystem::path>();
    }
    TemporaryDirectory directory_;
};

constexpr const char* kTriangle = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 200 0 0\nv 0 200 0\nf 1 2 3\n";

TEST_F(SceneFiles, a_mesh_brings_its_library_and_the_maps_that_this_names) {
    write("a.obj", kTriangle);
    EXPECT_THAT(files("a.obj"),
                UnorderedElementsAre(path("a.obj"), path("a.mtl")));  // though it is not there
    write("a.mtl", "newmtl m\nmap_Kd skin.png\n");
    EXPECT_THAT(files("a.obj"), UnorderedElementsAre(path("a.obj"), path("a.mtl"), path("skin.png")));
}

TEST_F(SceneFiles, a_gltf_brings_its_buffers_and_images) {
    write("a.bin", std::string(36, '\0'));
    write("a.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "buffers": [{"uri": "a.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "images": [{"uri": "skin.png"}], "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}]})");
    EXPECT_THAT(files("a.gltf"), UnorderedElementsAre(path("a.gltf"), path("a.bin"), path("skin.png")));
}

TEST_F(SceneFiles, a_scene_brings_all_it_names_and_knows_where_the_rest_would_be) {
    write("a.obj", kTriangle);
    write("skin.png", "");
    write("around.hdr", "");
    const std::string text =
        "[[mesh]]\nfile = \"a.obj\"\n[[mesh]]\nfile = \"builtin:spheres\"\n[maps]\nalbedo = \"skin.png\"\n"
        "[environment]\nfile = \"around.hdr\"\n";
    write("scene.toml", text);
    EXPECT_THAT(files("scene.toml"), UnorderedElementsAre(path("scene.toml"), path("a.obj"), path("a.mtl"),
                                                          path("skin.png"), path("around.hdr")));
    const auto description = parse_scene(text + "visible = true\n[material.m.maps]\nnormal = \"later.png\"\n",
                                         path("scene.toml"), built_in_catalog().subjects);
    ASSERT_TRUE(description) << description.error().message;
    EXPECT_THAT(paths_of(*description),
                UnorderedElementsAre(path("a.obj"), path("skin.png"), path("around.hdr"), path("later.png")));
}

}  // namespace
}  // namespace dermis
