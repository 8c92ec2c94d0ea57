// Meshes posed on the device against the poser on the CPU: streams of the geometry, and pictures.

#include "dermis/render/deformer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/run_program.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/pose_scene.h"
#include "render/render_test.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

// The largest distance between the vectors of a stream and those of the CPU, and the mean.
struct Difference {
    double largest = 0, mean = 0;
};

// Mean over all numbers.
double mean_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) sum += std::abs(a.at(x, y, c) - b.at(x, y, c));
    return sum / (3.0 * a.width * a.height);
}

class DeformerTest : public RenderTest {
  protected:
    static Scene loaded(const std::string& path, const std::vector<SceneWord>& words = {}) {
        Result<Scene> scene = load_scene(path, {.words = words});
        EXPECT_TRUE(scene) << scene.error().message;
        if (!scene) return {};
        EXPECT_TRUE(complete_scene(*scene));
        return std::move(*scene);
    }

    std::string sheet() const {
        const auto path = directory_.path / "sheet.gltf";
        EXPECT_TRUE(write_text_file(path, test::moving_sheet()));
        return path.string();
    }

    /// Whether the device poses the scene, in this pose.
    static bool is_posed_on_device(const Scene& scene, const Pose& pose) {
        Renderer renderer = make_renderer(scene);
        const auto poser = ScenePoser::create(scene);
        EXPECT_TRUE(poser) << poser.error().message;
        const Result<bool> posed = renderer.pose_on_device(*poser, pose);
        EXPECT_TRUE(posed) << posed.error().message;
        return posed && *posed;
    }

    // What the device has against what the CPU uploads, by stream.
    static std::map<std::string, Difference> differences(const Scene& rest, const Pose& pose) {
        Scene on_device = rest, on_cpu = rest;
        Renderer renderer = make_renderer(on_device), other = make_renderer(on_cpu);
        const auto device_poser = ScenePoser::create(on_device), cpu_poser = ScenePoser::create(on_cpu);
        EXPECT_TRUE(device_poser && cpu_poser);
        const Result<bool> posed = renderer.pose_on_device(*device_poser, pose);
        EXPECT_TRUE(posed && *posed) << (posed ? "only the CPU" : posed.error().message);
        EXPECT_TRUE(cpu_poser->pose(pose, on_cpu));
        EXPECT_TRUE(other.vertices_moved());
        EXPECT_EQ(on_device.objects[0].mesh.positions_mm, rest.objects[0].mesh.positions_mm);
        std::map<std::string, Difference> found;
        for (const auto& [stream, components] : kStreams)
            for (size_t i = 0; i < rest.objects.size(); ++i)
                add(*renderer.geometries()[i], *other.geometries()[i], stream, components, found[stream]);
        return found;
    }

    static void add(const gpu::Geometry& one, const gpu::Geometry& other, const std::string& stream,
                    size_t components, Difference& difference) {
        const auto a = one.read(device(), stream), b = other.read(device(), stream);
        ASSERT_TRUE(a && b) << stream;
        ASSERT_EQ(a->size(), b->size());
        ASSERT_FALSE(a->empty());
        for (size_t i = 0; i < a->size(); i += components) {
            double squared = 0;
            for (size_t k = 0; k < components; ++k) squared += std::pow((*a)[i + k] - (*b)[i + k], 2);
            difference.largest = std::max(difference.largest, std::sqrt(squared));
            difference.mean += std::sqrt(squared) / double(a->size() / components);
        }
    }

