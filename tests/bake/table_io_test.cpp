#include "dermis/bake/table_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/lut.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "support/temporary_directory.h"
#include "test_parts.h"

using namespace dermis;

namespace {

Table small_lut(TableEncoding encoding = TableEncoding::linear) {
    LutOptions lut = *lut_options("dermis");
    lut.width = 9;
    lut.height = 5;
    lut.convention.encoding = encoding;
    return *bake_lut(lut);
}

void expect_near(const Table& a, const Table& b, float tolerance) {
    ASSERT_EQ(a.data.size(), b.data.size());
    for (size_t i = 0; i < a.data.size(); ++i) EXPECT_NEAR(a.data[i], b.data[i], tolerance) << i;
}

std::string refusal(const std::filesystem::path& path, const TableUse& use = {}) {
    const Result<Table> table = read_table(path, use);
    return table ? "" : table.error().message;
}

bool ends_with(const std::string& text, std::string_view end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

}  // namespace

TEST(TableFile, every_readable_format_returns_the_table_and_its_convention) {
    struct Case {
        const char* name;
        TableStorage storage;
        TableEncoding encoding;
        float tolerance;
        bool built_in = true;
    };
    const Case cases[] = {
        {"a.exr", TableStorage::automatic, TableEncoding::linear, 3e-4f, DERMIS_WITH_EXR},
        {"b.exr", TableStorage::f32, TableEncoding::linear, 0, DERMIS_WITH_EXR},
        {"c.png", TableStorage::automatic, TableEncoding::linear, 8e-6f, DERMIS_WITH_PNG},
        {"d.png", TableStorage::u8, TableEncoding::srgb, 5e-3f, DERMIS_WITH_PNG},
        {"e.png", TableStorage::u8, TableEncoding::difference, 1.1e-3f, DERMIS_WITH_PNG},
        {"f.ktx2", TableStorage::automatic, TableEncoding::linear, 3e-4f},
        {"g.dds", TableStorage::automatic, TableEncoding::linear, 3e-4f},
        {"h.csv", TableStorage::automatic, TableEncoding::linear, 0},
    };
    const TemporaryDirectory dir;
    for (const Case& c : cases) {
        const Table table = small_lut(c.encoding);
        if (!c.built_in) {
            const Result<void> written = write_table(dir.path / c.name, table, c.storage);
            EXPECT_TRUE(written.error().message.find(" is not built in; ") != std::string::npos) << c.name;
            EXPECT_FALSE(std::filesystem::exists(dir.path / c.name));
            continue;
        }
        ASSERT_TRUE(write_table(dir.path / c.name, table, c.storage)) << c.name;
        const Result<Table> read = read_table(dir.path / c.name, {.kind = TableKind::diffuse});
        ASSERT_TRUE(read) << read.error().message;
        expect_near(*read, table, c.tolerance);
        EXPECT_EQ(convention_json(read->convention, 9, 5), convention_json(table.convention, 9, 5)) << c.name;
    }
}

TEST(TableFile, rows_lie_bottom_up_where_the_convention_says_so) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    Table table = small_lut();
    table.convention.v_origin = VOrigin::bottom;
    ASSERT_TRUE(write_table(dir.path / "a.exr", table, TableStorage::f32));
    const Image image = read_image(dir.path / "a.exr", ImageUse::data)->image;
    EXPECT_EQ(image.at(4, 4, 0), table.at(4, 0, 0));
    EXPECT_NE(image.at(4, 0, 0), table.at(4, 0, 0));
    expect_near(*read_table(dir.path / "a.exr", {}), table, 0);
}

TEST(TableFile, files_carry_their_convention_inside) {
    DERMIS_NEEDS(PNG);
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    for (const char* name : {"a.exr", "a.png", "a.ktx2"}) {
        ASSERT_TRUE(write_table(dir.path / name, small_lut()));
        ASSERT_TRUE(std::filesystem::remove(sidecar_path(dir.path / name)));
        EXPECT_TRUE(read_table(dir.path / name, {.profile = "gpu_gems_3"})) << name;
    }
}

