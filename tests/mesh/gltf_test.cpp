#include <gtest/gtest.h>

#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

Mesh read_gltf(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    auto loaded = parse_gltf_text(text, files);
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    expect_sound(loaded->mesh);
    return std::move(loaded->mesh);
}

std::string gltf_error_of(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    const auto loaded = parse_gltf_text(text, files);
    return loaded ? "" : loaded.error().message;
}

bool fails_with(const std::string& text, const std::string& part) {
    const std::string message = gltf_error_of(text);
    EXPECT_NE(message.find(part), std::string::npos) << "got: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return !message.empty();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

// A file of one primitive over given accessors, views and binary.
std::string gltf_of(const std::string& primitive, const std::string& accessors, const std::string& views,
                    const std::string& binary) {
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitive +
           R"(]}],"accessors":[)" + accessors + R"(],"bufferViews":[)" + views +
           R"(],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + R"(,"uri":")" +
           data_uri(binary) + "\"}]}";
}

}  // namespace

TEST(Gltf, metres_become_millimetres) {
    const Mesh mesh = read_gltf(square_gltf());
    EXPECT_EQ(mesh.positions_mm[2], (Vec3{1000, 1000, 0}));
    EXPECT_EQ(mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh.submeshes[0].name, "square");
    EXPECT_EQ(mesh.materials[0].name, "default");
    EXPECT_EQ(mesh.normals[0], (Vec3{0, 0, 1})) << "computed, since the file has none";
}

TEST(Gltf, node_transforms_chain) {
    const Mesh mesh = read_gltf(replaced(
        square_gltf(
            R"(,"translation":[1,2,3],"scale":[2,2,2],"children":[1]},{"mesh":0,"rotation":[0,0,0.70710678,0.70710678])"),
        R"("name":"square",)", ""));
    ASSERT_EQ(mesh.positions_mm.size(), 8u);
    EXPECT_EQ(mesh.positions_mm[1], (Vec3{3000, 2000, 3000}));
    // The child: a quarter turn about z first, then its parent's scale and shift.
    EXPECT_NEAR(mesh.positions_mm[5].x, 1000, 1e-2);
    EXPECT_NEAR(mesh.positions_mm[5].y, 4000, 1e-2);
}

TEST(Gltf, a_mirrored_node_keeps_its_front_outside) {
    const std::string matrix = R"(,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])";
    const Mesh mesh = read_gltf(square_gltf(matrix));
    EXPECT_EQ(mesh.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(mesh.positions_mm[1], (Vec3{-1000, 0, 0}));
}

TEST(Gltf, normals_of_a_mirrored_node_are_mirrored_and_not_turned_round) {
    const std::string binary = Binary()
                                   .add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0})
                                   .add<float>({0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f})
                                   .bytes();
    const std::string text =
        gltf_of(R"({"attributes":{"POSITION":0,"NORMAL":1}})",
                R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"})",
                R"({"buffer":0,"byteLength":72})", binary);
    const Mesh mesh = read_gltf(replaced(text, R"({"mesh":0})", R"({"mesh":0,"scale":[-1,1,1]})"));
    EXPECT_NEAR(mesh.normals[0].x, -0.6, 1e-6);
    EXPECT_NEAR(mesh.normals[0].z, 0.8, 1e-6);
}

TEST(Gltf, normals_follow_a_non_uniform_scale) {
    const std::string binary =
        Binary().add<float>({0, 0, 0, 1, 0, -1, 0, 1, 0}).add<float>({1, 0, 1, 1, 0, 1, 1, 0, 1}).bytes();
    std::string text =
        gltf_of(R"({"attributes":{"POSITION":0,"NORMAL":1}})",
                R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"})",
                R"({"buffer":0,"byteLength":72})", binary);
    const Mesh mesh = read_gltf(replaced(text, R"({"mesh":0})", R"({"mesh":0,"scale":[2,1,1]})"));
    EXPECT_NEAR(mesh.normals[0].z / mesh.normals[0].x, 2, 1e-5);
}

TEST(Gltf, indices_of_8_16_and_32_bits_and_none_agree) {
    const std::string positions = Binary().add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).bytes();
    const auto file = [&](const std::string& indices, int type) {
        return gltf_of(
            R"({"attributes":{"POSITION":0},"indices":1})",
            R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":)" +
                std::to_string(type) + R"(,"count":3,"type":"SCALAR"})",
            R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" +
                std::to_string(indices.size()) + "}",
            positions + indices);
    };
    const std::vector<uint32_t> expected = {0, 1, 2};
    EXPECT_EQ(read_gltf(file(Binary().add<uint8_t>({0, 1, 2}).bytes(), 5121)).indices, expected);
    EXPECT_EQ(read_gltf(file(Binary().add<uint16_t>({0, 1, 2}).bytes(), 5123)).indices, expected);
    EXPECT_EQ(read_gltf(file(Binary().add<uint32_t>({0, 1, 2}).bytes(), 5125)).indices, expected);
    EXPECT_EQ(read_gltf(gltf_of(R"({"attributes":{"POSITION":0}})",
                                R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})",
                                R"({"buffer":0,"byteLength":36})", positions))
                  .indices,
              expected);
}

