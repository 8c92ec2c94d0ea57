// The numbers of docs/sources.md are what the code computes, within half a unit of their last digit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/table.h"
#include "dermis/base/file.h"
#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/curve_2015.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "test_paths.h"

using namespace dermis;

namespace {

// Half a unit of the last digit of "0.29".
double half_a_digit(const std::string& number) {
    const size_t point = number.find('.');
    const int decimals = point == std::string::npos ? 0 : int(number.size() - point) - 1;
    return 0.5 * std::pow(10, -decimals) + 1e-9;
}

class SourcesPage : public testing::Test {
  protected:
    void SetUp() override {
        const Result<std::string> text = read_text_file(DERMIS_SOURCE_DIR "/docs/sources.md");
        ASSERT_TRUE(text);
        page_ = std::regex_replace(*text, std::regex("\\s+"), " ");
    }

    // The groups of `pattern` are numbers, in the order of `computed`.
    void expect_stated(const std::string& pattern, const std::vector<double>& computed) const {
        std::smatch match;
        ASSERT_TRUE(std::regex_search(page_, match, std::regex(pattern))) << pattern;
        ASSERT_EQ(match.size(), computed.size() + 1);
        for (size_t i = 0; i < computed.size(); ++i) {
            const std::string stated = match[i + 1];
            EXPECT_NEAR(std::stod(stated), computed[i], half_a_digit(stated)) << pattern;
        }
    }

  private:
    std::string page_;
};

const GaussianSum& skin() {
    static const GaussianSum kOfGpuGems = gpu_gems_3_skin();
    return kOfGpuGems;
}

// The largest difference in red from the sphere of 2 mm, over N.L.
template <class Light>
double difference_at_2_mm(const Light& red) {
    double largest = 0;
    for (double t = -1; t <= 1; t += 1.0 / 256)
        largest = std::max(largest, std::abs(red(t) - preintegrated_diffuse(skin(), t, 2)[0]));
    return largest;
}

}  // namespace

TEST_F(SourcesPage, states_how_far_published_constructions_are_from_the_sphere) {
    expect_stated("differs from the sphere by up to ([0-9.]+) at r = 2 mm in red",
                  {difference_at_2_mm(
                      [&](double t) { return preintegrated_diffuse(skin(), t, 2, kUnity2011Ring)[0]; })});
    expect_stated("Error against the sphere: ([0-9.]+) at r = 2 mm",
                  {difference_at_2_mm([](double t) { return curve_2015_direct(t, 0.5)[0]; })});
}

TEST_F(SourcesPage, states_the_error_of_the_closed_form) {
    double largest = 0, of_gems = 0;
    for (const std::string& name : profile_names()) {
        const GaussianSum profile = to_gaussian_sum(*find_profile(name)).sum;
        if (!check_preintegrable(profile)) continue;
        for (const Construction construction : {Construction::sphere, Construction::half_ring}) {
            const auto form = fit_curvature_expressions(profile, {.construction = construction});
            ASSERT_TRUE(form) << name;
            largest = std::max(largest, form->max_error);
            if (name == "gpu_gems_3") of_gems = std::max(of_gems, form->max_error);
        }
    }
    expect_stated(
        "Error at most ([0-9.]+), below one 8-bit code, for r ≥ 1 mm and every preset \\(([0-9.]+) for GPU "
        "Gems 3\\)",
        {largest, of_gems});
    EXPECT_LT(largest, 1.0 / 255);
}

TEST_F(SourcesPage, states_the_mean_light_of_every_construction) {
    const auto zh_0 = [](const Preintegration& how) {
        return preintegrated_zonal_harmonics(skin(), 2, how)[0][0];
    };
    expect_stated(
        "zh_0 of ([0-9.]+) in red at r = 2 mm; the half ring of `diffuse=half_ring` has ([0-9.]+), the full "
        "ring "
        "of `diffuse=full_ring` ([0-9.]+), a sphere of any radius ([0-9.]+)",
        {curve_2015_zonal(0.5)[0][0], zh_0(kUnity2011Ring), zh_0(kYeung2015Ring), zh_0({})});
}

// Towards N.H = 1 a table over N.H has no texel, and the highlight's peak is cut.
TEST_F(SourcesPage, states_what_a_beckmann_table_over_the_cosine_loses) {
    const auto table = bake_beckmann({.width = 512, .height = 512, .layout = BeckmannLayout::gems_8_bit});
    ASSERT_TRUE(table);
    const double alpha = 0.45 * 0.45, peak = beckmann(1, alpha);
    expect_stated("the peak of a highlight of roughness 0.45 is ([0-9.]+) % too dark",
                  {100 * (1 - lookup(*table, 1, alpha)[0] / peak)});
}
