#include "dermis/rays/bake_map.h"
#include "dermis/mesh/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "dermis/base/parallel.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/map_file.h"
#include "dermis/rays/uv_raster.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

std::vector<SceneObject> object_of(Mesh mesh) {
    return {{.name = "object", .mesh = std::move(mesh), .classes = {MaterialClass::skin}}};
}

BakeMapSettings small(MapKind kind, int size = 128) {
    return {.kind = kind, .size = size, .gutter_texels = 4, .ray_size = size};
}

// Calls `look(value, u, v)` for every covered texel.
template <class Look>
void for_covered(const BakedMap& map, Look look) {
    const auto channels = size_t(map.values.channels);
    for (int y = 0; y < map.values.height; ++y)
        for (int x = 0; x < map.values.width; ++x) {
            const size_t i = size_t(y) * size_t(map.values.width) + size_t(x);
            if (map.coverage.bytes[i] != std::byte{0})
                look(map.values.floats()[i * channels], (float(x) + 0.5f) / float(map.values.width),
                     (float(y) + 0.5f) / float(map.values.height));
        }
}

Mesh torus(float major_mm, float minor_mm) {
    return test::grid(192, 96, [&](float u, float v) {
        const float a = test::turn_rad(u), b = test::turn_rad(v);
        const Vec3 n{std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)};
        return test::Placed{Vec3{std::sin(a), 0, std::cos(a)} * major_mm + n * minor_mm, n};
    });
}

TEST(UvRaster, a_square_of_two_triangles_covers_every_texel_once) {
    const auto objects = object_of(test::plane(10, 0));
    const UvRaster raster = rasterise_uv(objects, 33, 33);
    EXPECT_EQ(raster.covered, 33u * 33u);
    EXPECT_EQ(raster.overlapping, 0u);
    const UvTexel& middle = raster.texels[16 * 33 + 16];
    const Mesh& mesh = objects[0].mesh;
    const uint32_t* c = &mesh.indices[3 * middle.triangle];
    const float u = mesh.uvs[c[0]].x * (1 - middle.u - middle.v) + mesh.uvs[c[1]].x * middle.u +
                    mesh.uvs[c[2]].x * middle.v;
    EXPECT_NEAR(u, 0.5f, 1e-6);
}

TEST(UvRaster, mirrored_triangles_and_fine_grids_leave_no_cracks) {
    Mesh mesh = test::plane(10, 0, 17);
    for (Vec2& uv : mesh.uvs) uv.x = 1 - uv.x;
    const UvRaster raster = rasterise_uv(object_of(mesh), 100, 100);
    EXPECT_EQ(raster.covered, 100u * 100u);
    EXPECT_EQ(raster.overlapping, 0u);
}

TEST(UvRaster, other_tiles_and_other_materials_are_left_out) {
    Mesh mesh = test::plane(10, 0);
    for (Vec2& uv : mesh.uvs) uv.x += 1;
    const UvRaster outside = rasterise_uv(object_of(mesh), 16, 8);
    EXPECT_EQ(outside.covered, 0u);
    EXPECT_EQ(outside.outside, 2u);
    auto objects = object_of(test::plane(10, 0));
    objects[0].classes = {MaterialClass::other};
    EXPECT_EQ(rasterise_uv(objects, 16, 16).covered, 0u);
    const auto all = [](const SceneObject&, uint32_t) { return true; };
    EXPECT_EQ(rasterise_uv(objects, 16, 8, all).covered, 128u);
}

TEST(BakeMap, the_curvature_of_a_sphere_is_one_over_its_radius) {
    const auto map = bake_map(object_of(test::uv_sphere(40, 128, 64)), small(MapKind::curvature));
    ASSERT_TRUE(map) << map.error().message;
    for_covered(*map, [](float value, float, float v) {
        if (v > 0.1f && v < 0.9f) {  // near the poles of this grid cells are slivers
            EXPECT_NEAR(value * 40, 1, 0.005) << v;
        }
    });
}

