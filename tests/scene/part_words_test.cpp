// Names of MetaHuman, Character Creator, MakeHuman, DAZ, VRoid and ICT FaceKit heads.

#include "dermis/scene/part_words.h"

#include <gtest/gtest.h>

using namespace dermis;

TEST(PartWords, names_of_common_heads_have_their_parts) {
    struct Case {
        HeadPart part;
        std::vector<const char*> names;
    };
    const Case cases[] = {
        {HeadPart::skin,
         {"M_Face", "M_BackHead", "MI_HeadSynthesized_Baked", "MI_BodySynthesized", "Std_Skin_Head",
          "Std_Skin_Body", "Face", "Lips", "Ears", "EyeSocket", "Torso", "Face_00_SKIN",
          "N00_000_00_Body_00_SKIN", "body", "headSkin", "Fingernails", "upper_eyelid", "Std_Nails"}},
        {HeadPart::eye,
         {"M_ScleraLeft", "M_IrisRight", "Std_Eye_L", "eyeLeft", "eyeRight", "Irises", "Pupils", "Sclera",
          "N00_000_00_EyeIris_00_EYE", "N00_000_00_EyeWhite_00_EYE", "MI_EyeRefractive_Inst_L",
          "high-poly_eyes", "eyeball", "EYES", "lefteye"}},
        {HeadPart::clear,
         {"M_LacrimalFluid", "M_EyeBlend", "M_EyeOcclusion", "eyeshell", "eyeEdge", "saliva",
          "MI_lacrimal_fluid", "MI_eyeOcclusion", "Std_Cornea_L", "Cornea", "EyeMoisture", "Std_Tearline_R",
          "EyeReflection"}},
        {HeadPart::teeth, {"M_Teeth", "Std_Upper_Teeth", "teeth", "MI_Teeth_Baked", "upperteeth"}},
        {HeadPart::mouth,
         {"M_GumsTongue", "Std_Tongue", "tongue01", "N00_000_00_FaceMouth_00_FACE", "InnerMouth"}},
        {HeadPart::hair,
         {"M_EyeLashes", "Std_Eyelash", "eyelashes", "eyebrow001", "N00_000_00_FaceBrow_00_FACE",
          "N00_000_00_FaceEyelash_00_FACE", "HairBack_00_HAIR", "MI_HairCards", "beard", "Scalp_Hair"}},
        {HeadPart::cloth, {"N00_002_03_Tops_01_CLOTH", "T-Shirt", "shirt", "male_casualsuit04_jeans"}},
        {HeadPart::other, {"glasses", "Earrings", "metal_button"}}};
    for (const Case& c : cases)
        for (const char* name : c.names) {
            const auto found = part_of_name(name);
            ASSERT_TRUE(found) << name;
            EXPECT_EQ(part_name(found->part), part_name(c.part)) << name << ": " << found->word;
        }
}

TEST(PartWords, other_names_say_nothing) {
    for (const char* name :
         {"", "Material.001", "lambert1", "chair", "surface", "03 - Default", "Earth", "blinn_edge", "shell",
          "armor", "headless", "\xff\xfe", "____", "default", "Mouthpiece_thing_x"})
        EXPECT_FALSE(part_of_name(name)) << name << ": " << part_of_name(name)->word;
    EXPECT_FALSE(part_of_name(std::string(100'000, 'e')));
}

TEST(PartWords, a_name_of_several_parts_is_known) {
    EXPECT_TRUE(names_several_parts("head_with_eyes"));
    EXPECT_TRUE(names_several_parts("TeethAndTongue"));
    EXPECT_FALSE(names_several_parts("EyeLashes"));
    EXPECT_FALSE(names_several_parts("eyeshell"));
    EXPECT_FALSE(names_several_parts("Head_Body"));
    EXPECT_FALSE(names_several_parts("x"));
}
