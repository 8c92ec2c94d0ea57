// Clips, morph targets and skins of glTF against gltf_pose.py, which evaluates the specification in plain
// Python.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/mesh/mesh_poser.h"
#include "dermis/mesh/read_mesh.h"
#include "mesh/mesh_files.h"
#include "support/temporary_directory.h"

using namespace dermis;
using namespace dermis::test;
namespace fs = std::filesystem;

namespace {

constexpr double kMostError = 1e-5;  // of the model's size

// A list of positions for each time: to start Python takes longer than to evaluate one.
std::vector<std::vector<Vec3>> positions_by_python(const std::string& file, const std::string& clip,
                                                   std::span<const double> times_s,
                                                   const std::string& scratch) {
    std::string command =
        "python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py evaluate " + file + " " + clip;
    for (const double time_s : times_s) command += " " + std::to_string(time_s);
    const ProgramResult run = run_shell(command, scratch);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::istringstream text(run.out);
    std::vector<std::vector<Vec3>> lists(1);
    for (std::string line; std::getline(text, line);) {
        if (line.empty()) {
            lists.emplace_back();
            continue;
        }
        Vec3 p;
        std::istringstream(line) >> p.x >> p.y >> p.z;
        lists.back().push_back(p);
    }
    lists.pop_back();
    EXPECT_EQ(lists.size(), times_s.size());
    lists.resize(times_s.size());
    return lists;
}

LoadedMesh load_posed(const std::string& file, const Pose& pose) {
    Result<LoadedMesh> loaded = read_mesh(file, {.pose = pose, .keep_vertices = true});
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? std::move(*loaded) : LoadedMesh{};
}

// The largest distance between two lists of positions, by their size.
double distance(const std::vector<Vec3>& expected, const std::vector<Vec3>& found) {
    EXPECT_EQ(expected.size(), found.size());
    if (expected.empty() || expected.size() != found.size()) return 1e9;
    Vec3 low = expected[0], high = low;
    double largest = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        const Vec3 p = expected[i];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        largest = std::max(largest, double(length(found[i] - p)));
    }
    return largest / double(length(high - low));
}

// One poser in several poses and at rest again, against reading the file in each: every bit.
void expect_poser_reads_the_same(const std::string& file, const std::string& clip) {
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto poser = MeshPoser::create(*bytes, file, {}, {});
    ASSERT_TRUE(poser) << poser.error().message;
    for (const double time_s : {1.7, 0.3, 0.9, -1.0}) {
        const Pose pose = time_s < 0 ? Pose{} : Pose{.clip = clip, .time_s = time_s};
        const LoadedMesh loaded = load_posed(file, pose);
        const auto posed = poser->pose(pose);
        ASSERT_TRUE(posed) << posed.error().message;
        EXPECT_EQ(posed->positions_mm, loaded.mesh.positions_mm) << file << " at " << time_s;
        EXPECT_EQ(posed->normals, loaded.mesh.normals) << file << " at " << time_s;
        EXPECT_EQ(posed->target_weights, loaded.target_weights) << file << " at " << time_s;
    }
}

class GltfPose : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to evaluate the poses";
    }
    TemporaryDirectory scratch_;
};

// A triangle with a target and one clip whose times and weights are given; a buffer of floats.
std::string clip_text(const std::vector<float>& times, const std::vector<float>& weights,
                      const std::string& path = "weights", const std::string& target_count = "3") {
    std::vector<float> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    numbers.insert(numbers.end(), times.begin(), times.end());
    numbers.insert(numbers.end(), weights.begin(), weights.end());
    std::string bytes(numbers.size() * 4, '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    const auto view = [](size_t first, size_t count) {
        return R"({"buffer":0,"byteOffset":)" + std::to_string(4 * first) + R"(,"byteLength":)" +
               std::to_string(4 * count) + "}";
    };
    const auto accessor = [](int number, const std::string& type, const std::string& count) {
        return R"({"bufferView":)" + std::to_string(number) + R"(,"componentType":5126,"type":")" + type +
               R"(","count":)" + count + "}";
    };
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1}]}],"extras":{"targetNames":["lift"]}}],"animations":[{"name":"up","channels":[{"sampler":0,"target":{"node":0,"path":")" +
           path + R"("}}],"samplers":[{"input":2,"output":3}]}],"accessors":[)" + accessor(0, "VEC3", "3") +
           "," + accessor(1, "VEC3", target_count) + "," +
           accessor(2, "SCALAR", std::to_string(times.size())) + "," +
           accessor(3, "SCALAR", std::to_string(weights.size())) + R"(],"bufferViews":[)" + view(0, 9) + "," +
           view(9, 9) + "," + view(18, times.size()) + "," + view(18 + times.size(), weights.size()) +
           R"(],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) + R"(,"uri":")" + data_uri(bytes) +
           "\"}]}";
}

