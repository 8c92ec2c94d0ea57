// Small figures: the pictures of cells, the numbers below them, and the errors of wrong figures.

#include "dermis/report/figures.h"

#include <algorithm>

#include "dermis/plot/sheet.h"
#include "support/built_in.h"
#include "support/gpu_fixture.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

constexpr int kSize = 32;

class Figures : public gpu::GpuTest {
  protected:
    Figures() : font_(std::move(*Font::load())), renderer_(device(), built_in_catalog(), {.samples = 1}) {}

    Result<FigureResult> draw(const Figure& figure) { return draw_figure(renderer_, font_, figure, kSize); }
    std::string error(const Figure& figure) {
        const Result<FigureResult> result = draw(figure);
        return result ? "" : result.error().message;
    }

    Font font_;
    CellRenderer renderer_;
};

FigureCell sphere(std::string label, std::string technique) {
    return {.label = label,
            .id = label,
            .technique = std::move(technique),
            .view = "diffuse",
            .object = "sphere_2mm"};
}

Figure figure_of(std::vector<FigureCell> cells) {
    return {.id = "f",
            .title = "t",
            .source = "s",
            .scene = "builtin:spheres",
            .technique = "lambert",
            .rows = {{.label = "", .cells = std::move(cells)}}};
}

FigureCell grey(std::string label, float value) {
    return {.label = label,
            .id = label,
            .kind = CellKind::computed,
            .compute = [value](const SkinContext&, int, int) -> Result<FigurePicture> {
                return FigurePicture{1, 1, {value, value, value}};
            }};
}

}  // namespace

TEST_F(Figures, put_the_difference_of_two_cells_below) {
    FigureCell again = sphere("again", "lambert"), skin = sphere("skin", "preintegrated");
    again.compare_to = skin.compare_to = "first";
    const Result<FigureResult> result = draw(figure_of({sphere("first", "lambert"), again, skin}));
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->cells[0].compared_to, "");
    EXPECT_EQ(result->cells[1].compared_to, "first");
    EXPECT_EQ(result->cells[1].difference.max_abs, 0);
    EXPECT_EQ(result->cells[1].difference.flip, 0);
    EXPECT_GT(result->cells[2].difference.mean_abs, 0.01);
    EXPECT_GT(result->cells[2].difference.flip, 0.01);
}

TEST_F(Figures, compare_what_the_numbers_say) {
    const FigureCell dark = grey("dark", 0.25f);
    FigureCell light = grey("light", 0.75f);
    light.compare_to = "dark";
    const Result<FigureResult> result = draw(figure_of({dark, light}));
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_NEAR(result->cells[1].difference.mean_abs, 0.5, 1e-6);
    EXPECT_NEAR(result->cells[1].difference.max_abs, 0.5, 1e-6);
}

TEST_F(Figures, show_numbers_encoded_or_as_they_are) {
    FigureCell linear = grey("linear", 0.25f), encoded = linear;
    linear.encoding = CellEncoding::linear;
    const Figure figure = figure_of({});
    EXPECT_NEAR(renderer_.draw(figure, linear, {4, 4})->display.at(1, 1, 1), 0.25, 0.003);
    EXPECT_NEAR(renderer_.draw(figure, encoded, {4, 4})->display.at(1, 1, 1), 0.537, 0.003);
}

TEST_F(Figures, magnify_a_difference_cell) {
    FigureCell difference = {
        .label = "difference", .kind = CellKind::difference, .subject = "b", .compare_to = "a", .gain = 4};
    const Result<FigureResult> result = draw(figure_of({grey("a", 0.25f), grey("b", 0.35f), difference}));
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_NEAR(result->cells[2].difference.mean_abs, 0.1, 1e-6);
    // The third cell's middle: 0.1 four times.
    const Image& sheet = result->sheet;
    bool found = false;
    for (int y = 0; y < sheet.height && !found; ++y)
        found = std::abs(sheet.at(12 + 2 * (kSize + 8) + kSize / 2, y, 0) - 0.4f) < 0.005f;
    EXPECT_TRUE(found);
}