TEST(BakeMap, a_cavity_is_negative) {
    Mesh mesh = test::uv_sphere(40, 64, 32);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (Vec3& n : mesh.normals) n = -n;
    const auto map = bake_map(object_of(mesh), small(MapKind::curvature));
    for_covered(*map, [](float value, float, float) { EXPECT_LT(value, 0); });
}

TEST(BakeMap, the_curvature_of_a_torus_follows_its_formula_across_the_seam) {
    const float major = 30, minor = 10;
    const auto map = bake_map(object_of(torus(major, minor)), small(MapKind::curvature));
    for_covered(*map, [&](float value, float, float v) {
        const float c = std::cos(2 * std::numbers::pi_v<float> * v);
        const float exact = 0.5f * (1 / minor + c / (major + minor * c));
        EXPECT_NEAR(value, exact, 0.01f * std::abs(exact) + 1e-4f) << v;
    });
}

TEST(BakeMap, the_curvature_of_a_cylinder_is_half_of_one_over_its_radius) {
    const Mesh tube = test::grid(96, 16, [](float u, float v) {
        const float a = test::turn_rad(u);
        const Vec3 n{std::sin(a), 0, std::cos(a)};
        return test::Placed{n * 25.0f + Vec3{0, (0.5f - v) * 60, 0}, n};
    });
    const auto map = bake_map(object_of(tube), small(MapKind::curvature));
    for_covered(*map, [](float value, float, float v) {
        if (v > 0.15f && v < 0.85f) {  // the open ends have no neighbours on one side
            EXPECT_NEAR(value * 50, 1, 0.01) << v;
        }
    });
}

// Around the tube it bends by 1 / R, along it not at all; with tangents at 45 degrees all of that is twist.
TEST(BakeMap, the_curvature_of_a_cylinder_says_in_which_direction_it_bends) {
    for (const bool turned : {false, true}) {
        Mesh tube = make_cylinder(25, 60, 96);
        for (size_t i = 0; i < tube.tangents.size(); ++i)
            if (const Vec4 t = tube.tangents[i]; turned) {
                const Vec3 along = normalize(Vec3{t.x, t.y + 1, t.z});  // at right angles to y before
                tube.tangents[i] = {along.x, along.y, along.z, 1};
            }
        const auto map = bake_map(object_of(tube), small(MapKind::curvature));
        ASSERT_TRUE(map) << map.error().message;
        const int middle = map->values.height / 2;
        for (int x = 4; x < map->values.width - 4; ++x) {
            EXPECT_NEAR(map->values.at(x, middle, 0) * 50, 1, 0.01) << x;
            EXPECT_NEAR(map->values.at(x, middle, 1) * 50, turned ? 0 : 1, 0.02) << x;
            EXPECT_NEAR(map->values.at(x, middle, 2) * 50, turned ? -1 : 0, 0.02) << x;
        }
    }
}

TEST(BakeMap, a_slab_is_as_thick_as_it_is_whatever_the_cone) {
    for (const float cone : {0.0f, 0.5f, 1.0f}) {
        Mesh slab = test::joined(test::plane(1000, 0), test::ceiling(1000, -4));
        for (size_t i = slab.uvs.size() / 2; i < slab.uvs.size(); ++i) slab.uvs[i] = {-1, -1};
        BakeMapSettings settings = small(MapKind::thickness, 16);
        settings.cone_rad = cone;
        auto objects = object_of(slab);
        objects[0].classes = {MaterialClass::skin, MaterialClass::skin};
        const auto map = bake_map(objects, settings);
        ASSERT_TRUE(map);
        for_covered(*map, [](float value, float u, float v) {
            if (std::abs(u - 0.5f) < 0.3f && std::abs(v - 0.5f) < 0.3f) {
                EXPECT_NEAR(value, 4, 1e-3);
            }
        });
    }
}