TEST(Gltf, strips_and_fans_become_triangles) {
    EXPECT_EQ(read_gltf(replaced(square_gltf("", "", R"(,"mode":5)"), R"("count":6)", R"("count":3)"))
                  .triangle_count(),
              1u);
    const Mesh fan =
        read_gltf(replaced(square_gltf("", "", R"(,"mode":6)"), R"("componentType":5123,"count":6)",
                           R"("componentType":5123,"count":4)"));
    EXPECT_EQ(fan.triangle_count(), 2u);
    const auto points = parse_gltf_text(square_gltf("", "", R"(,"mode":0)"));
    ASSERT_FALSE(points);
    EXPECT_NE(points.error().message.find("no triangles"), std::string::npos);
}

TEST(Gltf, interleaved_and_normalised_attributes_are_read) {
    // Position (float3) and UV (u16 normalised), 16 bytes per vertex.
    Binary binary;
    for (const auto& [x, y, u] : {std::tuple{0.f, 0.f, 0}, {1.f, 0.f, 65535}, {0.f, 1.f, 32768}})
        binary.add<float>({x, y, 0}).add<uint16_t>({uint16_t(u), 65535});
    const Mesh mesh = read_gltf(gltf_of(
        R"({"attributes":{"POSITION":0,"TEXCOORD_0":1}})",
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
        R"({"bufferView":0,"byteOffset":12,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"})",
        R"({"buffer":0,"byteLength":48,"byteStride":16})", binary.bytes()));
    EXPECT_EQ(mesh.positions_mm[2], (Vec3{0, 1000, 0}));
    EXPECT_EQ(mesh.uvs[1], (Vec2{1, 1})) << "glTF's UV origin is ours";
    EXPECT_NEAR(mesh.uvs[2].x, 0.5, 1e-4);
}

TEST(Gltf, sparse_accessors_replace_elements) {
    const std::string binary =
        Binary().add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).add<float>({5, 6, 7}).add<uint16_t>({2, 0}).bytes();
    const std::string sparse =
        R"("sparse":{"count":1,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":1}})";
    const std::string views =
        R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":2})";
    const std::string text = gltf_of(
        R"({"attributes":{"POSITION":0}})",
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)" + sparse + "}", views, binary);
    EXPECT_EQ(read_gltf(text).positions_mm[2], (Vec3{5000, 6000, 7000}));
    // Without a base the rest is zero.
    EXPECT_EQ(read_gltf(replaced(text, R"("bufferView":0,"componentType":5126)", R"("componentType":5126)"))
                  .positions_mm[1],
              Vec3{});
    fails_with(replaced(text, R"("count":3)", R"("count":2)"), "index 2 is out of range");
}

TEST(Gltf, external_and_binary_chunk_buffers_are_found) {
    EXPECT_EQ(read_gltf(square_gltf("", "", "", "sub/my%20data.bin"), {{"sub/my data.bin", kSquareBinary}})
                  .triangle_count(),
              2u);
    const std::string json = replaced(square_gltf("", "", "", "X"), R"(,"uri":"X")", "");
    const auto binary = parse_mesh(bytes_of(glb(json, kSquareBinary)), MeshFormat::glb, "a.glb", {}, {});
    ASSERT_TRUE(binary) << binary.error().message;
    EXPECT_EQ(binary->mesh.triangle_count(), 2u);
}

