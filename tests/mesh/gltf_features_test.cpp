// Features of glTF files of heads beyond positions and one texture; others are refused or named in warnings.

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

// Accessors are numbered as they are added; every one has its own view of one buffer.
class GltfBuilder {
  public:
    // Numbers of `component` type (5126 floats) in elements of `type`.
    template <class T>
    GltfBuilder& accessor(int component, const std::string& type, size_t count,
                          std::initializer_list<T> values, const std::string& extra = "") {
        while (binary_.size() % 4 != 0) binary_ += '\0';
        const std::string bytes = Binary().add<T>(values).bytes();
        add(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(binary_.size()) + R"(,"byteLength":)" +
                        std::to_string(bytes.size()) + "}");
        add(accessors_, R"({"bufferView":)" + std::to_string(number_++) + R"(,"componentType":)" +
                            std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                            R"(,"type":")" + type + "\"" + extra + "}");
        binary_ += bytes;
        return *this;
    }
    [[nodiscard]] std::string file(const std::string& primitives, const std::string& nodes = R"({"mesh":0})",
                                   const std::string& extra = "") const {
        return R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + R"(],"meshes":[{"primitives":[)" +
               primitives + R"(]}],"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
               R"(],"buffers":[{"byteLength":)" + std::to_string(binary_.size()) + R"(,"uri":")" +
               data_uri(binary_) + "\"}]" + extra + "}";
    }

  private:
    static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }
    std::string accessors_, views_, binary_;
    int number_ = 0;
};

// Accessor 0: a triangle of legs of 1 m.
GltfBuilder triangle() {
    return GltfBuilder().accessor<float>(5126, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
}

LoadedMesh load_gltf(const std::string& text, const MeshOptions& options = {}) {
    auto loaded = parse_gltf_text(text, {}, options);
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    expect_sound(loaded->mesh);
    return std::move(*loaded);
}

std::string features_error_of(const std::string& text, const MeshOptions& options = {}) {
    const auto loaded = parse_gltf_text(text, {}, options);
    return loaded ? "" : loaded.error().message;
}

void expect_near(Vec3 a, Vec3 b) {
    EXPECT_LT(length(a - b), 1e-2) << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " "
                                   << b.z;
}
void expect_near(Vec2 a, Vec2 b) {
    EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 1e-5) << a.x << " " << a.y << " for " << b.x << " " << b.y;
}

// Two joints bound at the origin and at (0, 1, 0); accessors 1 to 3: joints, weights, inverse bind matrices.
GltfBuilder skinned_triangle(std::initializer_list<float> weights) {
    return triangle()
        .accessor<uint8_t>(5121, "VEC4", 3, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0})
        .accessor<float>(5126, "VEC4", 3, weights)
        .accessor<float>(5126, "MAT4", 2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
}
const std::string kSkinned = R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}})";
const std::string kSkin = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":3}])";

}  // namespace

TEST(GltfSkin, vertices_follow_their_joints_and_not_the_node_of_the_mesh) {
    // Joint 0 is moved by (0, 0, 5), its child a metre above is turned by 90 degrees about z; half a metre
    // and all weights are doubled, which changes nothing.
    const std::string nodes =
        R"({"mesh":0,"skin":0,"translation":[99,0,0],"scale":[3,3,3]},{"translation":[0,0,5],"children":[2]},)"
        R"({"translation":[0,1,0],"rotation":[0,0,0.70710678,0.70710678]})";
    const std::string text =
        skinned_triangle({2, 0, 0, 0, 0, 2, 0, 0, 1, 1, 0, 0}).file(kSkinned, nodes, kSkin);
    const Mesh mesh = load_gltf(text).mesh;
    expect_near(mesh.positions_mm[0], {0, 0, 5000});
    // (1, 0, 0) is (1, -1, 0) for joint 1; turned (1, 1, 0); then (0, 1, 0) and (0, 0, 5).
    expect_near(mesh.positions_mm[1], {1000, 2000, 5000});
    // (0, 1, 0) is the position of joint 1: both joints agree.
    expect_near(mesh.positions_mm[2], {0, 1000, 5000});
}

TEST(GltfSkin, a_vertex_without_weights_and_a_skin_without_bind_matrices_are_read) {
    const std::string nodes = R"({"mesh":0,"skin":0},{"scale":[2,2,2]},{})";
    const std::string text = skinned_triangle({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0})
                                 .file(kSkinned, nodes, R"(,"skins":[{"joints":[1,2]}])");
    const Mesh mesh = load_gltf(text).mesh;
    expect_near(mesh.positions_mm[1], {2000, 0, 0});
    expect_near(mesh.positions_mm[2], {0, 1000, 0});
}