// z of the first vertex in metres.
float lift_of(const std::string& text, const Pose& pose) {
    const auto loaded = parse_gltf_text(text, {}, {.pose = pose});
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? loaded->mesh.positions_mm[0].z / 1000 : -1;
}

std::string pose_error(const std::string& text) {
    const auto loaded = parse_gltf_text(text, {}, {.pose = {.clip = "up", .time_s = 0.5}});
    return loaded ? "" : loaded.error().message;
}

}  // namespace

TEST_F(GltfPose, every_kind_of_motion_agrees_with_the_specification) {
    const std::string folder = scratch_.path.string();
    const ProgramResult written =
        run_shell("python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py write " + folder, folder);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    int files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".glb") continue;
        ++files;
        constexpr std::array kTimesS = {0.0, 0.3, 0.5, 0.9, 1.7, 3.0};
        const auto expected = positions_by_python(entry.path().string(), "move", kTimesS, folder);
        for (size_t i = 0; i < kTimesS.size(); ++i) {
            const LoadedMesh loaded =
                load_posed(entry.path().string(), {.clip = "move", .time_s = kTimesS[i]});
            EXPECT_LT(distance(expected[i], loaded.mesh.positions_mm), kMostError)
                << entry.path().filename() << " at " << kTimesS[i];
        }
        expect_poser_reads_the_same(entry.path().string(), "move");
    }
    EXPECT_EQ(files, 10);
}

TEST_F(GltfPose, a_face_of_57_targets_and_a_skin_agrees_with_the_specification) {
    const fs::path file = asset("ict_face/ict_moving.glb");
    if (!fs::exists(file)) GTEST_SKIP() << file << " is needed";
    for (const std::string clip : {"smile", "talk", "frown"}) {
        const std::vector<Vec3> expected =
            positions_by_python(file.string(), clip, std::array{1.23}, scratch_.path.string())[0];
        const LoadedMesh loaded = load_posed(file.string(), {.clip = clip, .time_s = 1.23});
        EXPECT_LT(distance(expected, loaded.mesh.positions_mm), kMostError) << clip;
        EXPECT_GT(distance(expected, load_posed(file.string(), {}).mesh.positions_mm), 1e-3) << clip;
        EXPECT_EQ(loaded.motion.targets.size(), 57u);
        EXPECT_EQ(loaded.motion.clips.size(), 3u);
        EXPECT_EQ(loaded.motion.joints, 3u);
        expect_poser_reads_the_same(file.string(), clip);
    }
}

TEST(GltfClip, holds_or_repeats_and_gives_way_to_weights_by_name) {
    const std::string text = clip_text({1, 2}, {0, 1});
    EXPECT_EQ(lift_of(text, {}), 0);
    EXPECT_EQ(lift_of(text, {.clip = "up", .time_s = 0}), 0);
    EXPECT_EQ(lift_of(text, {.clip = "up", .time_s = 1.5}), 0.5f);
    EXPECT_EQ(lift_of(text, {.clip = "#1", .time_s = 9}), 1) << "held";
    EXPECT_EQ(lift_of(text, {.clip = "up", .time_s = 3.25, .loop = true}), 0.25f) << "2 s long";
    EXPECT_EQ(lift_of(text, {.clip = "up", .time_s = 1.5, .morph = {{"lift", 0.75f}}}), 0.75f);
    EXPECT_EQ(lift_of(text, {.morph = {{"#1", -1.0f}}}), -1);
}