TEST(TableFile, csv_has_the_documented_header_and_a_row_for_each_texel) {
    const std::string csv = table_csv(small_lut());
    EXPECT_TRUE(csv.starts_with("n_dot_l,curvature_per_mm,r,g,b\n-0.8888889,0.05,"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 9 * 5);
}

TEST(TableFile, the_reader_says_which_key_does_not_fit_the_use) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    const auto path = dir.path / "a.exr";
    ASSERT_TRUE(write_table(path, small_lut()));
    EXPECT_TRUE(ends_with(refusal(path, {.kind = TableKind::shadow}),
                          "a.exr: convention key 'kind' is 'diffuse', this use needs 'shadow'"));
    EXPECT_NE(refusal(path, {.v_axis = "radius_mm"}).find("'axes[1].name' is 'curvature_per_mm'"),
              std::string::npos);
    EXPECT_NE(refusal(path, {.profile = "jensen_skin1"}).find("'profile' is 'gpu_gems_3'"),
              std::string::npos);
    EXPECT_NE(refusal(path, {.construction = Construction::full_ring}).find("'construction' is 'sphere'"),
              std::string::npos);
}

TEST(TableFile, a_png_that_was_resaved_as_srgb_is_refused) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    const auto path = dir.path / "a.png";
    ASSERT_TRUE(write_table(path, small_lut(), TableStorage::u8));
    EXPECT_EQ(refusal(path), "");
    LoadedImage image = *read_image(path, ImageUse::data);
    image.image.encoding = Encoding::srgb;
    ASSERT_TRUE(write_image(path, image.image, image.text));
    EXPECT_NE(refusal(path).find("flagged sRGB, but convention key 'encoding' is 'linear'"),
              std::string::npos);
}

TEST(TableFile, missing_contradicting_and_broken_conventions_are_refused) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    const auto path = dir.path / "a.png";
    ASSERT_TRUE(write_image(path, Image(4, 4, 3, PixelFormat::u8)));
    EXPECT_NE(refusal(path).find("has no convention"), std::string::npos);
    ASSERT_TRUE(write_table(path, small_lut()));
    ASSERT_TRUE(write_text_file(sidecar_path(path), "{}"));
    EXPECT_NE(refusal(path).find("differs from the one in a.png.json"), std::string::npos);
    const auto dds = dir.path / "a.dds";
    ASSERT_TRUE(write_table(dds, small_lut()));
    ASSERT_TRUE(write_text_file(sidecar_path(dds), "{"));
    EXPECT_NE(refusal(dds).find("is not a JSON object"), std::string::npos);
    ASSERT_TRUE(write_text_file(sidecar_path(dds), convention_json(small_lut().convention, 8, 5)));
    EXPECT_NE(refusal(dds).find("9 x 5 texels, convention keys 'width' and 'height' say 8 x 5"),
              std::string::npos);
}

TEST(TableFile, what_a_format_cannot_hold_is_refused_and_nothing_is_written) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    const auto message = [&](const char* name, TableStorage storage) {
        return write_table(dir.path / name, small_lut(), storage).error().message;
    };
    EXPECT_TRUE(ends_with(message("a.exr", TableStorage::u8), "a .exr table holds half or float, not 8 bit"));
    EXPECT_TRUE(ends_with(message("a.dds", TableStorage::f32), "a .dds table holds half, not float"));
    EXPECT_NE(message("a.tga", TableStorage::automatic).find("unknown table extension '.tga'"),
              std::string::npos);
    EXPECT_NE(message("a", TableStorage::automatic).find("unknown table extension ''"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_empty(dir.path));
    EXPECT_FALSE(write_table("/proc/none/a.exr", small_lut()));
    EXPECT_NE(refusal(dir.path / "none.exr").find("none.exr"), std::string::npos);
    EXPECT_NE(refusal(dir.path / "a.h").find("is for a compiler"), std::string::npos);
}