TEST(GltfSkin, normals_and_mirrored_joints_are_right) {
    const std::string text =
        triangle()
            .accessor<uint8_t>(5121, "VEC4", 3, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})
            .accessor<uint8_t>(5121, "VEC4", 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0},
                               R"(,"normalized":true)")
            .accessor<float>(5126, "VEC3", 3, {0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f})
            .file(R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"NORMAL":3}})",
                  R"({"mesh":0,"skin":0},{"scale":[-1,1,1]})", R"(,"skins":[{"joints":[1]}])");
    const LoadedMesh loaded = load_gltf(text);
    EXPECT_NEAR(loaded.mesh.normals[0].x, -0.6, 1e-6);
    EXPECT_NEAR(loaded.mesh.normals[0].z, 0.8, 1e-6);
    EXPECT_FALSE(any_contains(loaded.warnings, "face against their normals"));
}

TEST(GltfSkin, weights_that_do_not_sum_to_1_are_named) {
    const auto warnings = [](std::initializer_list<float> weights) {
        return load_gltf(skinned_triangle(weights).file(kSkinned,
                                                        R"({"mesh":0,"skin":0},{"children":[2]},{})", kSkin))
            .warnings;
    };
    EXPECT_FALSE(any_contains(warnings({1, 0, 0, 0, 0.5f, 0.502f, 0, 0, 0.25f, 0.75f, 0, 0}), "WEIGHTS"))
        << "8 bits";
    const auto wrong = warnings({2, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0});
    EXPECT_TRUE(
        any_contains(wrong, "attributes.WEIGHTS_0: the weights of 2 vertices do not sum to 1; scaled to it"));
    EXPECT_TRUE(any_contains(wrong, "attributes.WEIGHTS_0: 1 vertices have no weight; they follow no joint"));
}

TEST(GltfExtras, cameras_are_named_once) {
    const LoadedMesh loaded = load_gltf(square_gltf(
        "",
        R"(,"animations":[{},{}],"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])"));
    EXPECT_TRUE(any_contains(loaded.warnings, "cameras: 1 not used"));
    const LoadedMesh none = load_gltf(square_gltf("", R"(,"animations":[],"cameras":[])"));
    EXPECT_FALSE(any_contains(none.warnings, "cameras"));
}

TEST(GltfSkin, what_is_wrong_is_named) {
    const auto message = [](const std::string& skins, const std::string& attributes = kSkinned) {
        return features_error_of(
            skinned_triangle({1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0})
                .file(attributes, R"({"mesh":0,"skin":0},{},{})", R"(,"skins":[)" + skins + "]"));
    };
    EXPECT_NE(message(R"({"joints":[1]})").find("JOINTS_0: a joint is out of range (the skin has 1)"),
              std::string::npos);
    EXPECT_NE(message(R"({"joints":[1,9]})").find("node 9 does not exist"), std::string::npos);
    EXPECT_NE(message(R"({"joints":[]})").find("has no joints"), std::string::npos);
    EXPECT_NE(message(R"({"joints":[1,2,0],"inverseBindMatrices":3})").find("has 2 matrices for 3 joints"),
              std::string::npos);
    EXPECT_NE(
        message(R"({"joints":[1,2]})", R"({"attributes":{"POSITION":0,"JOINTS_0":1}})").find("no WEIGHTS"),
        std::string::npos);
    EXPECT_NE(message("").find("skins: has no element 0"), std::string::npos);
}

TEST(GltfMorph, targets_count_by_the_weights_of_node_or_mesh) {
    const GltfBuilder builder = triangle().accessor<float>(5126, "VEC3", 3, {0, 0, 2, 0, 0, 2, 0, 0, 2});
    const std::string primitive = R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})";
    EXPECT_EQ(load_gltf(builder.file(primitive)).mesh.positions_mm[0].z, 0);
    EXPECT_EQ(load_gltf(builder.file(primitive, R"({"mesh":0,"weights":[0.5]})")).mesh.positions_mm[0].z,
              1000);
    const std::string with_weights = primitive + R"(],"weights":[0.25],"extras":[0)";
    EXPECT_EQ(load_gltf(builder.file(with_weights)).mesh.positions_mm[0].z, 500);
}

