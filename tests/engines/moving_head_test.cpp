// The GLB of a head that moves, read back: every vertex at moments of its clips against the source, and what
// the Khronos validator says of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/scene/rig_scene.h"
#include "mesh/mesh_files.h"
#include "support/built_in.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

namespace fs = std::filesystem;

constexpr double kMostError = 1e-5;  // of the model's size
constexpr const char* kPlaced = "scale = 0.5\nrotate_deg = [20, -30, 10]\ntranslate_mm = [5, 6, 7]\n";

class MovingHead : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (directory_.path / name).string(); }
    std::string scene_of(const std::string& mesh, const std::string& more = kPlaced) {
        const std::string file = path("scene.toml");
        EXPECT_TRUE(write_text_file(file, "[[mesh]]\nfile = \"" + mesh + "\"\n" + more));
        return file;
    }
    static SceneObject loaded(const std::string& scene, const Pose& pose) {
        std::vector<SceneWord> words;
        if (!pose.clip.empty())
            words = {{"animation.clip", pose.clip}, {"animation.time_s", std::to_string(pose.time_s)}};
        for (const auto& [name, weight] : pose.morph)
            words.push_back({"morph." + name, std::to_string(weight)});
        auto found = load_scene(scene, {.subjects = built_in_catalog().subjects, .words = words});
        EXPECT_TRUE(found) << found.error().message;
        return found ? std::move(found->objects.at(0)) : SceneObject();
    }
    enum class Clips { as_they_are, without_splines };
    static std::vector<std::byte> written(const SceneObject& object, const Pose& pose,
                                          Clips clips = Clips::as_they_are) {
        auto rig = rig_of(object, pose);
        EXPECT_TRUE(rig) << rig.error().message;
        if (!rig || !*rig) return ADD_FAILURE() << "no rig", std::vector<std::byte>();
        if (clips == Clips::without_splines) make_keys_linear(**rig);
        Mesh mesh = object.mesh;
        for (Material& material : mesh.materials) material = {.name = material.name};
        const auto bytes = glb_bytes(mesh, {}, {}, {}, &**rig);
        EXPECT_TRUE(bytes) << bytes.error().message;
        return bytes ? *bytes : std::vector<std::byte>();
    }
    static Mesh read_back(const std::vector<std::byte>& glb, const Pose& pose) {
        const auto no_sibling = [](const std::string&) -> Result<std::vector<std::byte>> {
            return Error{"it names no file"};
        };
        const auto found = parse_mesh(glb, MeshFormat::glb, "written.glb", no_sibling, {.pose = pose});
        EXPECT_TRUE(found) << found.error().message;
        return found ? found->mesh : Mesh();
    }
    void expect_valid(const std::vector<std::byte>& glb) {
        const std::string checks = DERMIS_SOURCE_DIR "/tools/checks/";
        if (!has_program("node") || !fs::exists(checks + "node_modules/gltf-validator"))
            GTEST_SKIP() << "needs node, and 'npm ci' in tools/checks";
        ASSERT_TRUE(write_file(path("written.glb"), glb));
        const ProgramResult run = run_shell("node " + checks + "validate_gltf.mjs " + path("written.glb"),
                                            directory_.path.string());
        const auto errors = nlohmann::json::parse(run.out)["errors"];
        EXPECT_EQ(errors.size(), 0u) << errors.front();
    }

    TemporaryDirectory directory_;
};

struct Difference {
    double position = 0;  // of the model's size
    double normal = 0;
};

// Corner by corner of the triangles.
Difference difference(const Mesh& expected, const Mesh& found) {
    EXPECT_EQ(expected.indices.size(), found.indices.size());
    if (expected.indices.size() != found.indices.size()) return {1e9, 1e9};
    Vec3 low = expected.positions_mm.at(0), high = low;
    Difference worst;
    for (size_t i = 0; i < expected.indices.size(); ++i) {
        const uint32_t a = expected.indices[i], b = found.indices[i];
        const Vec3 p = expected.positions_mm[a];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        worst.position = std::max(worst.position, double(length(found.positions_mm[b] - p)));
        worst.normal = std::max(worst.normal, double(length(found.normals[b] - expected.normals[a])));
    }
    worst.position /= double(length(high - low));
    return worst;
}

}  // namespace

