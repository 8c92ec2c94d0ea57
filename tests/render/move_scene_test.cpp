// A scene that moves to another time of its clip against one that is loaded there.

#include "dermis/render/move_scene.h"

#include <gmock/gmock.h>

#include "cli/run_program.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_hash.h"
#include "dermis/scene/skin_atlas.h"
#include "dermis/technique/technique_list.h"
#include "render/render_test.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

constexpr DrawSettings kMovedPicture = {.width = 48, .height = 48, .deep = true, .shadow_map_size = 256};

class MoveScene : public RenderTest {
  protected:
    static Scene loaded(const std::string& path, std::vector<SceneWord> words, double time_s) {
        words.push_back({"animation.time_s", std::to_string(time_s)});
        Result<Scene> scene =
            load_scene(path, {.subjects = built_in_catalog().subjects, .words = std::move(words)});
        EXPECT_TRUE(scene) << scene.error().message;
        if (!scene) return {};
        EXPECT_TRUE(complete_scene(*scene));
        return std::move(*scene);
    }

    static std::vector<std::byte> drawn(Renderer& renderer, const std::string& technique) {
        const auto parsed = parse_technique(built_in_catalog().techniques, technique);
        EXPECT_TRUE(parsed) << parsed.error().message;
        return radiance(renderer, *parsed->technique, parsed->values, kMovedPicture).bytes;
    }

    static void expect_same(const std::vector<SceneObject>& moved, const std::vector<SceneObject>& fresh) {
        ASSERT_EQ(moved.size(), fresh.size());
        for (size_t i = 0; i < moved.size(); ++i) {
            const Mesh &a = moved[i].mesh, &b = fresh[i].mesh;
            EXPECT_EQ(a.indices, b.indices);
            EXPECT_EQ(a.positions_mm, b.positions_mm);
            EXPECT_EQ(a.normals, b.normals);
            EXPECT_EQ(a.tangents, b.tangents);
            EXPECT_EQ(a.atlas_uvs, b.atlas_uvs);
            EXPECT_EQ(a.colors_linear, b.colors_linear);
            EXPECT_EQ(a.curvatures_per_mm, b.curvatures_per_mm);
            EXPECT_EQ(a.occlusions, b.occlusions);
            EXPECT_EQ(a.tensions, b.tensions);
            EXPECT_EQ(a.rest_positions_mm, b.rest_positions_mm);
            EXPECT_EQ(moved[i].target_weights, fresh[i].target_weights);
            EXPECT_EQ(moved[i].blood_by_target, fresh[i].blood_by_target);
        }
    }

    /// Moves one scene through the times, and loads another at each.
    static void expect_as_loaded(const std::string& path, const std::vector<SceneWord>& words,
                                 const std::vector<double>& times_s,
                                 const std::vector<std::string>& techniques) {
        Scene moving = loaded(path, words, times_s.front());
        const Scene first = without_objects(moving);
        Renderer renderer = make_renderer(moving);
        std::vector<std::vector<std::byte>> before;
        for (const std::string& technique : techniques) before.push_back(drawn(renderer, technique));
        for (size_t i = 1; i < times_s.size(); ++i) {
            SCOPED_TRACE(path + " at " + std::to_string(times_s[i]));
            const Result<void> moved = move_scene(times_s[i], moving, renderer);
            ASSERT_TRUE(moved) << moved.error().message;
            Scene fresh = loaded(path, words, times_s[i]);
            fresh.lights = first.lights, fresh.camera = first.camera;
            fit_depth_range(fresh.camera, fresh.bounds_center_mm, fresh.bounds_radius_mm);
            expect_same(moving.objects, fresh.objects);
            expect_same(moving.rest_objects, fresh.rest_objects);
            EXPECT_EQ(*hash_of(moving), *hash_of(fresh));
            Renderer other = make_renderer(fresh);
            for (size_t k = 0; k < techniques.size(); ++k) {
                const std::vector<std::byte> picture = drawn(renderer, techniques[k]);
                EXPECT_TRUE(picture == drawn(other, techniques[k])) << techniques[k];
                EXPECT_FALSE(picture == before[k]) << techniques[k] << " does not move";
                before[k] = picture;
            }
        }
    }