// Changes beyond the last vertex were written past the end.
TEST(GltfMorph, a_target_of_more_vertices_is_refused) {
    const GltfBuilder builder =
        triangle().accessor<float>(5126, "VEC3", 5, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    const std::string text = builder.file(R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})",
                                          R"({"mesh":0,"weights":[0.5]})");
    EXPECT_NE(features_error_of(text).find("targets[0].POSITION: has 5 elements for 3 positions"),
              std::string::npos)
        << features_error_of(text);
}

TEST(GltfUv, each_materials_set_and_transform_change_its_primitives_uvs) {
    // TEXCOORD_0: corners of the square; TEXCOORD_1: everything at (0.25, 0.75).
    const GltfBuilder builder =
        triangle()
            .accessor<float>(5126, "VEC2", 3, {0, 0, 1, 0, 0, 1})
            .accessor<float>(5126, "VEC2", 3, {0.25f, 0.75f, 0.25f, 0.75f, 0.25f, 0.75f});
    struct Case {
        std::string info;
        std::array<Vec2, 3> uvs;
    };
    const auto transform = [](const std::string& content, const std::string& before = "") {
        return R"({"index":0)" + before + R"(,"extensions":{"KHR_texture_transform":{)" + content + "}}}";
    };
    const Case cases[] = {
        {R"({"index":0})", {Vec2{0, 0}, {1, 0}, {0, 1}}},
        {R"({"index":0,"texCoord":1})", {Vec2{0.25f, 0.75f}, {0.25f, 0.75f}, {0.25f, 0.75f}}},
        {transform(R"("offset":[0.5,0.25])"), {Vec2{0.5f, 0.25f}, {1.5f, 0.25f}, {0.5f, 1.25f}}},
        {transform(R"("scale":[2,0.5])"), {Vec2{0, 0}, {2, 0}, {0, 0.5f}}},
        // The specification's example: the lower left quarter of the picture, turned by 90 degrees.
        {transform(R"("offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5])"),
         {Vec2{0, 1}, {0, 0.5f}, {0.5f, 1}}},
        {transform(R"("texCoord":1)"), {Vec2{0.25f, 0.75f}, {0.25f, 0.75f}, {0.25f, 0.75f}}},
        {transform(R"("texCoord":0,"scale":[3,1])", R"(,"texCoord":1)"), {Vec2{0, 0}, {3, 0}, {0, 1}}}};
    for (const Case& c : cases) {
        const LoadedMesh loaded = load_gltf(builder.file(
            R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2},"material":0})", R"({"mesh":0})",
            R"(,"textures":[{"source":0}],"images":[{"uri":"a.png"}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":)" +
                c.info + "}}]"));
        for (size_t k = 0; k < 3; ++k) expect_near(loaded.mesh.uvs[loaded.mesh.indices[k]], c.uvs[k]);
        EXPECT_EQ(loaded.mesh.materials[0].base_color_map.name, "dir/a.png") << c.info;
        EXPECT_FALSE(any_contains(loaded.warnings, "not used")) << c.info;
    }
}