TEST(TableFile, every_prefix_of_a_csv_and_of_a_convention_fails_cleanly) {
    const Table table = small_lut();
    const std::string csv = table_csv(table), json = convention_json(table.convention, 9, 5);
    const ParsedConvention parsed = *parse_convention(json, "a.json");
    ASSERT_TRUE(parse_table_csv(csv, parsed, "a.csv"));
    // The last digits of the last number and the newline may be missing.
    const size_t needed = csv.rfind(',') + 2;
    for (size_t i = 0; i < needed; ++i) EXPECT_FALSE(parse_table_csv(csv.substr(0, i), parsed, "a.csv")) << i;
    for (size_t i = 0; i < json.size(); ++i) EXPECT_FALSE(parse_convention(json.substr(0, i), "a.json")) << i;
}

TEST(TableFile, a_bad_csv_names_the_line_and_what_is_wrong) {
    const Table table = small_lut();
    const ParsedConvention parsed = *parse_convention(convention_json(table.convention, 9, 5), "a.json");
    const auto message = [&](std::string_view from, std::string_view to) {
        std::string csv = table_csv(table);
        csv.replace(csv.find(from), from.size(), to);
        return parse_table_csv(csv, parsed, "a.csv").error().message;
    };
    EXPECT_NE(
        message("n_dot_l,", "cosine,").find("a.csv:1: the header must be 'n_dot_l,curvature_per_mm,r,g,b'"),
        std::string::npos);
    EXPECT_NE(message("-0.8888889,", "-0.5,").find("a.csv:2: n_dot_l is -0.5, the convention puts -0.888"),
              std::string::npos);
    EXPECT_NE(message("-0.8888889,0.05,", "-0.8888889,0.05,nan").find("a.csv:2: 'nan"), std::string::npos);
    const std::string beyond_float = "-0.6666667,0.05," + std::string(60, '9');
    EXPECT_NE(message("-0.6666667,0.05,", beyond_float).find("is beyond a float"), std::string::npos);
    EXPECT_NE(message("-0.8888889,0.05,", "-0.8888889,0.05,1,").find("a.csv:2: has 6 cells, needs 5"),
              std::string::npos);
}

TEST(Convention, json_round_trips_every_kind) {
    Convention convention = small_lut().convention;
    convention.encoding = TableEncoding::range;
    convention.encoded_min = 0.75;
    convention.encoded_max = 1.05;
    convention.how = {
        .construction = Construction::half_ring, .ring_weights = RingWeights::area, .variance_scale = 1.414};
    convention.integration = Integration::unity_taps;
    convention.axes[1].warp = AxisWarp::squared;
    for (TableKind kind :
         {TableKind::diffuse, TableKind::zonal_harmonics, TableKind::beckmann, TableKind::shadow}) {
        convention.kind = kind;
        const std::string json = convention_json(convention, 9, 5);
        const Result<ParsedConvention> parsed = parse_convention(json, "a.json");
        ASSERT_TRUE(parsed) << parsed.error().message;
        EXPECT_EQ(convention_json(parsed->convention, parsed->width, parsed->height), json);
    }
}

TEST(Convention, a_wrong_value_is_named_with_its_key) {
    const std::string json = convention_json(small_lut().convention, 9, 5);
    const auto message = [&](std::string_view from, std::string_view to) {
        std::string text = json;
        text.replace(text.find(from), from.size(), to);
        return parse_convention(text, "a.json").error().message;
    };
    EXPECT_NE(message("\"linear\",\n \"constr", "\"gamma\",\n \"constr")
                  .find("key 'encoding' unknown value 'gamma'"),
              std::string::npos);
    EXPECT_NE(message("\"width\": 9", "\"width\": 0").find("key 'width' must be a number from 1 to 16384"),
              std::string::npos);
    EXPECT_NE(message("\"v_origin\"", "\"v_origins\"").find("key 'v_origin' is missing"), std::string::npos);
    EXPECT_NE(message("\"max\": 0.5", "\"max\": 0.0").find("axes[1]: convention key 'max' must differ"),
              std::string::npos);
}
