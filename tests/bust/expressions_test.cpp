// Expressions of the bust: where they move the skin, and that they fold no triangle over.

#include <gtest/gtest.h>

#include "bust/standard_bust.h"
#include "dermis/scene/load_scene.h"
#include "subjects/bust/expressions.h"
#include "subjects/bust/field.h"

namespace dermis {
[[nodiscard]] Subject make_bust_subject();
}  // namespace dermis

namespace dermis::bust {
namespace {

ExpressionWeights only(size_t expression) {
    ExpressionWeights weights = {};
    weights[expression] = 1;
    return weights;
}

struct Moved {
    std::vector<Point> at;  // in the standard head
    std::vector<double> by_mm;
    std::vector<Vec3> positions_mm;
};

Moved moved_by(const ExpressionWeights& weights) {
    const Mesh& mesh = standard_bust().mesh;
    const BustField field((BustParams()));
    Moved moved;
    for (size_t v = 0; v < mesh.positions_mm.size(); ++v) {
        const Vec3 p = mesh.positions_mm[v], n = mesh.normals[v];
        const Point at = field.to_standard({p.x, p.y, p.z});
        const Point move = expression_move(at, {n.x, n.y, n.z}, weights);
        moved.at.push_back(at);
        moved.by_mm.push_back(length(move));
        moved.positions_mm.push_back(p + Vec3{float(move.x), float(move.y), float(move.z)});
    }
    return moved;
}

Vec3 area_vector(const std::vector<Vec3>& positions, const Mesh& mesh, size_t first) {
    const auto p = [&](size_t k) { return positions[mesh.indices[first + k]]; };
    return cross(p(1) - p(0), p(2) - p(0));
}

}  // namespace

TEST(BustExpressions, move_their_part_of_the_face_and_nothing_else) {
    const Point low[] = {{-75, -80, 20}, {-90, -160, -15}, {-65, 20, 25}, {-5, -20, 50}, {-75, -20, 50}};
    const Point high[] = {{75, 25, 140}, {90, 0, 140}, {65, 100, 140}, {75, 60, 140}, {5, 60, 140}};
    const double least_mm[] = {4, 10, 5, 3, 3}, most_mm[] = {9, 28, 8, 6, 6};
    for (size_t e = 0; e < std::size(kExpressions); ++e) {
        const Moved moved = moved_by(only(e));
        double largest_mm = 0;
        for (size_t v = 0; v < moved.at.size(); ++v) {
            largest_mm = std::max(largest_mm, moved.by_mm[v]);
            const Point p = moved.at[v];
            const bool inside = p.x > low[e].x && p.y > low[e].y && p.z > low[e].z && p.x < high[e].x &&
                                p.y < high[e].y && p.z < high[e].z;
            if (!inside)
                ASSERT_LT(moved.by_mm[v], 0.05)
                    << kExpressions[e] << " at " << p.x << " " << p.y << " " << p.z;
        }
        EXPECT_GT(largest_mm, least_mm[e]) << kExpressions[e];
        EXPECT_LT(largest_mm, most_mm[e]) << kExpressions[e];
    }
}

TEST(BustExpressions, fold_no_triangle_over_but_for_the_walls_of_the_open_mouth) {
    const Mesh& mesh = standard_bust().mesh;
    for (size_t e = 0; e < std::size(kExpressions); ++e) {
        const Moved moved = moved_by(only(e));
        size_t turned = 0;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const Point p = moved.at[mesh.indices[i]];
            const bool between_lips =
                std::abs(p.x) < 27 && p.z > 80 && std::abs(p.y - lip_shape(p.x).line_y) < 3;
            if (kExpressions[e] == "jawOpen" && between_lips) continue;
            const Vec3 before = area_vector(mesh.positions_mm, mesh, i),
                       after = area_vector(moved.positions_mm, mesh, i);
            turned += dot(normalize(before), normalize(after)) < 0.2f;
        }
        EXPECT_EQ(turned, 0u) << kExpressions[e];
    }
}

TEST(BustExpressions, the_clip_begins_and_ends_at_rest) {
    const Motion motion = bust_motion();
    ASSERT_EQ(motion.clips.size(), 1u);
    for (const double time_s : {0.0, motion.clips[0].length_s, 9.0})
        EXPECT_EQ(expression_weights({.clip = "greet", .time_s = time_s}), ExpressionWeights{}) << time_s;
    const Pose smiling = {.clip = "greet", .time_s = 1.5 + 2 * motion.clips[0].length_s, .loop = true};
    EXPECT_EQ(expression_weights(smiling)[0], 1);
    EXPECT_EQ(expression_weights({.clip = "greet", .time_s = 1.5, .morph = {{"#1", 0.25f}}})[0], 0.25);
}

TEST(BustExpressions, a_scene_takes_them_as_words_and_names_what_the_head_has) {
    const Subject subject = make_bust_subject();
    const auto load = [&](const std::vector<SceneWord>& words) {
        return load_scene("builtin:bust", {.subjects = {&subject, 1}, .words = words});
    };
    const Result<Scene> rest = load({}), smiling = load({{"morph.smile", "1"}}),
                        wrong = load({{"morph.wink", "1"}});
    ASSERT_TRUE(rest) << rest.error().message;
    ASSERT_TRUE(smiling) << smiling.error().message;
    EXPECT_EQ(rest->objects[0].mesh.positions_mm, standard_bust().mesh.positions_mm);
    EXPECT_EQ(rest->objects[0].mesh.normals, standard_bust().mesh.normals);
    EXPECT_EQ(rest->objects[0].mesh.indices, smiling->objects[0].mesh.indices);
    EXPECT_NE(rest->objects[0].mesh.positions_mm, smiling->objects[0].mesh.positions_mm);
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("'wink'"), std::string::npos) << wrong.error().message;
    EXPECT_NE(wrong.error().message.find("squintL"), std::string::npos) << wrong.error().message;
}

}  // namespace dermis::bust