TEST(GltfUv, tangents_of_a_rotated_texture_are_computed_again) {
    const GltfBuilder builder =
        triangle()
            .accessor<float>(5126, "VEC2", 3, {0, 1, 1, 1, 0, 0})
            .accessor<float>(5126, "VEC4", 3, {0.6f, 0.8f, 0, 1, 0.6f, 0.8f, 0, 1, 0.6f, 0.8f, 0, 1})
            .accessor<float>(5126, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    const auto tangent = [&](const std::string& transform) {
        return load_gltf(
                   builder.file(
                       R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TANGENT":2,"NORMAL":3},"material":0})",
                       R"({"mesh":0})",
                       R"(,"textures":[{"source":0}],"images":[{"uri":"a.png"}],"materials":[{"normalTexture":{"index":0,)"
                       R"("extensions":{"KHR_texture_transform":{)" +
                           transform + "}}}}]"))
            .mesh.tangents[0];
    };
    EXPECT_NEAR(tangent(R"("scale":[4,4])").y, 0.8, 1e-6) << "the file's own";
    // u' = v: u grows downwards on the surface.
    EXPECT_NEAR(tangent(R"("rotation":1.57079632679)").y, -1, 1e-5);
}

TEST(GltfColors, of_three_and_four_numbers_of_every_type_are_read) {
    struct Case {
        int component;
        std::string type;
        GltfBuilder builder;
    };
    const std::string normalized = R"(,"normalized":true)";
    const Case cases[] = {
        {5126, "VEC3", triangle().accessor<float>(5126, "VEC3", 3, {1, 0.2f, 0, 1, 0.2f, 0, 1, 0.2f, 0})},
        {5126, "VEC4",
         triangle().accessor<float>(5126, "VEC4", 3, {1, 0.2f, 0, 1, 1, 0.2f, 0, 1, 1, 0.2f, 0, 1})},
        {5121, "VEC4",
         triangle().accessor<uint8_t>(5121, "VEC4", 3, {255, 51, 0, 255, 255, 51, 0, 255, 255, 51, 0, 255},
                                      normalized)},
        {5123, "VEC4",
         triangle().accessor<uint16_t>(
             5123, "VEC4", 3, {65535, 13107, 0, 65535, 65535, 13107, 0, 65535, 65535, 13107, 0, 65535},
             normalized)}};
    for (const Case& c : cases) {
        const Mesh mesh = load_gltf(c.builder.file(R"({"attributes":{"POSITION":0,"COLOR_0":1}})")).mesh;
        ASSERT_EQ(mesh.colors_linear.size(), 3u) << c.component << c.type;
        EXPECT_NEAR(mesh.colors_linear[1].y, 0.2, 1e-6) << c.component << c.type;
        EXPECT_EQ(mesh.colors_linear[1].w, 1) << c.component << c.type;
    }
    const Mesh two =
        load_gltf(cases[0].builder.file(
                      R"({"attributes":{"POSITION":0}},{"attributes":{"POSITION":0,"COLOR_0":1}})"))
            .mesh;
    EXPECT_EQ(two.colors_linear[0], (Vec4{1, 1, 1, 1})) << "a primitive without colours is white";
    EXPECT_TRUE(load_gltf(triangle().file(R"({"attributes":{"POSITION":0}})")).mesh.colors_linear.empty());
}

TEST(GltfColors, out_of_range_are_0_and_named_once) {
    const LoadedMesh loaded =
        load_gltf(triangle()
                      .accessor<float>(5126, "VEC3", 3, {1, -0.5f, 0, NAN, 0.2f, 0, 4, 0.2f, 0})
                      .file(R"({"attributes":{"POSITION":0,"COLOR_0":1}})"));
    EXPECT_EQ(loaded.mesh.colors_linear[0].y, 0);
    EXPECT_EQ(loaded.mesh.colors_linear[1].x, 0);
    EXPECT_TRUE(any_contains(loaded.warnings, "COLOR_0: 2 numbers are below 0 or not finite; they are 0"));
}

TEST(GltfIndices, the_largest_index_starts_a_new_primitive) {
    const GltfBuilder builder =
        GltfBuilder()
            .accessor<float>(5126, "VEC3", 6, {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0})
            .accessor<uint16_t>(5123, "SCALAR", 7, {0, 1, 2, 65535, 3, 4, 5})
            .accessor<uint8_t>(5121, "SCALAR", 7, {0, 1, 2, 255, 3, 4, 5});
    for (const char* mode : {"4", "5", "6"})
        for (const char* indices : {"1", "2"}) {
            const LoadedMesh loaded =
                load_gltf(builder.file(std::string(R"({"attributes":{"POSITION":0},"indices":)") + indices +
                                       R"(,"mode":)" + mode + "}"));
            EXPECT_EQ(loaded.mesh.triangle_count(), 2u) << mode;
            EXPECT_TRUE(any_contains(loaded.warnings, "the largest index")) << mode;
        }
}

TEST(GltfTangents, those_that_are_given_stay_and_the_others_are_computed) {
    // The given ones are turned by 45 degrees, so that they differ from computed ones.
    const std::string text =
        triangle()
            .accessor<float>(5126, "VEC2", 3, {0, 1, 1, 1, 0, 0})
            .accessor<float>(5126, "VEC4", 3, {0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1})
            .accessor<float>(5126, "VEC3", 3, {9, 0, 0, 10, 0, 0, 9, 1, 0})
            .accessor<float>(5126, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1})
            .file(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TANGENT":2,"NORMAL":4}},)"
                  R"({"attributes":{"POSITION":3,"TEXCOORD_0":1,"NORMAL":4}})");
    const Mesh mesh = load_gltf(text).mesh;
    ASSERT_EQ(mesh.positions_mm.size(), 6u);
    EXPECT_NEAR(mesh.tangents[0].y, 0.8, 1e-6);
    EXPECT_EQ(mesh.tangents[0].w, -1);
    EXPECT_NEAR(mesh.tangents[3].x, 1, 1e-6);
    EXPECT_EQ(mesh.tangents[3].w, 1);
}