TEST_F(Figures, are_drawn_without_albedo_and_in_another_environment) {
    FigureCell mapped = sphere("mapped", "lambert"), white = sphere("white", "lambert"),
               elsewhere = sphere("elsewhere", "lambert"), dark = sphere("dark", "lambert");
    white.albedo = CellAlbedo::white;
    elsewhere.environment = "assets:no/such.hdr";
    dark.environment = "none";
    const Figure figure = figure_of({});
    const auto middle = [&](const FigureCell& cell) {
        const Result<CellPicture> picture = renderer_.draw(figure, cell, {kSize, kSize});
        EXPECT_TRUE(picture) << picture.error().message;
        return picture->radiance.at(kSize / 2, kSize / 2, 2);
    };
    EXPECT_GT(middle(white), 1.5f * middle(mapped));
    EXPECT_LT(middle(dark), middle(mapped));
    EXPECT_NE(middle(elsewhere), middle(mapped));
    EXPECT_EQ(renderer_.draw(figure, elsewhere, {8, 8})->remark, "studio turned: no such.hdr");
}

TEST_F(Figures, that_are_wrong_name_the_cell) {
    FigureCell cell = sphere("c", "lambart");
    EXPECT_THAT(error(figure_of({cell})), HasSubstr("figure 'f', cell 'c': unknown technique 'lambart'"));
    cell = sphere("c", "wrap");
    cell.settings = {{"wrap", "7"}};
    EXPECT_THAT(error(figure_of({cell})), HasSubstr("cell 'c'"));
    cell = sphere("c", "lambert");
    cell.compare_to = "nobody";
    EXPECT_THAT(error(figure_of({cell})), HasSubstr("names 'nobody', which no cell before it is"));
    cell.compare_to = "";
    cell.object = "cube";
    EXPECT_THAT(error(figure_of({cell})), HasSubstr("no object 'cube'"));
    FigureCell table = {.label = "t", .kind = CellKind::table, .table = "no_table"};
    EXPECT_THAT(error(figure_of({table})), HasSubstr("lambert bakes no tables"));
    table.technique = "preintegrated";
    EXPECT_THAT(error(figure_of({table})), HasSubstr("preintegrated bakes no table 'no_table'"));
}

TEST_F(Figures, of_every_technique_can_be_drawn) {
    for (const Technique& technique : built_in_catalog().techniques) {
        if (!technique.figures) continue;
        const Result<std::vector<Figure>> figures = figures_of(technique);
        ASSERT_TRUE(figures) << figures.error().message;
        CellRenderer spheres(device(), built_in_catalog(), {.scene = "builtin:spheres", .samples = 1});
        for (const Figure& figure : *figures) {
            const Result<FigureResult> result = draw_figure(spheres, font_, figure, 16);
            EXPECT_TRUE(result) << result.error().message;
        }
    }
}

// A figure of with and without whose pictures agree shows nothing.
TEST_F(Figures, of_texture_space_show_what_they_are_about) {
    for (const char* id :
         {"kernel_ear", "specular_shadow", "translucent_shadow", "blur", "dilation", "seams"}) {
        const auto figures = figures_of(built_in_technique("texture_space"), id);
        ASSERT_TRUE(figures);
        const Result<FigureResult> result = draw_figure(renderer_, font_, figures->front(), 64);
        ASSERT_TRUE(result) << result.error().message;
        double most = 0;
        for (const CellReport& cell : result->cells)
            if (!cell.compared_to.empty()) {
                EXPECT_GT(cell.difference.flip, 0.005) << id << ", " << cell.label;
                most = std::max(most, cell.difference.flip);
            }
        EXPECT_GT(most, 0.010) << id;
    }
}

TEST(FiguresOf, a_technique_are_found_by_id) {
    EXPECT_EQ(figures_of(built_in_technique("lambert")).error().message,
              "technique 'lambert' has no figures");
    const Technique& technique = built_in_technique("preintegrated");
    EXPECT_EQ(figures_of(technique, "normals")->size(), 1u);
    EXPECT_THAT(figures_of(technique, "nromals").error().message, HasSubstr("did you mean 'normals'?"));
}

TEST(Sheet, grows_with_its_cells_and_its_words) {
    const Font font = std::move(*Font::load());
    const SheetCell cell = {.label = "a", .picture = Image(200, 50, 3, PixelFormat::u8, Encoding::srgb)};
    Sheet sheet = {.title = "title", .source = "source", .rows = {{.label = "", .cells = {cell, cell}}}};
    const Image two = compose_sheet(sheet, font);
    sheet.rows[0].cells.push_back(cell);
    const Image three = compose_sheet(sheet, font);
    EXPECT_EQ(three.width - two.width, 208);
    sheet.rows.push_back(sheet.rows[0]);
    EXPECT_GT(compose_sheet(sheet, font).height, three.height + 50);
    sheet.credits = {"somebody"};
    sheet.rows[0].cells[0].beneath = "a number that takes more than one line of two hundred pixels";
    EXPECT_GT(compose_sheet(sheet, font).height, three.height + 100);
}
