// OBJ and MTL files of other programs: what the renderer can use is read, the rest is named in warnings.

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n";

LoadedMesh load(const std::string& text, const std::map<std::string, std::string>& files = {},
                const MeshOptions& options = {}) {
    auto loaded = parse_obj_text(text, files, options);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? std::move(*loaded) : LoadedMesh{.mesh = {.materials = {{}}}};
}

LoadedMesh with_mtl(const std::string& lines) {
    return load("mtllib m.mtl\n" + kTriangle, {{"m.mtl", "newmtl skin\n" + lines}});
}

}  // namespace

TEST(ForeignObj, a_byte_order_mark_is_skipped) {
    const std::string mark = "\xEF\xBB\xBF";
    EXPECT_EQ(load(mark + kTriangle).mesh.positions_mm.size(), 3u);
    const LoadedMesh loaded =
        load(mark + "mtllib m.mtl\n" + kTriangle, {{"m.mtl", mark + "newmtl skin\nPr 0.25\n"}});
    EXPECT_EQ(loaded.mesh.materials[0].roughness, 0.25f);
}

TEST(ForeignObj, the_warning_about_the_height_counts_the_scale_that_follows) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 2.5 0\nf 1 2 3\n";
    EXPECT_TRUE(any_contains(load(head).warnings, "2.5 mm tall"));
    EXPECT_FALSE(any_contains(load(head, {}, {.scale_after = 100}).warnings, "mm tall"));
    const std::string large = "v 0 0 0\nv 1 0 0\nv 0 250 0\nf 1 2 3\n";
    EXPECT_TRUE(any_contains(load(large, {}, {.scale_after = 0.01}).warnings, "2.5 mm tall"));
}

TEST(ForeignObj, a_polygon_with_holes_keeps_them_open) {
    struct Case {
        const char* name;
        const char* text;
        double area;
    };
    const std::string outer = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n",
                      inner = "v 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n";
    const std::string two = "v 1 1 0\nv 2 1 0\nv 2 3 0\nv 1 3 0\nv 2.5 1 0\nv 3 1 0\nv 3 3 0\nv 2.5 3 0\n";
    const std::string one = outer + inner + "f 1 2 3 4 1 5 8 7 6 5\n";
    const std::string other_start = outer + inner + "f 8 7 6 5 1 2 3 4 1 5\n";
    const std::string far_bridge = outer + inner + "f 1 2 3 4 1 8 7 6 5 8\n";
    const std::string both = outer + two + "f 1 5 8 7 6 5 1 2 9 12 11 10 9 2 3 4\n";
    const std::string clockwise = outer + inner + "f 5 6 7 8 5 1 4 3 2 1\n";
    const Case cases[] = {{"one", one.c_str(), 12},
                          {"other start", other_start.c_str(), 12},
                          {"far bridge", far_bridge.c_str(), 12},
                          {"two", both.c_str(), 13},
                          {"clockwise", clockwise.c_str(), 12}};
    for (const Case& c : cases) EXPECT_NEAR(area_mm2(load(c.text).mesh), c.area, 1e-5) << c.name;
}

TEST(ForeignObj, several_libraries_may_be_on_one_line_and_have_blanks_in_their_names) {
    struct Case {
        std::string line;
        std::vector<std::string> names;
    };
    const Case cases[] = {{"a.mtl b.mtl", {"a.mtl", "b.mtl"}},
                          {"my head.mtl", {"my head.mtl"}},
                          {"my head.MTL\tother one.mtl", {"my head.MTL", "other one.mtl"}},
                          {"v1.mtl.backup.mtl", {"v1.mtl.backup.mtl"}},
                          {"materials", {"materials"}},
                          {"a.mtl rest", {"a.mtl", "rest"}}};
    for (const Case& c : cases) {
        std::vector<std::string> asked;
        const auto loaded =
            parse_mesh(bytes_of("mtllib " + c.line + "\n" + kTriangle), MeshFormat::obj, "a.obj",
                       [&](const std::string& path) -> Result<std::vector<std::byte>> {
                           asked.push_back(path);
                           return Error{path + ": cannot open"};
                       });
        ASSERT_TRUE(loaded);
        EXPECT_EQ(asked, c.names) << c.line;
    }
}

TEST(ForeignMtl, options_before_a_map_are_no_part_of_its_name) {
    struct Case {
        std::string line, warning;
    };
    const Case cases[] = {{"map_Kd -colorspace sRGB a b.png", ""},
                          {"map_Kd -colorspace linear a b.png", "-colorspace linear of map_kd is ignored"},
                          {"map_Kd -blendu on -mm 0 1 -clamp off a b.png", ""},
                          {"map_Kd -clamp on a b.png", ""},
                          {"map_Kd -s 1 1 1 -o 0.0 0 a b.png", ""},
                          {"map_Kd -s 4 4 a b.png", "the option -s of map_kd is ignored"},
                          {"map_Kd -mm 0.2 0.5 a b.png", "the option -mm of map_kd is ignored"},
                          {"map_Kd -boost 0 a b.png", ""},
                          {"map_Kd -boost 5 a b.png", "the option -boost of map_kd is ignored"}};
    for (const Case& c : cases) {
        const LoadedMesh loaded = with_mtl(c.line + "\n" + c.line + "\n");
        EXPECT_EQ(loaded.mesh.materials[0].base_color_map.name, "dir/a b.png") << c.line;
        const auto of_mtl = [](const std::string& warning) { return warning.starts_with("dir/m.mtl"); };
        EXPECT_EQ(std::ranges::count_if(loaded.warnings, of_mtl), c.warning.empty() ? 0 : 1) << c.line;
        if (!c.warning.empty()) {
            EXPECT_TRUE(any_contains(loaded.warnings, c.warning)) << c.line;
        }
    }
}