    inline static const std::vector<std::pair<std::string, size_t>> kStreams = {
        {"position_mm", 3},
        {"normal", 3},
        {"tangent", 4},
        {"curvature_diagonal_per_mm", 3},
        {"curvature_mixed_per_mm", 3},
        {"du_mm", 3},
        {"dv_mm", 3},
        {"tension", 1}};
    // The largest as deformer.h states them.
    inline static const std::map<std::string, Difference> kMostDifference = {
        {"position_mm", {1e-4, 5e-6}},
        {"normal", {1e-3, 5e-5}},
        {"tangent", {1e-3, 5e-5}},
        {"curvature_diagonal_per_mm", {5e-3, 2.5e-5}},
        {"curvature_mixed_per_mm", {5e-3, 2.5e-5}},
        {"du_mm", {0.2, 1e-2}},
        {"dv_mm", {0.2, 1e-2}},
        {"tension", {2e-4, 1e-5}}};
    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(DeformerTest, a_sheet_with_a_target_and_a_node_that_turns_is_that_of_the_cpu) {
    const auto scene = directory_.path / "sheet.toml";
    ASSERT_TRUE(write_text_file(scene, "[[mesh]]\nfile = \"" + sheet() +
                                           "\"\nscale = 0.5\nrotate_deg = [20, -30, 10]\n"
                                           "translate_mm = [5, 6, 7]\n"));
    const Scene rest = loaded(scene.string());
    for (const double time_s : {0.0, 0.7, 1.5, 2.0})
        for (const auto& [stream, found] : differences(rest, {.clip = "nod", .time_s = time_s}))
            EXPECT_LT(found.largest, stream.ends_with("_mm") ? 1e-3 : 1e-4) << stream << " at " << time_s;
}

TEST_F(DeformerTest, ICT_s_face_is_that_of_the_cpu) {
    const std::filesystem::path file = test::asset("ict_face/ict_moving.glb");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is needed";
    const Scene rest = loaded(file.string());
    for (const std::string clip : {"smile", "talk", "frown"})
        for (const auto& [stream, found] : differences(rest, {.clip = clip, .time_s = 1.2})) {
            EXPECT_LT(found.largest, kMostDifference.at(stream).largest) << stream << " of " << clip;
            EXPECT_LT(found.mean, kMostDifference.at(stream).mean) << stream << " of " << clip;
        }
}

TEST_F(DeformerTest, a_scene_loaded_in_a_pose_goes_back_to_rest) {
    const Scene posed = loaded(sheet(), {{"animation.clip", "nod"}, {"animation.time_s", "1.5"}});
    for (const auto& [stream, found] : differences(posed, {}))
        EXPECT_LT(found.largest, stream.ends_with("_mm") ? 1e-3 : 1e-4) << stream;
}

// Only the target of the wrinkle map has a share: the tension at which it begins is never reached.
TEST_F(DeformerTest, wrinkles_by_target_are_those_after_an_upload) {
    const auto map = [](const std::string& name, uint8_t x) {
        return ImageSource{.name = name,
                           .width = 1,
                           .height = 1,
                           .channels = 3,
                           .pixels = {std::byte{x}, std::byte{128}, std::byte{220}}};
    };
    Scene one = loaded(sheet());
    Material& material = one.objects[0].mesh.materials[0];
    material.normal_map = map("flat", 128), material.wrinkle_stretch_map = map("wrinkle", 220);
    material.wrinkle_stretch_target = "lift";
    material.wrinkle_from = 3, material.wrinkle_full = 4;
    Scene other = one, unwrinkled = one;
    unwrinkled.objects[0].mesh.materials[0].wrinkle_stretch_target.clear();
    Renderer on_device = make_renderer(one), on_cpu = make_renderer(other),
             without = make_renderer(unwrinkled);
    const auto device_poser = ScenePoser::create(one), cpu_poser = ScenePoser::create(other);
    ASSERT_TRUE(device_poser && cpu_poser);
    const Technique& technique = built_in_technique("lambert");
    const DrawSettings settings = {.width = 64, .height = 64};
    for (const double time_s : {1.5, 0.2}) {
        const Pose pose = {.clip = "nod", .time_s = time_s};
        const Result<bool> posed = on_device.pose_on_device(*device_poser, pose);
        ASSERT_TRUE(posed && *posed);
        on_device.materials_changed();  // keeps the weights
        ASSERT_TRUE(cpu_poser->pose(pose, other));
        ASSERT_TRUE(on_cpu.vertices_moved());
        ASSERT_TRUE(*without.pose_on_device(*device_poser, pose));
        const Image a = radiance(on_device, technique, settings);
        EXPECT_LT(mean_difference(a, radiance(on_cpu, technique, settings)), 1e-3) << time_s;
        EXPECT_GT(mean_difference(a, radiance(without, technique, settings)), 5e-3) << time_s;
    }
}

TEST_F(DeformerTest, a_picture_is_that_after_an_upload) {
    Scene one = loaded(sheet()), other = loaded(sheet());
    Renderer on_device = make_renderer(one), on_cpu = make_renderer(other);
    const auto device_poser = ScenePoser::create(one), cpu_poser = ScenePoser::create(other);
    ASSERT_TRUE(device_poser && cpu_poser);
    const Technique& technique = built_in_technique("preintegrated");
    const DrawSettings settings = {.width = 64, .height = 64};
    const Image rest = radiance(on_device, technique, settings);
    (void)radiance(on_cpu, technique, settings);  // what is baked from the shape is of the rest pose, too
    for (const double time_s : {1.5, 0.2}) {
        const Pose pose = {.clip = "nod", .time_s = time_s};
        const Result<bool> posed = on_device.pose_on_device(*device_poser, pose);
        ASSERT_TRUE(posed && *posed);
        ASSERT_TRUE(cpu_poser->pose(pose, other));
        ASSERT_TRUE(on_cpu.vertices_moved());
        const Image a = radiance(on_device, technique, settings);
        EXPECT_LT(mean_difference(a, radiance(on_cpu, technique, settings)), 1e-3) << time_s;
        EXPECT_GT(mean_difference(a, rest), 1e-2) << time_s;
    }
    ASSERT_TRUE(on_device.has_tension());
}

// Nodes, weights, skins of 4 to 16 influences, targets with and without normals.
TEST_F(DeformerTest, files_of_every_kind_of_motion_are_those_of_the_cpu) {
    if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to write the files";
    const std::string folder = directory_.path.string();
    const ProgramResult written =
        run_shell("python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py write " + folder, folder);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".glb") continue;
        const Scene rest = loaded(entry.path().string());
        const Pose pose = {.clip = "move", .time_s = 0.9};
        ++files;
        const auto found = differences(rest, pose);
        EXPECT_LT(found.at("position_mm").largest, 1e-6 * double(rest.bounds_radius_mm)) << entry.path();
        for (const char* stream : {"normal", "tangent", "tension"})
            EXPECT_LT(found.at(stream).largest, 1e-3) << stream << " of " << entry.path();
    }
    EXPECT_EQ(files, 10);
}

