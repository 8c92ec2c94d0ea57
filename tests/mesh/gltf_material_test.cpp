#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

LoadedMesh load_with(const std::string& material, const std::string& node = "") {
    const std::string images =
        R"(,"textures":[{"source":0},{"source":1},{}],"images":[{"uri":"skin%20colour.png"},{"name":"inner","uri":")" +
        data_uri("PNG!") + R"("}],"materials":[)" + material + "]";
    auto loaded = parse_gltf_text(square_gltf(node, images, R"(,"material":0)"));
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? std::move(*loaded) : LoadedMesh{.mesh = {.materials = {{}}}};
}

Material material_of(const std::string& material, const std::string& node = "") {
    return load_with(material, node).mesh.materials[0];
}

}  // namespace

TEST(GltfMaterial, metallic_roughness_and_maps_are_read) {
    const Material m = material_of(
        R"({"name":"skin","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,0.5],"roughnessFactor":0.4,)"
        R"("metallicFactor":0.1,"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1}},)"
        R"("normalTexture":{"index":0,"scale":0.7},"alphaMode":"BLEND","doubleSided":true,"emissiveFactor":[0,0,0.5]})");
    EXPECT_EQ(m.name, "skin");
    EXPECT_EQ(m.base_color_linear, (Vec3{0.5f, 0.25f, 0.125f}));
    EXPECT_FLOAT_EQ(m.opacity, 0.5f);
    EXPECT_FLOAT_EQ(m.roughness, 0.4f);
    EXPECT_FLOAT_EQ(m.metallic, 0.1f);
    EXPECT_EQ(m.base_color_map.name, "dir/skin colour.png");
    EXPECT_TRUE(m.base_color_map.encoded.empty());
    EXPECT_EQ(m.metallic_roughness_map.encoded.size(), 4u) << "embedded bytes stay encoded";
    EXPECT_FLOAT_EQ(m.normal_scale, 0.7f);
    EXPECT_EQ(m.alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.emission_linear, (Vec3{0, 0, 0.5f}));
    EXPECT_FALSE(m.scattering);
}

TEST(GltfMaterial, absent_values_are_those_of_the_specification) {
    const Material m = material_of("{}");
    EXPECT_EQ(m.base_color_linear, (Vec3{1, 1, 1}));
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.specular, 1);
}

TEST(GltfMaterial, opacity_counts_as_the_alpha_mode_says) {
    struct Case {
        std::string mode;
        AlphaMode read;
        float opacity, cutoff;
    };
    const Case cases[] = {{"", AlphaMode::opaque, 1, 0.5f},
                          {R"("alphaMode":"OPAQUE",)", AlphaMode::opaque, 1, 0.5f},
                          {R"("alphaMode":"MASK",)", AlphaMode::mask, 0.25f, 0.5f},
                          {R"("alphaMode":"MASK","alphaCutoff":0.1,)", AlphaMode::mask, 0.25f, 0.1f},
                          {R"("alphaMode":"BLEND",)", AlphaMode::blend, 0.25f, 0.5f}};
    for (const Case& c : cases) {
        const Material m =
            material_of("{" + c.mode + R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}})");
        EXPECT_EQ(m.alpha_mode, c.read) << c.mode;
        EXPECT_EQ(m.opacity, c.opacity) << c.mode;
        EXPECT_EQ(m.alpha_cutoff, c.cutoff) << c.mode;
    }
    EXPECT_TRUE(
        any_contains(load_with(R"({"alphaMode":"HASH"})").warnings, "'HASH' is not OPAQUE, MASK or BLEND"));
}

TEST(GltfMaterial, emissive_maps_are_read) {
    const Material m =
        material_of(R"({"emissiveFactor":[1,0.5,0],"emissiveTexture":{"index":0},)"
                    R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}})");
    EXPECT_EQ(m.emission_map.name, "dir/skin colour.png");
    EXPECT_EQ(m.emission_linear, (Vec3{4, 2, 0}));
}