TEST(ForeignMtl, maps_of_the_pbr_additions_are_read) {
    const Material m =
        with_mtl("Ke 0 0 0\nPr 0\nmap_Pr r.png\nPm 0\nmap_Pm p.png\nmap_Ke e.png\nnorm -bm 0.25 n.png\n")
            .mesh.materials[0];
    EXPECT_EQ(m.roughness_map.name, "dir/r.png");
    EXPECT_EQ(m.roughness, 1) << "the map alone counts";
    EXPECT_EQ(m.metallic_map.name, "dir/p.png");
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.emission_map.name, "dir/e.png");
    EXPECT_EQ(m.emission_linear, (Vec3{1, 1, 1}));
    EXPECT_EQ(m.normal_map.name, "dir/n.png");
    EXPECT_EQ(m.normal_scale, 0.25f);
    EXPECT_EQ(with_mtl("Ke 0.5 0 0\nmap_Ke e.png\n").mesh.materials[0].emission_linear, (Vec3{0.5f, 0, 0}));
}

TEST(ForeignMtl, a_map_of_opacity_cuts_the_surface_out) {
    for (const char* text : {"map_d -imfchan m a.png\n", "d 0\nmap_d a.png\n", "map_d a.png\nTr 1\n"}) {
        const Material m = with_mtl(text).mesh.materials[0];
        EXPECT_EQ(m.alpha_map.name, "dir/a.png") << text;
        EXPECT_EQ(cutoff_of_map(m), 0.5f) << text;
        EXPECT_FALSE(m.opacity_map.present()) << "which is the colour of what passes through glass";
    }
    EXPECT_EQ(cutoff_of_map(with_mtl("d 0.5\nmap_Kd a.png\n").mesh.materials[0]), 0.5f);
    EXPECT_EQ(cutoff_of_map(with_mtl("d 0.5\n").mesh.materials[0]), 0) << "glass";
}

TEST(ForeignMtl, maps_that_are_not_used_are_named_once) {
    const LoadedMesh loaded =
        with_mtl("map_Tf m.png\nmap_Ns n.png\nmap_Ka a.png\nnewmtl other\nmap_Tf m2.png\nillum 2\n");
    EXPECT_TRUE(any_contains(loaded.warnings, "dir/m.mtl: map_tf is not used"));
    EXPECT_TRUE(any_contains(loaded.warnings, "dir/m.mtl: map_ns is not used"));
    EXPECT_FALSE(any_contains(loaded.warnings, "map_ka"));
    EXPECT_EQ(std::ranges::count_if(loaded.warnings,
                                    [](const std::string& w) { return w.find("map_tf") != w.npos; }),
              1);
}

TEST(ForeignMtl, a_channel_that_is_not_the_one_read_is_named) {
    for (const char* text :
         {"map_Pr -imfchan r a.png\n", "map_Pr -imfchan l a.png\n", "map_d -imfchan m a.png\n"})
        EXPECT_FALSE(any_contains(with_mtl(text).warnings, "-imfchan")) << text;
    for (const char* text :
         {"map_Pr -imfchan g a.png\n", "map_Pr -imfchan m a.png\n", "map_d -imfchan r a.png\n"})
        EXPECT_TRUE(any_contains(with_mtl(text).warnings, "the option -imfchan of map_")) << text;
}

TEST(ForeignMtl, a_filter_of_what_passes_through_is_named_unless_it_is_clear) {
    EXPECT_FALSE(any_contains(with_mtl("Tf 1 1 1\nTf 1.0\n").warnings, "tf"));
    for (const char* text : {"Tf 0.5 1 1\n", "Tf 0\n", "Tf spectral a.rfl\n"})
        EXPECT_TRUE(any_contains(with_mtl(text).warnings, "dir/m.mtl: tf is not used")) << text;
}

TEST(ForeignMtl, numbers_out_of_range_are_clamped_and_named_once) {
    const LoadedMesh loaded = with_mtl(
        "Kd 2 -1 1e99\nKe -5 0 1e99\nd 7\nPr nan\nPm -1\nNi 0.5\nnewmtl other\nKd 3\nKe 1 2 3\nNs -4\n");
    const Material& m = loaded.mesh.materials[0];
    EXPECT_EQ(m.base_color_linear, (Vec3{1, 0, 1}));
    EXPECT_EQ(m.emission_linear, (Vec3{0, 0, kMostEmission}));
    EXPECT_EQ(m.opacity, 1);
    EXPECT_EQ(m.roughness, Material().roughness);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.ior, Material().ior);
    for (const char* text :
         {"kd is outside of its range, 0 to 1; clamped", "ke is outside of its range, 0 to 1000; clamped",
          "d is outside of its range, 0 to 1; clamped", "pr is not a number; not used",
          "pm is outside of its range, 0 to 1; clamped", "ni is below 1; not used",
          "ns is below 0; read as 0"})
        EXPECT_EQ(std::ranges::count(loaded.warnings, std::string("dir/m.mtl: ") + text), 1) << text;
    EXPECT_TRUE(any_contains(with_mtl("Kd spectral a.rfl\n").warnings, "kd is not a number; not used"));
    EXPECT_TRUE(with_mtl("Kd 0.5\nKe 12 0 0\nNs 1000\nNi 1.45\nd 1\nTr 0\nPr 0.5\nPm 0\n").warnings ==
                with_mtl("").warnings)
        << "in range";
}
