#include "dermis/plot/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dermis;

namespace {

size_t count(const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

Plot one_curve(std::vector<double> x, std::vector<double> y, PlotScale y_scale = PlotScale::linear) {
    Plot plot{.panels = {{.x = {.label = "x"}, .y = {.label = "y", .scale = y_scale}}}};
    plot.panels[0].series.push_back({.name = "curve", .x = std::move(x), .y = std::move(y)});
    return plot;
}

}  // namespace

TEST(Plot, text_stays_text_and_is_escaped) {
    Plot plot = one_curve({0, 1}, {0, 1});
    plot.title = "R & D <mm>";
    const std::string svg = plot_svg(plot);
    EXPECT_EQ(count(svg, "R &amp; D &lt;mm&gt;</text>"), 1u);
    EXPECT_EQ(count(svg, ">curve</text>"), 1u);
    EXPECT_EQ(svg.find("<mm>"), std::string::npos);
}

TEST(Plot, ticks_are_round_numbers) {
    const std::string svg = plot_svg(one_curve({0, 1}, {0.013, 0.9871}));
    for (const char* label : {">0.2</text>", ">0.4</text>", ">0.6</text>", ">0.8</text>", ">1</text>"})
        EXPECT_GE(count(svg, label), 1u) << label;
    EXPECT_EQ(svg.find("0.30000"), std::string::npos);
}

TEST(Plot, a_value_that_cannot_be_drawn_breaks_the_line_and_never_reaches_the_file) {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    const std::string svg = plot_svg(one_curve({0, 1, 2, 3, 4}, {1, nan, 2, inf, 3}));
    EXPECT_EQ(count(svg, "nan"), 0u);
    EXPECT_EQ(count(svg, "inf"), 0u);
    const size_t path = svg.find(" d=\"M");
    ASSERT_NE(path, std::string::npos);
    EXPECT_EQ(count(svg.substr(path, svg.find('"', path + 5) - path), "M"), 3u);
}

TEST(Plot, a_logarithmic_axis_leaves_out_what_is_not_positive) {
    const std::string svg = plot_svg(one_curve({1, 2, 3, 4}, {1, 0, -1, 100}, PlotScale::logarithmic));
    EXPECT_GE(count(svg, ">10</text>"), 1u);
    EXPECT_EQ(count(svg, "nan"), 0u);
}

TEST(Plot, empty_and_degenerate_data_still_make_a_picture) {
    for (const std::string& svg : {plot_svg({}), plot_svg(one_curve({}, {})), plot_svg(one_curve({1}, {1})),
                                   plot_svg(one_curve({0, 0}, {0, 0}, PlotScale::logarithmic))}) {
        EXPECT_TRUE(svg.ends_with("</svg>\n"));
        EXPECT_EQ(count(svg, "nan"), 0u);
    }
}

TEST(Plot, only_svg_is_written) {
    const Result<void> written = write_plot("curve.png", one_curve({0, 1}, {0, 1}));
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("curve.png"), std::string::npos);
}

TEST(Plot, leaves_out_points_on_a_straight_line_but_no_corner) {
    const auto corners = [](const std::string& svg) {
        const size_t path = svg.find(" d=\"M");
        return count(svg.substr(path, svg.find('"', path + 5) - path), "L");
    };
    std::vector<double> x, straight, bent;
    for (int i = 0; i <= 100; ++i)
        x.push_back(i), straight.push_back(2 * i), bent.push_back(std::abs(i - 50));
    EXPECT_EQ(corners(plot_svg(one_curve(x, straight))), 1u);
    EXPECT_EQ(corners(plot_svg(one_curve(x, bent))), 2u);
}
