#include "dermis/reference/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "dermis/reference/picture_sums.h"
#include "dermis/reference/pixel_sampler.h"

using namespace dermis;

namespace {

std::vector<float> numbers_of_all_sizes() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-60, 22), mantissa(-1, 1);
    std::vector<float> numbers;
    for (int i = 0; i < 1000; ++i) numbers.push_back(std::exp2(exponent(random)) * mantissa(random));
    return numbers;
}

ExactSum sum_of(const std::vector<float>& numbers) {
    ExactSum sum;
    for (const float number : numbers) sum.add(number);
    return sum;
}

}  // namespace

TEST(ExactSums, order_and_grouping_change_no_bit) {
    std::vector<float> numbers = numbers_of_all_sizes();
    const ExactSum once = sum_of(numbers);
    std::mt19937 random(5);
    for (int run = 0; run < 20; ++run) {
        std::shuffle(numbers.begin(), numbers.end(), random);
        const auto middle = numbers.begin() + std::ptrdiff_t(random() % numbers.size());
        ExactSum first = sum_of({numbers.begin(), middle});
        first += sum_of({middle, numbers.end()});
        EXPECT_TRUE(first == once);
    }
    // What a sum of doubles does not do.
    double forwards = 0, backwards = 0;
    for (size_t i = 0; i < numbers.size(); ++i) {
        forwards += double(numbers[i]);
        backwards += double(numbers[numbers.size() - 1 - i]);
    }
    EXPECT_NE(forwards, backwards);
}

TEST(ExactSums, floats_from_2_to_the_minus_41_on_are_exact) {
    ExactSum sum;
    sum.add(double(kBrightest));
    sum.add(0x1.000002p-41);
    sum.add(-double(kBrightest));
    EXPECT_EQ(sum.value(), 0x1.000002p-41);
    ExactSum tiny;
    tiny.add(0x1p-65);  // half a unit, to even
    EXPECT_TRUE(tiny.is_zero());
}

TEST(ExactSums, six_floats_hold_any_sum_and_give_it_back) {
    ExactSum sum;
    for (const double value :
         {0x1.555555p60, 0x1.555555p30, -0x1.7777p10, 0x1.123456p-12, 0x1.8p-40, 0x1p-64})
        sum.add(value);
    ExactSum left = sum, back;
    int taken = 0;
    for (; !left.is_zero(); ++taken) back.add(double(left.take_float()));
    EXPECT_LE(taken, 6);
    EXPECT_GT(taken, 3);
    EXPECT_TRUE(back == sum);
}

TEST(ExactSums, value_and_remainder_have_what_a_double_does_not) {
    ExactSum sum;
    sum.add(0x1p40);
    sum.add(0x1p-40);
    EXPECT_EQ(sum.value(), 0x1p40);
    EXPECT_EQ(sum.remainder(), 0x1p-40);
}

TEST(ExactSums, small_noise_on_bright_light_has_its_variance) {
    // Samples 1700.7 +- 2^-13, blocks of four with means 1700.7 +- 2^-15 in turn.
    PixelState pixel;
    for (int i = 0; i < 4 * 15; ++i) {
        PixelSample sample;
        const float up = i % 4 != 0 ? 0 : (i / 4 % 2 == 0 ? 1.0f : -1.0f);
        sample.diffuse = Vec3{1, 1, 1} * (1700.7f + up * 0x1p-13f);
        sample.coverage = 1;
        EXPECT_EQ(pixel.add(sample), 0u);
    }
    const double expected = 0x1p-30 * (15 - 1 / 15.0) / (15 * 14);  // of the mean of 15 blocks
    EXPECT_NEAR(pixel.variance().x / expected, 1, 1e-6);
    EXPECT_NEAR(pixel.luminance_variance() / expected, 1, 0.1);
    EXPECT_EQ(pixel.mean(kRadianceSum).x, 1700.7f);
    EXPECT_EQ(pixel.mean(kCoverageSum).x, 1);
}

TEST(ExactSums, what_is_not_finite_or_too_bright_is_cut_and_counted) {
    PixelState pixel;
    PixelSample sample;
    sample.specular = {INFINITY, NAN, 1};
    EXPECT_EQ(pixel.add(sample), 4u);  // in the radiance too
    EXPECT_EQ(pixel.mean(kSpecularSum), (Vec3{kBrightest, 0, 1}));
    sample.specular = {-2 * kBrightest, 0, 0};
    EXPECT_EQ(pixel.add(sample), 2u);
}