TEST_F(MovingHead, every_kind_of_motion_is_read_back_as_it_is_in_its_source) {
    if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to make the models";
    const std::string folder = directory_.path.string();
    ASSERT_EQ(
        run_shell("python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py write " + folder, folder).exit_code,
        0);
    std::vector<std::string> models;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".glb") models.push_back(entry.path().string());
    ASSERT_EQ(models.size(), 10u);
    for (const std::string& model : models) {
        const std::string scene = scene_of(model, std::string(kPlaced) + "unit_mm = 700\n");
        const std::vector<std::byte> glb = written(loaded(scene, {}), {});
        for (const double time_s : {0.0, 0.3, 0.5, 0.9, 1.7, 3.0}) {
            const Pose pose = {.clip = "move", .time_s = time_s};
            const Difference found = difference(loaded(scene, pose).mesh, read_back(glb, pose));
            EXPECT_LT(found.position, kMostError) << model << " at " << time_s;
        }
        // These models' own rotations are not of length 1.
        if (model.find("/nodes_") == std::string::npos) expect_valid(glb);
    }
}

TEST_F(MovingHead, a_scene_in_a_pose_opens_in_it_and_moves_from_there) {
    ASSERT_TRUE(write_text_file(path("sheet.gltf"), test::moving_sheet()));
    const std::string scene = scene_of("sheet.gltf");
    const Pose chosen = {.clip = "nod", .time_s = 1.5};
    const SceneObject object = loaded(scene, chosen);
    const std::vector<std::byte> glb = written(object, chosen);
    const Difference opened = difference(object.mesh, read_back(glb, {}));
    EXPECT_LT(opened.position, kMostError);
    EXPECT_LT(opened.normal, 0.03) << "linear in the target's weight, in place of the surface's turn";
    for (const double time_s : {0.0, 0.7, 2.0}) {
        const Pose pose = {.clip = "nod", .time_s = time_s};
        const Difference found = difference(loaded(scene, pose).mesh, read_back(glb, pose));
        EXPECT_LT(found.position, kMostError) << time_s;
        EXPECT_LT(found.normal, time_s == 2.0 ? 1e-4 : 0.03) << time_s;
    }
    const Pose lifted = {.morph = {{"lift", 1.0f}}};
    const Mesh by_target = read_back(written(loaded(scene, lifted), lifted), {});
    EXPECT_LT(difference(loaded(scene, lifted).mesh, by_target).position, kMostError);
    EXPECT_GT(difference(loaded(scene, {}).mesh, by_target).position, 0.01);
}

TEST_F(MovingHead, without_splines_it_moves_as_with_them) {
    const fs::path face = test::asset("ict_face/ict_moving.glb");
    if (!fs::exists(face)) GTEST_SKIP() << face << " is needed";
    const std::string scene = scene_of(face.string());
    const auto splines = written(loaded(scene, {}), {});
    const auto linear = written(loaded(scene, {}), {}, Clips::without_splines);
    const auto has_splines = [](const std::vector<std::byte>& glb) {
        const std::string_view text(reinterpret_cast<const char*>(glb.data()), glb.size());
        return text.find("CUBICSPLINE") != std::string_view::npos;
    };
    EXPECT_TRUE(has_splines(splines));
    EXPECT_FALSE(has_splines(linear));
    // Its own keys are at whole seconds and 2.2: taken alone they leave the neck .8 degrees behind.
    for (const double time_s : {0.41, 1.2, 2.0, 3.77, 4.0}) {
        const Pose pose = {.clip = "talk", .time_s = time_s};
        EXPECT_LT(difference(read_back(splines, pose), read_back(linear, pose)).position, 5e-5) << time_s;
    }
    expect_valid(linear);
}

TEST_F(MovingHead, the_built_in_head_greets_in_its_file) {
    const std::string scene = scene_of("builtin:bust", "rotate_deg = [0, 25, 0]\ntranslate_mm = [3, 0, 0]\n");
    const std::vector<std::byte> glb = written(loaded(scene, {}), {});
    // Between keys, where some targets move and others rest.
    for (const double time_s : {0.3, 0.77, 1.57, 1.9, 2.95, 3.33, 4.0}) {
        const Pose pose = {.clip = "greet", .time_s = time_s};
        const Difference found = difference(loaded(scene, pose).mesh, read_back(glb, pose));
        EXPECT_LT(found.position, kMostError) << time_s;
    }
    expect_valid(glb);
    EXPECT_EQ(glb, written(loaded(scene, {}), {})) << "the same input, the same bytes";
}

}  // namespace dermis