TEST_F(DeformerTest, a_device_that_binds_few_storage_buffers_leaves_the_pose_to_the_cpu_and_says_so) {
    const Scene scene = loaded(sheet());
    for (const int most : {Deformer::kStorageBuffers, Deformer::kStorageBuffers - 1, 4}) {
        Result<gpu::Device> small = gpu::Device::create({.validation = true, .most_storage_buffers = most});
        ASSERT_TRUE(small) << small.error().message;
        Result<Renderer> renderer =
            Renderer::create(*small, gpu::embedded_shaders(built_in_catalog().shaders), scene);
        const auto poser = ScenePoser::create(scene);
        ASSERT_TRUE(renderer && poser);
        const bool suffices = most == Deformer::kStorageBuffers;
        const Result<bool> posed = renderer->pose_on_device(*poser, {.clip = "nod", .time_s = 1});
        ASSERT_TRUE(posed) << posed.error().message;
        EXPECT_EQ(*posed, suffices);
        (void)renderer->pose_on_device(*poser, {.clip = "nod", .time_s = 1.5});
        const auto says = testing::ElementsAre(testing::AllOf(
            testing::HasSubstr("binds " + std::to_string(Deformer::kStorageBuffers) + " storage buffers"),
            testing::HasSubstr("binds " + std::to_string(most) + " at most"),
            testing::HasSubstr("--device")));
        if (suffices)
            EXPECT_THAT(renderer->warnings(), testing::IsEmpty());
        else
            EXPECT_THAT(renderer->warnings(), says);
        EXPECT_THAT(small->messages(), testing::IsEmpty());
    }
}

TEST_F(DeformerTest, what_the_device_cannot_pose_is_left_to_the_cpu) {
    EXPECT_FALSE(is_posed_on_device(load("builtin:bust"), {.morph = {{"smile", 1.0f}}}));
    const Pose nod = {.clip = "nod", .time_s = 1};
    EXPECT_TRUE(is_posed_on_device(loaded(sheet()), nod));
    EXPECT_FALSE(is_posed_on_device(loaded(sheet(), {{"animation.rest_bakes", "curvature"}}), nod));
    EXPECT_FALSE(is_posed_on_device(
        loaded(sheet(), {{"skin.melanin", "0.03"}, {"skin.blood", "0.03"}, {"skin.blood_by_tension", "1"}}),
        nod));
}

}  // namespace dermis