    std::string sheet() const {
        const auto path = directory_.path / "sheet.gltf";
        EXPECT_TRUE(write_text_file(path, test::moving_sheet()));
        return path.string();
    }

    TemporaryDirectory directory_;
};

const std::vector<std::string> kEveryKind = {"lambert", "wrap[gain=map]", "preintegrated",
                                             "screen_space_separable", "texture_space_gaussians"};

}  // namespace

TEST_F(MoveScene, a_sheet_is_as_loaded) {
    expect_as_loaded(sheet(), {{"animation.clip", "nod"}}, {0.5, 1.5, 0, 0.5}, kEveryKind);
}

TEST_F(MoveScene, a_placed_sheet_with_blood_that_moves_and_bakes_of_the_rest_pose_is_as_loaded) {
    const auto scene = directory_.path / "sheet.toml";
    ASSERT_TRUE(write_text_file(scene, "[[mesh]]\nfile = \"" + sheet() +
                                           "\"\nscale = 0.5\nrotate_deg = [20, -30, 10]\n"
                                           "translate_mm = [5, 6, 7]\n[skin]\nmelanin = 0.03\nblood = 0.03\n"
                                           "blood_by_tension = 1\n[animation]\nclip = \"nod\"\n"
                                           "rest_bakes = \"normals+occlusion\"\n"));
    expect_as_loaded(scene.string(), {}, {0.5, 1.5}, {"lambert", "preintegrated"});
}

TEST_F(MoveScene, a_subdivided_sheet_is_as_loaded) {
    const auto scene = directory_.path / "sheet.toml";
    ASSERT_TRUE(write_text_file(
        scene, "[[mesh]]\nfile = \"" + sheet() + "\"\nsubdivision = 1\n[animation]\nclip = \"nod\"\n"));
    expect_as_loaded(scene.string(), {}, {0.5, 1.5}, {"lambert"});
}

TEST_F(MoveScene, the_built_in_head_is_as_loaded) {
    expect_as_loaded("builtin:bust", {{"animation.clip", "greet"}}, {0.5, 1.5}, {"lambert", "preintegrated"});
}

TEST_F(MoveScene, ICT_s_face_is_as_loaded) {
    const std::filesystem::path file = test::asset("ict_face/ict_moving.glb");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is needed";
    expect_as_loaded(file.string(), {{"animation.clip", "talk"}}, {0.3, 1.2},
                     {"lambert", "preintegrated", "texture_space_gaussians"});
}

TEST_F(MoveScene, files_of_every_kind_of_motion_are_as_loaded) {
    if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to write the files";
    const std::string folder = directory_.path.string();
    const ProgramResult written =
        run_shell("python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py write " + folder, folder);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".glb") continue;
        expect_as_loaded(entry.path().string(), {{"animation.clip", "move"}}, {0.2, 0.9}, {"lambert"});
        ++files;
    }
    EXPECT_EQ(files, 10);
}

// The layout of a pose would be another one.
TEST_F(MoveScene, the_atlas_is_that_of_the_rest_shape) {
    const std::filesystem::path file = test::asset("ict_face/ict_moving.glb");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is needed";
    const std::vector<SceneWord> talk = {{"animation.clip", "talk"}};
    const Scene rest = loaded(file.string(), {}, 0), posed = loaded(file.string(), talk, 1.2);
    ASSERT_FALSE(rest.objects[0].mesh.atlas_uvs.empty());
    EXPECT_EQ(rest.objects[0].mesh.atlas_uvs, posed.objects[0].mesh.atlas_uvs);
    Scene unposed = posed;
    unposed.objects[0].mesh.rest_positions_mm.clear();
    lay_out_skin_atlas(unposed);
    EXPECT_NE(unposed.objects[0].mesh.atlas_uvs, posed.objects[0].mesh.atlas_uvs);
}

TEST_F(MoveScene, a_file_that_has_changed_is_named) {
    const std::string path = sheet();
    Scene scene = loaded(path, {{"animation.clip", "nod"}}, 0.5);
    Renderer renderer = make_renderer(scene);
    std::filesystem::remove(path);
    const Result<void> moved = move_scene(1, scene, renderer);
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, testing::HasSubstr("sheet.gltf"));
}

}  // namespace dermis