TEST(BakeMap, a_sphere_s_thickness_follows_the_cone) {
    for (const float cone : {0.0f, 0.7853982f, 1.2f}) {
        BakeMapSettings settings = small(MapKind::thickness, 48);
        settings.cone_rad = cone;
        settings.rays = 256;
        const auto map = bake_map(object_of(test::uv_sphere(30, 128, 64)), settings);
        ASSERT_TRUE(map) << map.error().message;
        const float exact = 30 * (1 + std::cos(cone) * std::cos(cone));
        // Right at the poles a straight ray runs along the slivers' common edge and may pass between them.
        for_covered(*map, [&](float value, float, float v) {
            if (std::abs(v - 0.5f) < 0.46f) {
                EXPECT_NEAR(value, exact, 0.01f * exact) << cone;
            }
        });
    }
}

TEST(BakeMap, an_open_surface_gets_the_maximum_and_a_warning) {
    const auto map = bake_map(object_of(test::plane(100, 0)), small(MapKind::thickness, 16));
    ASSERT_TRUE(map);
    for_covered(*map, [](float value, float, float) { EXPECT_EQ(value, 200); });
    ASSERT_FALSE(map->warnings.empty());
    EXPECT_NE(map->warnings[0].find("no opposite side"), std::string::npos);
}

TEST(BakeMap, the_kernel_is_wide_where_the_skin_is_thin_and_never_one) {
    const Profile profile = *find_profile("gpu_gems_3");
    const float spread_mm = spread_radius_mm(profile);
    EXPECT_NEAR(spread_mm, inverse_cdf_mm(profile, kRed, 0.95), 1e-3);
    EXPECT_FLOAT_EQ(kernel_size_of_thickness(spread_mm, spread_mm), 0.5f);
    EXPECT_LT(kernel_size_of_thickness(spread_mm, 0), 1);
    EXPECT_GT(kernel_size_of_thickness(spread_mm, 3), kernel_size_of_thickness(spread_mm, 30));
    BakeMapSettings settings = small(MapKind::kernel_size, 32);
    EXPECT_FALSE(bake_map(object_of(test::uv_sphere(30, 32, 16)), settings));
    settings.profile = profile;
    const auto map = bake_map(object_of(test::uv_sphere(30, 64, 32)), settings);
    ASSERT_TRUE(map);
    EXPECT_NEAR(map->max, kernel_size_of_thickness(spread_mm, 45), 0.01);
}

TEST(BakeMap, stretch_is_the_size_of_the_uv_square) {
    const Mesh mesh = test::grid(4, 4, [](float u, float v) {
        return test::Placed{{u * 30 + v * 10, -v * 20, 0}, {0, 0, 1}};  // a sheared plane
    });
    const auto map = bake_map(object_of(mesh), small(MapKind::stretch, 32));
    ASSERT_TRUE(map);
    const std::span<const float> values = std::as_const(map->values).floats();
    EXPECT_NEAR(values[0], 30, 1e-3);
    EXPECT_NEAR(values[1], std::sqrt(500.0f), 1e-3);
    EXPECT_NEAR(values[2], 300 / (30 * std::sqrt(500.0f)), 1e-4);
}

TEST(BakeMap, occlusion_is_one_on_a_ball_and_less_under_a_lid) {
    BakeMapSettings settings = small(MapKind::occlusion, 32);
    settings.max_mm = 0;
    const auto ball = bake_map(object_of(test::uv_sphere(30, 64, 32)), settings);
    ASSERT_TRUE(ball);
    EXPECT_GT(ball->min, 0.99f);
    auto objects = object_of(test::plane(10, 0));
    objects.push_back({.name = "lid", .mesh = test::plane(1000, 5), .classes = {MaterialClass::other}});
    EXPECT_LT(bake_map(objects, settings)->max, 0.05f);
}

TEST(BakeMap, a_coarse_ray_grid_differs_little_from_a_fine_one_and_threads_change_nothing) {
    const auto objects = object_of(torus(30, 10));
    BakeMapSettings fine = small(MapKind::thickness, 128), coarse = fine;
    coarse.ray_size = 64;
    const auto a = bake_map(objects, fine), b = bake_map(objects, coarse);
    double difference = 0;
    for (size_t i = 0; i < 128 * 128; ++i)
        difference += std::abs(a->values.floats()[i] - b->values.floats()[i]) / (128 * 128);
    EXPECT_LT(difference, 0.3);
    set_thread_limit(1);
    EXPECT_EQ(bake_map(objects, coarse)->values.bytes, b->values.bytes);
    set_thread_limit(0);
}

