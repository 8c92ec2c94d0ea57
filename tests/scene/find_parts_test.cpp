#include "dermis/scene/find_parts.h"

#include <gtest/gtest.h>

#include <map>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/part_words.h"

using namespace dermis;

namespace {

// A plane with a triangle run for each material.
Mesh mesh_of(const std::vector<Material>& materials, const std::string& mesh_name = "Mesh") {
    Mesh mesh = make_plane(100, 100, 16);
    mesh.materials = materials;
    mesh.submeshes.clear();
    for (uint32_t i = 0; i < materials.size(); ++i)
        mesh.submeshes.push_back({.name = mesh_name, .first_index = 3 * i, .index_count = 3, .material = i});
    return mesh;
}

Mesh mesh_named(const std::vector<std::string>& names, const std::string& mesh_name = "Mesh") {
    std::vector<Material> materials;
    for (const std::string& name : names) materials.push_back({.name = name});
    return mesh_of(materials, mesh_name);
}

std::vector<std::string> parts_of(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const FoundPart& found : find_parts(mesh))
        names.push_back(part_name(found.part) + (found.left_out ? " left out" : ""));
    return names;
}

using Names = std::vector<std::string>;

Material with_opacity(std::string name, float opacity) {
    return {.name = std::move(name), .opacity = opacity, .alpha_mode = AlphaMode::blend};
}

}  // namespace

TEST(FindParts, where_no_name_says_anything_all_is_skin) {
    EXPECT_EQ(parts_of(mesh_named({"Material.001", "Material.002"})), (Names{"skin", "skin"}));
    EXPECT_EQ(parts_of(mesh_named({"eye_open_scan"})), (Names{"skin"})) << "the only material";
    EXPECT_EQ(parts_of(mesh_named({"eyes", "Material"})), (Names{"eye", "skin"}));
}

TEST(FindParts, names_of_makers_of_heads_give_one_set_of_classes) {
    const Names expected = {"skin", "skin", "mouth",          "teeth",
                            "eye",  "eye",  "clear left out", "hair left out"};
    const std::map<std::string, Names> makers = {
        {"MetaHuman",
         {"head_shader_shader", "body_shader_shader", "tongue_shader_shader", "teeth_shader_shader",
          "eyeLeft_shader_shader", "eyeRight_shader_shader", "eyeEdge_shader_shader",
          "eyelashes_shader_shader"}},
        {"Character Creator",
         {"Std_Skin_Head", "Std_Skin_Body", "Std_Tongue", "Std_Upper_Teeth", "Std_Eye_L", "Std_Eye_R",
          "Std_Cornea_L", "Std_Eyelash"}},
        {"MakeHuman",
         {"young_caucasian_male", "skin.body", "tongue01", "teeth_base", "high-poly_eyes", "eyes.001",
          "eye_cornea", "eyelashes01"}},
        {"DAZ Genesis",
         {"Genesis9 Face-1", "Torso", "Mouth", "Teeth", "Sclera", "Irises", "EyeMoisture", "Eyelashes"}},
        {"VRoid",
         {"N00_000_00_Face_00_SKIN (Instance)", "N00_000_00_Body_00_SKIN (Instance)",
          "N00_000_00_FaceMouth_00_FACE (Instance)", "FaceTeeth_00_FACE", "N00_000_00_EyeWhite_00_EYE",
          "N00_000_00_EyeIris_00_EYE", "N00_000_00_EyeTear_00_EYE", "N00_000_00_FaceEyelash_00_FACE"}}};
    for (const auto& [maker, names] : makers) EXPECT_EQ(parts_of(mesh_named(names)), expected) << maker;
}

TEST(FindParts, opaque_shells_are_left_out_where_there_is_an_eye) {
    EXPECT_EQ(parts_of(mesh_named({"Face", "Cornea", "Iris"})), (Names{"skin", "clear left out", "eye"}));
    EXPECT_EQ(parts_of(mesh_named({"Face", "Cornea"})), (Names{"skin", "eye"}));
    EXPECT_EQ(parts_of(mesh_of({{.name = "Face"}, with_opacity("Cornea", 0.1f), {.name = "Iris"}})),
              (Names{"skin", "clear", "eye"}));
}

TEST(FindParts, lashes_without_alpha_or_map_are_left_out) {
    Mesh mesh = mesh_named({"Face", "EyeLashes", "Eyebrow", "Hair"});
    EXPECT_EQ(parts_of(mesh), (Names{"skin", "hair left out", "hair left out", "hair"}));
    mesh.materials[1].base_color_map.name = "lashes.png";
    mesh.materials[2].alpha_mode = AlphaMode::mask;
    EXPECT_EQ(parts_of(mesh), (Names{"skin", "hair", "hair", "hair"}));
}

TEST(FindParts, mesh_and_image_names_help_where_the_material_has_none) {
    EXPECT_EQ(parts_of(mesh_named({"m1", "m2"}, "Teeth_low")), (Names{"teeth", "teeth"}));
    EXPECT_EQ(parts_of(mesh_named({"m1", "m2"}, "head_with_eyes")), (Names{"skin", "skin"}));
    Mesh mesh = mesh_named({"m1", "m2"});
    mesh.materials[1].base_color_map.name = "textures/T_Teeth_D.png";
    EXPECT_EQ(parts_of(mesh), (Names{"skin", "teeth"}));
    mesh.materials[1].base_color_map = {.name = "head.glb:Eye_BaseColor", .encoded = {std::byte{1}}};
    EXPECT_EQ(parts_of(mesh), (Names{"skin", "eye"}));
}

TEST(FindParts, alpha_beside_whole_materials_is_hair_or_clear) {
    Material card = {.name = "m1", .alpha_mode = AlphaMode::mask};
    EXPECT_EQ(parts_of(mesh_of({{.name = "m0"}, card, with_opacity("m2", 0.2f)})),
              (Names{"skin", "hair", "clear"}));
    EXPECT_EQ(parts_of(mesh_of({card, card})), (Names{"skin", "skin"})) << "exporters mark whole heads";
}

TEST(FindParts, eyes_and_teeth_without_a_colour_get_one) {
    Material iris = {.name = "M_IrisLeft"}, stated = {.name = "M_IrisLeft", .base_color_stated = true};
    complete_material({HeadPart::eye, ""}, iris);
    complete_material({HeadPart::eye, ""}, stated);
    EXPECT_LT(iris.base_color_linear.x, 0.2f);
    EXPECT_EQ(stated.base_color_linear.x, Material{}.base_color_linear.x);
}

TEST(FindParts, two_hundred_materials_without_skin_are_said_in_one_line) {
    std::vector<std::string> names;
    for (int i = 0; i < 200; ++i) names.push_back("Hair_" + std::to_string(i));
    SceneObject object{.name = "wig", .mesh = mesh_named(names)};
    object.parts = find_parts(object.mesh);
    for (const FoundPart& found : object.parts) EXPECT_EQ(found.part, HeadPart::hair);
    const std::string note = parts_note(object);
    EXPECT_NE(note.find("and 194 more"), std::string::npos) << note;
    EXPECT_NE(note.find("no skin"), std::string::npos) << note;
    EXPECT_LT(note.size(), 400u);
}
