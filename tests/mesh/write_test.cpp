#include <gtest/gtest.h>

#include <cstdlib>

#include "dermis/base/file.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/write_mesh.h"
#include "mesh/mesh_files.h"
#include "support/temporary_directory.h"

using namespace dermis;
using namespace dermis::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::byte> bytes(const std::string& text) {
    const auto span = bytes_of(text);
    return {span.begin(), span.end()};
}

// One grey texel, so that viewers and validators can decode it.
constexpr unsigned char kPngBytes[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
    0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
    0xda, 0x45, 0x08, 0x3b, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
};
const std::string kPng(std::begin(kPngBytes), std::end(kPngBytes));

Mesh skin_sphere() {
    Mesh mesh = make_sphere(10, 16);
    Material& m = mesh.materials[0];
    m.name = "skin";
    m.base_color_linear = {0.8f, 0.5f, 0.4f};
    m.roughness = 0.35f;
    m.ior = 1.4f;
    m.specular = 0.75f;
    m.emission_linear = {0, 0, 3};
    m.base_color_map.name = "maps/colour.png";
    m.normal_map = {.name = "normal.png", .encoded = bytes(kPng)};
    m.normal_scale = 0.5f;
    m.thickness_map.name = "maps/colour.png";
    m.scattering = Material::Scattering{.thickness_mm = 12,
                                        .attenuation_color = {0.5f, 0.25f, 0.125f},
                                        .attenuation_distance_mm = 3,
                                        .multiscatter_color = {0.7f, 0.4f, 0.3f},
                                        .scatter_strength = 0.5f,
                                        .anisotropy = 0.6f,
                                        .diffuse_transmission = 0.25f};
    mesh.materials.push_back({.name = "eye"});
    const uint32_t half = uint32_t(mesh.indices.size()) / 6 * 3;
    mesh.submeshes = {{"skin", 0, half, 0}, {"eye", half, uint32_t(mesh.indices.size()) - half, 1}};
    return mesh;
}

}  // namespace

TEST(WriteGlb, reads_back_as_it_was) {
    const TemporaryDirectory dir;
    const Mesh mesh = skin_sphere();
    const std::vector<NamedImage> images = {{"maps/colour.png", bytes(kPng)}};
    const auto written = write_glb(dir.path / "a.glb", mesh, images);
    ASSERT_TRUE(written) << written.error().message;
    const auto loaded = read_mesh(dir.path / "a.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Mesh& back = loaded->mesh;
    expect_sound(back);
    ASSERT_EQ(back.submeshes.size(), 2u);
    ASSERT_EQ(back.indices.size(), mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t a = mesh.indices[i], b = back.indices[i];
        EXPECT_LT(length(back.positions_mm[b] - mesh.positions_mm[a]), 1e-4f);
        EXPECT_LT(length(back.normals[b] - mesh.normals[a]), 1e-5f);
        EXPECT_EQ(back.tangents[b].w, mesh.tangents[a].w);
        EXPECT_EQ(back.uvs[b], mesh.uvs[a]);
    }
    const Material &m = mesh.materials[0], &n = back.materials[0];
    EXPECT_EQ(n.name, "skin");
    EXPECT_EQ(n.base_color_linear, m.base_color_linear);
    EXPECT_EQ(n.roughness, m.roughness);
    EXPECT_EQ(n.ior, m.ior);
    EXPECT_EQ(n.specular, m.specular);
    EXPECT_EQ(n.emission_linear, m.emission_linear);
    EXPECT_EQ(n.base_color_map.encoded, bytes(kPng));
    EXPECT_EQ(n.normal_map.encoded, bytes(kPng));
    EXPECT_EQ(n.normal_scale, m.normal_scale);
    ASSERT_TRUE(n.scattering);
    EXPECT_NEAR(n.scattering->thickness_mm, 12, 1e-5);
    EXPECT_EQ(n.scattering->attenuation_color, m.scattering->attenuation_color);
    EXPECT_NEAR(n.scattering->attenuation_distance_mm, 3, 1e-5);
    EXPECT_EQ(n.scattering->multiscatter_color, m.scattering->multiscatter_color);
    EXPECT_EQ(n.scattering->scatter_strength, m.scattering->scatter_strength);
    EXPECT_EQ(n.scattering->anisotropy, m.scattering->anisotropy);
    EXPECT_EQ(n.scattering->diffuse_transmission, m.scattering->diffuse_transmission);
}

TEST(WriteGlb, numbers_vertices_in_16_bits_where_they_fit) {
    const TemporaryDirectory dir;
    for (const uint32_t count : {65535u, 65536u}) {
        Mesh mesh = {.indices = {0, 1, count - 1}, .submeshes = {{"", 0, 3, 0}}, .materials = {{}}};
        for (uint32_t v = 0; v < count; ++v)
            mesh.positions_mm.push_back({float(v % 256), float(v / 256), float(v % 3)});
        const auto glb = glb_bytes(mesh);
        ASSERT_TRUE(glb) << glb.error().message;
        const std::string text(reinterpret_cast<const char*>(glb->data()), 2000);
        EXPECT_EQ(text.find("\"componentType\":5123") != std::string::npos, count == 65535) << count;
        ASSERT_TRUE(write_file(dir.path / "a.glb", *glb));
        const auto back = read_mesh(dir.path / "a.glb");
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->mesh.indices.size(), 3u);
        EXPECT_LT(length(back->mesh.positions_mm[back->mesh.indices[2]] - mesh.positions_mm[count - 1]),
                  1e-3f);
    }
}

