#include "dermis/scene/object_checks.h"

#include <gtest/gtest.h>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/image_source.h"
#include "dermis/scene/place_mesh.h"

using namespace dermis;

namespace {

// Detail on one side, as a face has it: a fine plane before a coarse one.
SceneObject face_turned_by(Vec3 rotation_deg) {
    SceneObject object{.name = "head", .mesh = make_plane(100, 100, 40), .classes = {MaterialClass::skin}};
    place_mesh(object.mesh, {.rotation_rad = rotation_deg * 0.017453293f});
    return object;
}

bool warns(const SceneObject& object, const std::string& text) {
    for (const std::string& warning : object_warnings(object))
        if (warning.find(text) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST(ObjectChecks, a_head_that_faces_away_is_told_how_to_turn) {
    EXPECT_TRUE(object_warnings(face_turned_by({})).empty());
    struct Case {
        Vec3 turned_deg;
        const char *side, *mend;
    };
    const Case cases[] = {{{0, 180, 0}, "on its -Z side", "rotate_deg = [0, 180, 0]"},
                          {{0, 90, 0}, "on its +X side", "rotate_deg = [0, -90, 0]"},
                          {{0, -90, 0}, "on its -X side", "rotate_deg = [0, 90, 0]"},
                          {{90, 0, 0}, "on its -Y side", "rotate_deg = [-90, 0, 0]"},
                          {{-90, 0, 0}, "on its +Y side", "rotate_deg = [90, 0, 0]"}};
    for (const Case& c : cases) {
        EXPECT_TRUE(warns(face_turned_by(c.turned_deg), c.side)) << c.side;
        EXPECT_TRUE(warns(face_turned_by(c.turned_deg), c.mend)) << c.side;
    }
    SceneObject plane{.name = "plane", .mesh = make_plane(100, 100), .classes = {MaterialClass::skin}};
    place_mesh(plane.mesh, {.rotation_rad = {0, 3.14159f, 0}});
    EXPECT_TRUE(object_warnings(plane).empty()) << "two triangles are no head";
}

TEST(ObjectChecks, double_sided_sheets_of_skin_are_told_their_class) {
    const auto told = [](Mesh mesh, bool double_sided, MaterialClass material_class) {
        mesh.materials[0].double_sided = double_sided;
        return warns({.name = "sheet", .mesh = std::move(mesh), .classes = {material_class}},
                     "'sheet' has double-sided sheets that are skin");
    };
    EXPECT_TRUE(told(make_plane(100, 100, 4), true, MaterialClass::skin));
    EXPECT_FALSE(told(make_plane(100, 100, 4), false, MaterialClass::skin));
    EXPECT_FALSE(told(make_plane(100, 100, 4), true, MaterialClass::other));
    EXPECT_FALSE(told(make_sphere(100), true, MaterialClass::skin)) << "exporters mark whole heads";
    EXPECT_FALSE(told(make_box({10, 20, 30}), true, MaterialClass::skin));
}

TEST(ObjectChecks, a_missing_map_names_the_file_that_names_it) {
    const ImageSource source{.name = "no/such.png", .encoded = {}, .named_by = "no/head.mtl"};
    const auto image = load_image_source(source, ImageUse::color);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("no/such.png"), std::string::npos);
    EXPECT_NE(image.error().message.find("(named by no/head.mtl)"), std::string::npos);
}
