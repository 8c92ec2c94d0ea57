#include "dermis/reference/guide_table.h"

#include <gtest/gtest.h>

#include "dermis/rays/random.h"

namespace dermis {
namespace {

// Steps of all sizes, with values that repeat, from 0 to 1.
std::vector<double> distribution(uint32_t seed, size_t count) {
    Pcg32 random(seed, 0);
    std::vector<double> values;
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        const float u = random.next_1d();
        values.push_back(sum += u < 0.3f ? 0.0 : double(u * u * u * u));
    }
    for (double& value : values) value /= sum;
    values.back() = 1;
    return values;
}

TEST(GuideTable, a_search_within_its_range_finds_what_a_search_of_all_does) {
    for (const size_t count : {1u, 2u, 37u, 256u, 5000u}) {
        const std::vector<double> values = distribution(uint32_t(count), count);
        const GuideTable table(values);
        Pcg32 random(3, 1);
        for (int i = 0; i < 20'000; ++i) {
            const float u = i == 0    ? 0.0f
                            : i == 1  ? 0x1.fffffep-1f
                            : i < 100 ? float(i) / 128
                                      : random.next_1d();
            const auto [begin, end] = table.range(u);
            const auto lower = size_t(std::ranges::lower_bound(values, u) - values.begin());
            const auto upper = size_t(std::ranges::upper_bound(values, u) - values.begin());
            ASSERT_TRUE(begin <= lower && upper <= end) << count << " values, u " << u;
        }
    }
}

}  // namespace
}  // namespace dermis