TEST(WriteGlb, refuses_maps_it_cannot_embed_and_writes_nothing) {
    const TemporaryDirectory dir;
    Mesh mesh = make_plane(1, 1);
    mesh.materials[0].base_color_map.name = "colour.png";
    EXPECT_NE(write_glb(dir.path / "a.glb", mesh)
                  .error()
                  .message.find("no bytes were given for the map 'colour.png'"),
              std::string::npos);
    const std::vector<NamedImage> images = {{"colour.png", bytes("not an image")}};
    EXPECT_NE(write_glb(dir.path / "a.glb", mesh, images).error().message.find("neither PNG nor JPEG"),
              std::string::npos);
    mesh.materials[0].base_color_map = {};
    mesh.materials[0].name = "\xff";
    EXPECT_NE(write_glb(dir.path / "a.glb", mesh).error().message.find("UTF-8"), std::string::npos);
    EXPECT_FALSE(write_glb(dir.path / "a.glb", Mesh{}));
    EXPECT_TRUE(fs::is_empty(dir.path));
    EXPECT_FALSE(write_glb("/proc/no/such.glb", make_plane(1, 1)));
}

TEST(WriteGlb, passes_the_khronos_validator) {
    // `npm install gltf-validator` somewhere on NODE_PATH.
    if (std::system("node -e \"require('gltf-validator')\" >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "node or its package gltf-validator is not here";
    const TemporaryDirectory dir;
    const std::vector<NamedImage> images = {{"maps/colour.png", bytes(kPng)}};
    ASSERT_TRUE(write_glb(dir.path / "a.glb", skin_sphere(), images));
    const std::string script =
        "const v=require('gltf-validator');v.validateBytes(new "
        "Uint8Array(require('fs').readFileSync(process.argv[1])))"
        ".then(r=>{console.log(JSON.stringify(r.issues.messages.filter(m=>m.severity<2),null,1));"
        "process.exit(r.issues.numErrors+r.issues.numWarnings>0?1:0)})";
    const std::string command = "node -e \"" + script + "\" " + (dir.path / "a.glb").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(WriteObj, reads_back_as_it_was) {
    const TemporaryDirectory dir;
    Mesh mesh = skin_sphere();
    mesh.materials[1].name = "left eye";
    ASSERT_TRUE(write_obj(dir.path / "a.obj", mesh));
    const auto loaded = read_mesh(dir.path / "a.obj");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Mesh& back = loaded->mesh;
    ASSERT_EQ(back.indices.size(), mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t a = mesh.indices[i], b = back.indices[i];
        EXPECT_EQ(back.positions_mm[b], mesh.positions_mm[a]);
        EXPECT_LT(length(back.normals[b] - mesh.normals[a]), 1e-6f);
        EXPECT_NEAR(back.uvs[b].y, mesh.uvs[a].y, 1e-6);
    }
    EXPECT_EQ(back.materials[0].roughness, 0.35f);
    EXPECT_EQ(back.materials[0].base_color_map.name, (dir.path / "maps/colour.png").generic_string());
    EXPECT_EQ(back.materials[1].name, "left_eye");
}

TEST(WriteObj, its_name_and_its_librarys_are_utf_8) {
    const TemporaryDirectory dir;
    const std::filesystem::path path = dir.path / utf8_path("h\xc3\xa4ut.obj");
    ASSERT_TRUE(write_obj(path, skin_sphere()));
    const auto loaded = read_mesh(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty() || loaded->warnings[0].find("library") == std::string::npos)
        << loaded->warnings[0];
    EXPECT_EQ(loaded->mesh.materials[0].roughness, 0.35f) << "the library was read";
}
