// Tables, curvature maps and images that do not fit their use are refused with the reason.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "render/grid_scene.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class PreintegratedRefusals : public PreintegratedTest {
  protected:
    std::string path(const std::string& name) const { return (directory_.path / name).string(); }

    // A table as `dermis bake lut` writes it, changed in one way.
    template <class Change>
    std::string baked(const std::string& name, Change change) const {
        LutOptions options = *lut_options("dermis");
        options.width = 128, options.height = 128;
        options.convention.axes[1] = curvature_axis(0, 1);
        change(options);
        const Result<Table> table = bake_lut(options);
        EXPECT_TRUE(table) << table.error().message;
        EXPECT_TRUE(write_table(path(name), *table));
        return path(name);
    }
    static std::string refusal(const std::string& table, const Settings& settings = {}) {
        Scene scene = make_grid_scene();
        scene.skin.diffuse_table = table;
        Renderer renderer = make_renderer(scene);
        const auto drawn = renderer.draw(technique(), values_of(settings), {.width = 8, .height = 8});
        return drawn ? "" : drawn.error().message;
    }
    // A scene file around the built-in spheres.
    std::string scene_error(const std::string& rest) const {
        const std::string file = path("scene.toml");
        EXPECT_TRUE(write_text_file(file, "[[mesh]]\nfile = \"builtin:spheres\"\n" + rest));
        const Result<Scene> scene = load_built_in_scene(file);
        return scene ? "" : scene.error().message;
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(PreintegratedRefusals, settings_that_exclude_each_other) {
    for (const auto& [settings, mend] : std::initializer_list<std::pair<Settings, const char*>>{
             {{{"normals", "baked"}, {"diffuse", "closed_form"}},
              "needs diffuse=lut; set it, or normals=auto"},
             {{{"normals", "baked"}, {"diffuse", "half_ring"}}, "needs diffuse=lut"},
             {{{"normals", "baked"}, {"curvature", "derivative"}}, "needs curvature=vertex"},
             {{{"normals", "baked"}, {"ambient", "curve_2015"}}, "needs ambient=profile"},
             {{{"shadow", "gathered"}, {"diffuse", "closed_form"}}, "set diffuse=lut, or shadow=auto"}}) {
        const Result<void> checked = check_settings(technique(), values_of(settings));
        ASSERT_FALSE(checked) << mend;
        EXPECT_THAT(checked.error().message, HasSubstr(mend));
    }
    for (const Settings& sound :
         {Settings{{"normals", "baked"}}, {{"shadow", "gathered"}, {"diffuse", "half_ring"}}})
        EXPECT_TRUE(check_settings(technique(), values_of(sound)));
}

TEST_F(PreintegratedRefusals, a_fitting_table_is_read_instead_of_baking_one) {
    Scene scene = make_grid_scene();
    const Settings settings = {{"shadow", "plain"}};
    const Image baked_here = draw_grid(scene, settings);
    scene.skin.diffuse_table = baked("own.exr", [](LutOptions&) {});
    const Image own = draw_grid(scene, settings);
    EXPECT_LT(relative_difference(own, baked_here, 1), 0.04) << "half floats, fewer texels";
    EXPECT_NE(own.bytes, baked_here.bytes) << "it was read at all";
}

// Light from all around with the 8-bit table, whose steps are 0.0012, and with one that holds other numbers.
TEST_F(PreintegratedRefusals, a_zonal_table_of_8_bits_is_read_instead_of_baking_one) {
    Scene scene = load("builtin:spheres");
    scene.lights.clear();
    const DrawSettings small = {.width = 64, .height = 64, .view = "diffuse"};
    const auto drawn = [&] {
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, technique(), values_of({}), small);
    };
    const Image baked_here = drawn();
    Table table = *bake_zonal_harmonics({.profile = *find_profile("gpu_gems_3"),
                                         .curvature = curvature_axis(0, 1),
                                         .layout = ZonalLayout::two_rows_remapped_8});
    scene.skin.zonal_table = path("zh.png");
    ASSERT_TRUE(write_table(path("zh.png"), table, TableStorage::u8));
    EXPECT_LT(relative_difference(drawn(), baked_here, 1), 0.004);
    for (float& value : table.data) value *= 0.95f;
    scene.skin.zonal_table = path("darker.png");
    ASSERT_TRUE(write_table(path("darker.png"), table, TableStorage::u8));
    EXPECT_GT(relative_difference(drawn(), baked_here, 1), 0.04);
    scene.skin.zonal_table = baked("diffuse.exr", [](LutOptions&) {});
    Renderer renderer = make_renderer(scene);
    const auto refused = renderer.draw(technique(), values_of({}), small);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("this use needs 'zonal_harmonics'"));
}