TEST(GltfExtensions, that_are_not_read_are_refused_when_required_and_named_once_when_used) {
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing",
          "KHR_materials_unlit", "KHR_materials_clearcoat", "KHR_materials_sheen",
          "KHR_materials_transmission", "KHR_materials_anisotropy", "KHR_materials_iridescence",
          "KHR_materials_variants", "KHR_lights_punctual", "KHR_texture_basisu", "X_any"}) {
        const std::string list = std::string("[\"") + name + "\",\"" + name + "\"]";
        EXPECT_NE(features_error_of(square_gltf("", R"(,"extensionsRequired":)" + list))
                      .find("needs " + std::string(name) + ", which is not supported"),
                  std::string::npos)
            << name;
        const std::vector<std::string> warnings =
            load_gltf(square_gltf("", R"(,"extensionsUsed":)" + list)).warnings;
        EXPECT_EQ(
            std::ranges::count_if(warnings, [&](const std::string& w) { return w.find(name) != w.npos; }), 1)
            << name;
    }
    for (const char* name :
         {"KHR_materials_volume", "KHR_materials_diffuse_transmission", "KHR_materials_volume_scatter",
          "KHR_materials_specular", "KHR_materials_ior", "KHR_mesh_quantization", "KHR_texture_transform",
          "KHR_materials_emissive_strength"}) {
        const std::string list = std::string("[\"") + name + "\"]";
        EXPECT_FALSE(any_contains(
            load_gltf(square_gltf("", R"(,"extensionsRequired":)" + list + R"(,"extensionsUsed":)" + list))
                .warnings,
            name));
    }
}

TEST(GltfVersion, a_file_that_needs_a_later_one_is_refused) {
    const auto with_asset = [](const std::string& asset) {
        std::string text = square_gltf();
        const std::string from = R"({"version":"2.0"})";
        return text.replace(text.find(from), from.size(), asset);
    };
    EXPECT_EQ(features_error_of(with_asset(R"({"version":"2.1"})")), "");
    EXPECT_EQ(features_error_of(with_asset(R"({"version":"2.1","minVersion":"2.0"})")), "");
    EXPECT_NE(features_error_of(with_asset(R"({"version":"2.1","minVersion":"2.1"})")).find("needs glTF 2.1"),
              std::string::npos);
    EXPECT_NE(features_error_of(with_asset(R"({"version":"3.0"})")).find("only glTF 2.x"), std::string::npos);
}

TEST(GltfDataUri, may_be_percent_encoded) {
    std::string escaped;
    for (const char c : kSquareBinary) {
        static const std::string kDigits = "0123456789abcdef";
        escaped += '%';
        escaped += kDigits[uint8_t(c) >> 4];
        escaped += kDigits[uint8_t(c) & 15];
    }
    EXPECT_EQ(
        load_gltf(square_gltf("", "", "", "data:application/octet-stream," + escaped)).mesh.triangle_count(),
        2u);
    EXPECT_NE(features_error_of(square_gltf("", "", "", "data:no comma")).find("malformed data URI"),
              std::string::npos);
}

TEST(GltfLimits, of_nodes_and_vertices_are_checked_before_any_is_read) {
    std::string nodes = R"({"mesh":0})";
    for (int i = 1; i < 101; ++i) nodes += R"(,{"mesh":0})";
    // The buffer has not a byte of what the accessors state: reading would fail by another message.
    std::string text = triangle().file(R"({"attributes":{"POSITION":0}})", nodes);
    const std::string from = R"("byteOffset":0)";
    text.replace(text.find(from), from.size(), R"("byteOffset":99999)");
    EXPECT_NE(features_error_of(text, {.max_vertices = 302}).find("more vertices than dermis loads (302)"),
              std::string::npos);
    EXPECT_NE(features_error_of(text, {.max_nodes = 100})
                  .find("nodes: are 101, more than the 100 that dermis loads"),
              std::string::npos);
    EXPECT_NE(features_error_of(text).find("passes the end of its buffer"), std::string::npos);
}