TEST(GltfClip, what_a_mesh_has_is_listed_and_what_it_lacks_is_named) {
    const auto loaded = parse_gltf_text(clip_text({1, 2}, {0, 1}));
    ASSERT_TRUE(loaded);
    ASSERT_EQ(loaded->motion.clips.size(), 1u);
    EXPECT_EQ(loaded->motion.clips[0].name, "up");
    EXPECT_EQ(loaded->motion.clips[0].length_s, 2);
    EXPECT_EQ(loaded->motion.targets, std::vector<std::string>{"lift"});
    const std::span<const Motion> motions(&loaded->motion, 1);
    EXPECT_TRUE(check_pose({.clip = "up", .morph = {{"lift", 1.0f}}}, motions));
    EXPECT_NE(check_pose({.clip = "down"}, motions).error().message.find("'down'"), std::string::npos);
    EXPECT_NE(check_pose({.morph = {{"lid", 1.0f}}}, motions).error().message.find("'lid'"),
              std::string::npos);
    EXPECT_NE(check_pose({.clip = "up"}, {}).error().message.find("has none"), std::string::npos);
}

TEST(GltfClip, what_is_wrong_is_named) {
    const float nan = std::nanf("");
    const std::pair<std::string, std::string> cases[] = {
        {clip_text({2, 1}, {0, 1}), "input: the times go back at key 1 (1 s after 2 s)"},
        {clip_text({0, nan}, {0, 1}), "input: the time of key 1 must be finite"},
        {clip_text({0, 1}, {0, nan}), "output: must be finite"},
        {clip_text({0, 1}, {0, 1, 2}), "output: has 3 numbers; 2 keys need 2"},
        {clip_text({0, 1}, {0, 1}, "pointer"), "uses KHR_animation_pointer, which is not supported"},
        {clip_text({0, 1}, {0, 1}, "colour"), "path: must be translation, rotation, scale or weights"},
        {clip_text({0, 1}, {0, 1}, "weights", "2"), "targets[0].POSITION: has 2 elements for 3 positions"}};
    for (const auto& [text, message] : cases)
        EXPECT_NE(pose_error(text).find(message), std::string::npos)
            << pose_error(text) << "\nnot " << message;
    // Without the clip the file is read, with a warning where the clip is broken.
    const auto still = parse_gltf_text(clip_text({2, 1}, {0, 1}));
    ASSERT_TRUE(still);
    EXPECT_TRUE(any_contains(still->warnings, "clip 'up' does not play"));
}

TEST(GltfClip, normals_turn_with_targets_that_have_none) {
    // A square in the plane z = 0 whose normals lean; the target turns it upright, so that z becomes -y.
    const std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
                             R"({"attributes":{"POSITION":0,"NORMAL":1},"targets":[{"POSITION":2}]}]}],)";
    std::vector<float> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (int i = 0; i < 3; ++i) numbers.insert(numbers.end(), {0.6f, 0, 0.8f});
    numbers.insert(numbers.end(), {0, 0, 0, 0, 0, 0, 0, -1, 1});
    std::string bytes(numbers.size() * 4, '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    std::string accessors, views;
    for (int i = 0; i < 3; ++i) {
        const std::string comma = i > 0 ? "," : "";
        accessors += comma + R"({"bufferView":)" + std::to_string(i) +
                     R"(,"componentType":5126,"type":"VEC3","count":3})";
        views += comma + R"({"buffer":0,"byteLength":36,"byteOffset":)" + std::to_string(36 * i) + "}";
    }
    const auto loaded =
        parse_gltf_text(text + R"("accessors":[)" + accessors + R"(],"bufferViews":[)" + views +
                            R"(],"buffers":[{"byteLength":108,"uri":")" + data_uri(bytes) + "\"}]}",
                        {}, {.pose = {.morph = {{"#1", 1.0f}}}});
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (const Vec3& n : loaded->mesh.normals) EXPECT_LT(length(n - Vec3{0.6f, -0.8f, 0}), 1e-5f);
}