TEST(GltfMaterial, samplers_say_how_a_map_goes_on) {
    const auto map = [](const std::string& sampler) {
        const auto loaded = parse_gltf_text(
            square_gltf("",
                        R"(,"samplers":[)" + sampler +
                            R"(],"textures":[{"source":0,"sampler":0}],"images":[{"uri":"a.png"}],)"
                            R"("materials":[{"emissiveTexture":{"index":0}}])",
                        R"(,"material":0)"));
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? loaded->mesh.materials[0].emission_map : ImageSource{};
    };
    EXPECT_EQ(map("{}").wrap_u, TextureWrap::repeat);
    EXPECT_EQ(map(R"({"wrapS":33071,"wrapT":33648})").wrap_u, TextureWrap::clamp);
    EXPECT_EQ(map(R"({"wrapS":33071,"wrapT":33648})").wrap_v, TextureWrap::mirror);
    EXPECT_EQ(map(R"({"wrapS":10497,"wrapT":10497})").wrap_v, TextureWrap::repeat);
    EXPECT_EQ(map(R"({"wrapS":1})").wrap_u, TextureWrap::repeat) << "with a warning";
}

TEST(GltfMaterial, translucent_bodies_are_read_in_millimetres) {
    const Material m = material_of(
        R"({"extensions":{"KHR_materials_volume":{"thicknessFactor":0.01,"thicknessTexture":{"index":0},)"
        R"("attenuationDistance":0.002,"attenuationColor":[0.5,0.25,0.125]},)"
        R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.3,"diffuseTransmissionTexture":{"index":1}},)"
        R"("KHR_materials_volume_scatter":{"multiscatterColorFactor":[0.8,0.5,0.3],"scatterAnisotropy":0.6},)"
        R"("KHR_materials_specular":{"specularFactor":0.5,"specularTexture":{"index":1}},"KHR_materials_ior":{"ior":1.4}}})",
        R"(,"scale":[2,2,2])");
    ASSERT_TRUE(m.scattering);
    EXPECT_NEAR(m.scattering->thickness_mm, 20, 1e-4)
        << "thickness is in the mesh's space, scaled by its node";
    EXPECT_NEAR(m.scattering->attenuation_distance_mm, 2, 1e-5) << "the distance is in the world's";
    EXPECT_EQ(m.scattering->attenuation_color, (Vec3{0.5f, 0.25f, 0.125f}));
    EXPECT_EQ(m.scattering->multiscatter_color, (Vec3{0.8f, 0.5f, 0.3f}));
    EXPECT_FLOAT_EQ(m.scattering->anisotropy, 0.6f);
    EXPECT_FLOAT_EQ(m.scattering->diffuse_transmission, 0.3f);
    EXPECT_EQ(m.scattering->scatter_strength, 1);
    EXPECT_EQ(m.thickness_map.name, "dir/skin colour.png");
    EXPECT_TRUE(m.transmission_map.present());
    EXPECT_TRUE(m.specular_map.present());
    EXPECT_FLOAT_EQ(m.specular, 0.5f);
    EXPECT_FLOAT_EQ(m.ior, 1.4f);
}

TEST(GltfMaterial, the_older_key_and_the_newer_extension_are_read) {
    const auto scatter = [](const std::string& text) {
        const Material m = material_of(R"({"extensions":{)" + text + "}}");
        return m.scattering.value_or(Material::Scattering{});
    };
    EXPECT_EQ(
        scatter(R"("KHR_materials_volume_scatter":{"multiscatterColor":[0.1,0.2,0.3]})").multiscatter_color,
        (Vec3{0.1f, 0.2f, 0.3f}));
    const auto newer =
        scatter(R"("KHR_materials_scatter":{"scatterStrengthFactor":0.25,"scatterAnisotropy":-0.5})");
    EXPECT_EQ(newer.scatter_strength, 0.25f);
    EXPECT_EQ(newer.anisotropy, -0.5f);
    EXPECT_EQ(newer.multiscatter_color, (Vec3{1, 1, 1})) << "its default is white";
    EXPECT_EQ(scatter(R"("KHR_materials_scatter":{})").scatter_strength, 0);
}