TEST(Gltf, wrong_files_give_one_line_that_names_the_place) {
    fails_with("", "the file is empty");
    fails_with("{", "invalid JSON at byte");
    fails_with("[]", "must be an object");
    fails_with(std::string(100000, '['), "nested deeper than 128");
    std::string nested = "{\"a\":";
    for (int i = 0; i < 50000; ++i) nested += "{\"a\":";
    fails_with(nested, "nested deeper than 128");
    fails_with(R"({"asset":{"version":"1.0"}})", "only glTF 2.x");
    fails_with(R"({"asset":{"version":"2.0"}})", "no triangles");
    fails_with(square_gltf("", R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
               "KHR_draco_mesh_compression");
    fails_with(square_gltf("", "", "", "../../etc/passwd"), "leaves the file's directory");
    fails_with(square_gltf("", "", "", "%2e%2e/passwd"), "leaves the file's directory");
    fails_with(square_gltf("", "", "", "/etc/passwd"), "leaves the file's directory");
    fails_with(square_gltf("", "", "", "missing.bin"),
               "buffers[0]: cannot be read: missing.bin: cannot open");
    fails_with(square_gltf("", "", "", "data:;base64,AA*A"), "malformed data URI");
    fails_with(square_gltf("", "", "", "data:;base64,AAAA"), "truncated: 60 bytes stated, 3 found");
    fails_with(replaced(square_gltf(), R"("mesh":0)", R"("mesh":7)"), "meshes: has no element 7");
    fails_with(replaced(square_gltf(), R"("indices":1)", R"("indices":"x")"),
               "must be a non-negative integer");
    fails_with(replaced(square_gltf(), R"("count":4)", R"("count":5)"), "passes the end of its buffer view");
    fails_with(replaced(square_gltf(), R"("count":4)", R"("count":4e15)"), "more vertices than dermis loads");
    fails_with(replaced(square_gltf(), R"("count":4)", R"("count":3)"), "index 3 is out of range");
    fails_with(replaced(square_gltf(), R"("byteLength":48)", R"("byteLength":9007199254740992)"),
               "passes the end");
    fails_with(replaced(square_gltf(), R"("componentType":5126)", R"("componentType":5)"),
               "not a component type");
    fails_with(replaced(square_gltf(), R"("type":"VEC3")", R"("type":"MAT4")"), "must have 3 components");
    fails_with(square_gltf(R"(,"children":[0])"), "reached twice");
    fails_with(square_gltf(R"(,"scale":[1e38,1,1])"), "out of range in millimetres");
    fails_with(square_gltf(R"(,"scale":[1,1])"), "must be an array of 3 numbers");
    fails_with(square_gltf("", "", R"(,"material":3)"), "material 3 does not exist");
}

TEST(Gltf, positions_that_are_not_finite_are_refused) {
    std::string binary = kSquareBinary;
    const float nan = std::nanf("");
    std::memcpy(binary.data() + 16, &nan, 4);
    fails_with(square_gltf("", "", "", data_uri(binary)), "POSITION: must be finite");
}

TEST(Gltf, every_prefix_of_a_glb_and_of_a_gltf_loads_or_fails_cleanly) {
    const std::string json = replaced(square_gltf("", "", "", "X"), R"(,"uri":"X")", "");
    for (const std::string& whole : {glb(json, kSquareBinary), square_gltf()})
        for (size_t size = 0; size < whole.size(); ++size) {
            const auto loaded = parse_mesh(bytes_of(whole.substr(0, size)), MeshFormat::glb, "a.glb", {}, {});
            ASSERT_FALSE(loaded) << size;
            EXPECT_EQ(loaded.error().message.find('\n'), std::string::npos);
        }
}

TEST(Gltf, messages_stay_one_line_whatever_the_file_is_named_inside) {
    const std::string name = R"(evil\n\u001b[31m)" + std::string(5000, 'x');
    const auto refused = parse_gltf_text(square_gltf("", "", "", "../" + name));
    ASSERT_FALSE(refused);
    const auto warned = parse_gltf_text(square_gltf(
        "", R"(,"materials":[{"name":")" + name + R"(","pbrMetallicRoughness":{"roughnessFactor":2}}])",
        R"(,"material":0)"));
    ASSERT_TRUE(warned);
    std::vector<std::string> lines = warned->warnings;
    lines.push_back(refused.error().message);
    EXPECT_GE(lines.size(), 3u);
    for (const std::string& line : lines) {
        EXPECT_LT(line.size(), 1100u);
        EXPECT_EQ(line.find_first_of("\n\x1b"), std::string::npos);
    }
}

TEST(Gltf, a_thousand_warnings_become_fifty) {
    std::string list;
    for (int i = 0; i < 1000; ++i) list += (i > 0 ? ",\"X_" : "\"X_") + std::to_string(i) + "\"";
    const auto loaded = parse_gltf_text(square_gltf("", R"(,"extensionsUsed":[)" + list + "]"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->warnings.size(), 51u);
}

TEST(Gltf, instancing_cannot_unfold_without_bound) {
    std::string nodes = R"({"mesh":0,"children":[)";
    std::string rest;
    for (int i = 1; i <= 100; ++i) {
        nodes += (i > 1 ? "," : "") + std::to_string(i);
        rest += R"(,{"mesh":0})";
    }
    const std::string text = replaced(square_gltf(), R"({"mesh":0})", nodes + "]}" + rest);
    EXPECT_EQ(read_gltf(text).positions_mm.size(), 404u);
    const auto refused = parse_gltf_text(text, {}, {.max_vertices = 400});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("more vertices than dermis loads"), std::string::npos);
}