TEST_F(PreintegratedRefusals, tables_for_another_skin_or_integral) {
    EXPECT_EQ(refusal(baked("own.exr", [](LutOptions&) {})), "");
    EXPECT_THAT(refusal(baked("skin1.exr", [](LutOptions& o) { o.profile.name = "somebody"; })),
                HasSubstr("'profile' is 'somebody', this use needs 'gpu_gems_3'"));
    EXPECT_THAT(refusal(path("own.exr"), {{"diffuse", "half_ring"}}),
                HasSubstr("'construction' is 'sphere'"));
    EXPECT_THAT(refusal(path("absent.exr")), HasSubstr("absent.exr"));
}

TEST_F(PreintegratedRefusals, harmonics_with_other_variances_than_the_diffuse_table) {
    Scene scene = make_grid_scene();
    const std::string file = path("zh.exr");
    const Table table = *bake_zonal_harmonics({.profile = *find_profile("gpu_gems_3"),
                                               .width = 16,
                                               .how = {.construction = Construction::half_ring}});
    ASSERT_TRUE(write_table(file, table));
    scene.skin.zonal_table = file;
    Renderer renderer = make_renderer(scene);
    const auto refused =
        renderer.draw(technique(), values_of({{"diffuse", "half_ring"}}), {.width = 8, .height = 8});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                HasSubstr("its variances are x 1, those of the diffuse table x 1.414; bake it with "
                          "--variance-scale 1.414"));
}

TEST_F(PreintegratedRefusals, tables_in_another_unit) {
    EXPECT_THAT(
        refusal(baked("radius.exr", [](LutOptions& o) { o.convention.axes[1] = radius_axis(1, 32); })),
        HasSubstr("'axes[1].name' is 'radius_mm', this use needs 'curvature_per_mm'"));
    const std::string per_cm = baked("cm.exr", [](LutOptions& o) { o.convention.axes[1].unit = "1/cm"; });
    EXPECT_THAT(refusal(per_cm), HasSubstr("1/cm"));
}

TEST_F(PreintegratedRefusals, a_table_marked_as_srgb) {
    // A linear table whose PNG somebody marked as sRGB: the same bytes with an sRGB chunk after the header.
    const std::string table = baked("flag.png", [](LutOptions&) {});
    std::vector<std::byte> bytes = *read_file(table);
    const unsigned char chunk[] = {0, 0, 0, 1, 's', 'R', 'G', 'B', 0, 0xAE, 0xCE, 0x1C, 0xE9};
    ASSERT_FALSE(png_is_flagged_srgb(bytes));
    const auto* first = reinterpret_cast<const std::byte*>(chunk);
    bytes.insert(bytes.begin() + 33, first, first + sizeof chunk);
    ASSERT_TRUE(write_file(table, bytes));
    EXPECT_THAT(refusal(table), HasSubstr("sRGB"));
}

TEST_F(PreintegratedRefusals, curvature_images_without_a_unit) {
    ASSERT_TRUE(write_image(path("curvature.exr"), Image(4, 4, 1)));
    const std::string maps = "[maps]\ncurvature = \"curvature.exr\"\n";
    EXPECT_THAT(scene_error(maps), HasSubstr("curvature.exr has no unit; give curvature_scale_per_mm"));
    EXPECT_THAT(scene_error(maps), HasSubstr("scene.toml:4: maps.curvature"));
    EXPECT_EQ(scene_error(maps + "curvature_scale_per_mm = 1\n"), "");
    for (const auto& [json, error] : {std::pair{"{\"unit\": \"1/mm\"}", ""},
                                      {"{\"unit\": \"1/cm\"}", "the unit is \"1/cm\""},
                                      {"{\"unit\": 3}", "the unit is 3"},
                                      {"{}", "the unit is not stated"},
                                      {"[", "the unit is not stated"}}) {
        ASSERT_TRUE(write_text_file(path("curvature.exr.json"), json));
        if (*error)
            EXPECT_THAT(scene_error(maps), HasSubstr(error)) << json;
        else
            EXPECT_EQ(scene_error(maps), "") << json;
    }
}

TEST_F(PreintegratedRefusals, maps_of_no_size) {
    Scene scene = make_grid_scene();
    scene.objects[0].mesh.materials[0].curvature_map = {
        .name = "empty", .width = 0, .height = 4, .channels = 1, .pixels = {std::byte{1}}};
    const auto renderer =
        Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), scene);
    ASSERT_FALSE(renderer);
    EXPECT_THAT(renderer.error().message, HasSubstr("empty: 0 x 4 texels of 1 channels cannot be 1 bytes"));
    // A PNG whose header says 0 x 1.
    const unsigned char png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0,
                                 0,    0,   0,   0,   0,  0,  1,  8,  0, 0, 0, 0,  0,   0,   0,   0};
    ASSERT_TRUE(write_file(path("none.png"), std::as_bytes(std::span(png))));
    scene.objects[0].mesh.materials[0].curvature_map = {.name = path("none.png")};
    const auto none = Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), scene);
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("none.png"));
}