// Texture 2 has no source.
TEST(GltfMaterial, a_map_that_is_left_out_takes_its_factor_with_it) {
    const Material none;  // what a surface is where the file says nothing that can be used
    const std::string other_set = R"({"index":1,"texCoord":1})",
                      other_transform =
                          R"({"index":1,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}})",
                      no_source = R"({"index":2})";
    for (const std::string& info : {other_set, other_transform, no_source}) {
        const LoadedMesh loaded = load_with(
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":1,"roughnessFactor":0.1,)"
            R"("metallicRoughnessTexture":)" +
            info + R"(},"emissiveFactor":[1,1,1],"emissiveTexture":)" + info +
            R"(,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},)"
            R"("KHR_materials_specular":{"specularFactor":0.2,"specularTexture":)" +
            info + R"(},"KHR_materials_volume":{"thicknessFactor":0.01,"thicknessTexture":)" + info +
            R"(},"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.3,"diffuseTransmissionTexture":)" +
            info + "}}}");
        const Material& m = loaded.mesh.materials[0];
        EXPECT_EQ(m.emission_linear, none.emission_linear) << info;
        EXPECT_EQ(m.metallic, none.metallic) << info;
        EXPECT_EQ(m.roughness, none.roughness) << info;
        EXPECT_EQ(m.specular, none.specular) << info;
        ASSERT_TRUE(m.scattering);
        EXPECT_EQ(m.scattering->thickness_mm, 0) << info;
        EXPECT_EQ(m.scattering->diffuse_transmission, 0) << info;
        for (const ImageSource* map : {&m.emission_map, &m.metallic_roughness_map, &m.specular_map,
                                       &m.thickness_map, &m.transmission_map})
            EXPECT_FALSE(map->present()) << info;
        EXPECT_TRUE(m.base_color_map.present());
        EXPECT_EQ(std::ranges::count_if(loaded.warnings,
                                        [](const std::string& line) {
                                            return line.find("emissiveTexture: ") != std::string::npos &&
                                                   line.ends_with("not used, nor is emissiveFactor");
                                        }),
                  1)
            << info;
        EXPECT_TRUE(any_contains(loaded.warnings, "not used, nor are metallicFactor and roughnessFactor"));
    }
}

TEST(GltfMaterial, factors_stay_beside_maps_that_are_read_and_where_there_is_none) {
    for (const std::string map : {"", R"(,"emissiveTexture":{"index":1})"})
        EXPECT_EQ(material_of(R"({"emissiveFactor":[1,0.5,0])" + map + "}").emission_linear,
                  (Vec3{1, 0.5f, 0}));
}

TEST(GltfMaterial, a_base_colour_without_its_map_is_that_of_an_unknown_surface) {
    const LoadedMesh loaded = load_with(
        R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,0,1,0.5],"baseColorTexture":{"index":2}}})");
    EXPECT_EQ(loaded.mesh.materials[0].base_color_linear, Material().base_color_linear);
    EXPECT_EQ(loaded.mesh.materials[0].opacity, 1);
    EXPECT_TRUE(any_contains(loaded.warnings, "not used, nor is baseColorFactor"));
}

TEST(GltfMaterial, coloured_maps_that_no_renderer_here_reads_are_left_out_with_their_factors) {
    const LoadedMesh loaded = load_with(
        R"({"extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionColorFactor":[1,0,0],)"
        R"("diffuseTransmissionColorTexture":{"index":0}},)"
        R"("KHR_materials_specular":{"specularColorFactor":[1,0,0],"specularColorTexture":{"index":0}}}})");
    ASSERT_TRUE(loaded.mesh.materials[0].scattering);
    EXPECT_EQ(loaded.mesh.materials[0].scattering->diffuse_transmission_color, (Vec3{1, 1, 1}));
    EXPECT_TRUE(any_contains(loaded.warnings,
                             "diffuseTransmissionColorTexture: is not read; not used, nor is "
                             "diffuseTransmissionColorFactor"));
    EXPECT_TRUE(any_contains(loaded.warnings, "specularColorTexture: is not read"));
}

TEST(GltfMaterial, factors_that_no_renderer_here_reads_are_named) {
    const LoadedMesh loaded =
        load_with(R"({"occlusionTexture":{"index":0,"strength":0.4},)"
                  R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[1,0.5,0.2]}}})");
    EXPECT_TRUE(any_contains(loaded.warnings, "specularColorFactor: is not read; reflections are white"));
    EXPECT_TRUE(any_contains(loaded.warnings, "strength: is not read; the map has its full strength"));
    EXPECT_FALSE(any_contains(
        load_with(R"({"extensions":{"KHR_materials_specular":{"specularColorFactor":[1,1,1]}}})").warnings,
        "specularColorFactor"));
}

TEST(GltfMaterial, an_empty_embedded_picture_is_named_once_with_its_factor) {
    const auto loaded = parse_gltf_text(
        square_gltf("",
                    R"(,"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,"}],)"
                    R"("materials":[{"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}}])",
                    R"(,"material":0)"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.materials[0].emission_linear, (Vec3{0, 0, 0}));
    EXPECT_EQ(
        std::ranges::count_if(loaded->warnings,
                              [](const std::string& line) { return line.find("is empty") != line.npos; }),
        1);
}

