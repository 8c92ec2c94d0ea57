#include <gtest/gtest.h>

#include <limits>

#include "dermis/bust/bust.h"

namespace dermis {
namespace {

TEST(BustParams, DefaultsAreWithinTheirRanges) {
    EXPECT_TRUE(check_bust_params({}).ok());
}

TEST(BustParams, EveryNumberIsCheckedAgainstItsRangeWithItsName) {
    for (const BustParamInfo& row : bust_param_table())
        for (const double bad : {row.least - 1, row.most + 1, std::numeric_limits<double>::quiet_NaN()}) {
            BustParams params;
            params.*row.member = bad;
            const Result<void> result = check_bust_params(params);
            ASSERT_FALSE(result.ok()) << row.name;
            EXPECT_NE(result.error().message.find(row.name), std::string::npos);
            EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
            EXPECT_FALSE(make_bust(params).ok());
        }
}

}  // namespace
}  // namespace dermis