TEST(BakeMap, the_gutter_continues_the_island_and_stops) {
    Mesh mesh = test::plane(10, 0);
    for (Vec2& uv : mesh.uvs) uv = uv * 0.5f;
    const auto map = bake_map(object_of(mesh), small(MapKind::stretch, 64));
    EXPECT_NEAR(map->values.at(34, 10, 0), 20, 1e-3);
    EXPECT_EQ(map->values.at(40, 10, 0), 0);
}

TEST(BakeMap, what_cannot_be_baked_is_named) {
    Mesh bare = test::sphere(10, 1);
    EXPECT_NE(bake_map(object_of(bare), small(MapKind::stretch)).error().message.find("UV"),
              std::string::npos);
    BakeMapSettings settings = small(MapKind::stretch);
    settings.material = "Fase";
    auto objects = object_of(test::plane(1, 0));
    objects[0].mesh.materials[0].name = "Face";
    EXPECT_NE(bake_map(objects, settings).error().message.find("Face"), std::string::npos);
    settings = small(MapKind::stretch);
    settings.size = 15;
    EXPECT_FALSE(bake_map(objects, settings));
}

TEST(MapFile, a_map_comes_back_from_its_file_with_its_meaning) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "dermis_map_test.exr";
    const BakeMapSettings settings = small(MapKind::curvature, 32);
    const auto map = bake_map(object_of(test::uv_sphere(40, 128, 64)), settings);
    ASSERT_TRUE(write_map(path, *map, {"ball", settings}));
    const auto image = read_image(path, ImageUse::data);
    ASSERT_TRUE(image);
    EXPECT_NEAR(image->image.at(16, 16, 0), 1 / 40.0f, 2e-4);
    ASSERT_TRUE(image->text.contains("dermis"));
    EXPECT_NE(image->text.at("dermis").find("\"unit\": \"1/mm\""), std::string::npos);
    std::ifstream sidecar(map_sidecar_path(path));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(sidecar), {}), image->text.at("dermis"));
    EXPECT_TRUE(read_image(map_preview_path(path), ImageUse::color));
    EXPECT_FALSE(write_map("map.png", *map, {"ball", settings}));
}

// As engines read it: a byte of 255 is max_mm.
TEST(MapFile, a_thickness_is_written_as_png_too) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "dermis_thickness.png";
    BakeMapSettings settings = small(MapKind::thickness, 32);
    settings.max_mm = 100;
    auto map = bake_map(object_of(test::uv_sphere(20, 128, 64)), settings);
    ASSERT_TRUE(map);
    ASSERT_TRUE(write_map(path, *map, {"ball", settings}));
    const auto image = read_image(path, ImageUse::data);
    ASSERT_TRUE(image);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image->image.at(16, 16, c), map->values.at(16, 16, 0) / 100, 0.5 / 255 + 1e-4);
    map->values.set(0, 0, 0, 0);
    map->coverage.set(0, 0, 0, 0);
    ASSERT_TRUE(write_map(path, *map, {"ball", settings}));
    EXPECT_EQ(read_image(path, ImageUse::data)->image.at(0, 0, 1), 1) << "without skin";
    EXPECT_NEAR(map->values.at(16, 16, 0), 30, 1.5);  // R (1 + cos^2 45 degrees)
    std::ifstream sidecar(map_sidecar_path(path));
    EXPECT_NE(std::string(std::istreambuf_iterator<char>(sidecar), {}).find("\"value_1_mm\": 100"),
              std::string::npos);
    settings.max_mm = 0;
    EXPECT_FALSE(write_map(path, *map, {"ball", settings}));
}

}  // namespace
}  // namespace dermis