TEST(GltfMaterial, colours_out_of_range_are_clamped_and_named_once) {
    const LoadedMesh loaded = load_with(
        R"({"pbrMetallicRoughness":{"baseColorFactor":[-1,2,0.5,3]},"alphaMode":"BLEND","emissiveFactor":[-5,0,9],)"
        R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e30},)"
        R"("KHR_materials_volume":{"attenuationColor":[2,2,-1],"thicknessFactor":-1,"attenuationDistance":-2},)"
        R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionColorFactor":[7,0,0]},)"
        R"("KHR_materials_volume_scatter":{"multiscatterColorFactor":[0,-7,0]},"KHR_materials_ior":{"ior":0.5}}})");
    const Material& m = loaded.mesh.materials[0];
    EXPECT_EQ(m.base_color_linear, (Vec3{0, 1, 0.5f}));
    EXPECT_EQ(m.opacity, 1);
    EXPECT_EQ(m.emission_linear, (Vec3{0, 0, kMostEmission}));
    ASSERT_TRUE(m.scattering);
    EXPECT_EQ(m.scattering->attenuation_color, (Vec3{1, 1, 0}));
    EXPECT_EQ(m.scattering->thickness_mm, 0);
    EXPECT_EQ(m.scattering->attenuation_distance_mm, 0);
    EXPECT_EQ(m.scattering->diffuse_transmission_color, (Vec3{1, 0, 0}));
    EXPECT_EQ(m.scattering->multiscatter_color, (Vec3{0, 0, 0}));
    for (const char* key :
         {"baseColorFactor", "emissiveFactor", "emissiveStrength", "attenuationColor", "thicknessFactor",
          "attenuationDistance", "diffuseTransmissionColorFactor", "multiscatterColorFactor"})
        EXPECT_EQ(std::ranges::count_if(loaded.warnings,
                                        [&](const std::string& line) {
                                            return line.find(std::string(key) +
                                                             ": is outside of its range, ") != line.npos &&
                                                   line.ends_with("; clamped");
                                        }),
                  1)
            << key;
    EXPECT_TRUE(any_contains(loaded.warnings, "KHR_materials_ior.ior: is below 1; not used"));
}

// The first map that can be read decides on the UV set.
TEST(GltfMaterial, a_map_without_a_picture_does_not_choose_the_uv_set) {
    const Material m =
        material_of(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":2}},"emissiveFactor":[1,1,1],)"
                    R"("emissiveTexture":{"index":0,"texCoord":1}})");
    EXPECT_TRUE(m.emission_map.present());
    EXPECT_EQ(m.emission_linear, (Vec3{1, 1, 1}));
}

TEST(GltfMaterial, what_is_odd_is_warned_of_and_what_is_wrong_is_refused) {
    EXPECT_TRUE(any_contains(
        load_with(R"({"pbrMetallicRoughness":{"roughnessFactor":3}})").warnings,
        "materials[0].pbrMetallicRoughness.roughnessFactor: is outside of its range, 0 to 1; clamped"));
    EXPECT_TRUE(
        any_contains(load_with(R"({"normalTexture":{"index":2}})").warnings, "no PNG or JPEG source"));
    const std::string two_sets =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"occlusionTexture":{"index":0,"texCoord":1}})";
    EXPECT_TRUE(
        any_contains(load_with(two_sets).warnings,
                     "materials[0].occlusionTexture: is for UV set 1, the material's first map for set 0"));
    EXPECT_FALSE(material_of(two_sets).occlusion_map.present());
    const std::string two_scales =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":0,)"
        R"("extensions":{"KHR_texture_transform":{"scale":[8,8]}}}})";
    EXPECT_TRUE(
        any_contains(load_with(two_scales).warnings, "normalTexture: has another KHR_texture_transform"));
    EXPECT_FALSE(material_of(two_scales).normal_map.present());
    const auto wrong = [](const std::string& material) {
        const auto loaded = parse_gltf_text(square_gltf(
            "",
            R"(,"textures":[{"source":0}],"images":[{"uri":"../x.png"}],"materials":[)" + material + "]"));
        return loaded ? std::string() : loaded.error().message;
    };
    EXPECT_NE(wrong(R"({"normalTexture":{"index":0}})").find("leaves the file's directory"),
              std::string::npos);
    EXPECT_NE(wrong(R"({"normalTexture":{"index":9}})").find("textures: has no element 9"),
              std::string::npos);
    EXPECT_NE(wrong(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1]}})").find("array of 4 numbers"),
              std::string::npos);
}
