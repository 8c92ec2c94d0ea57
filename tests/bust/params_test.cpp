#include <gtest/gtest.h>

#include <limits>

#include "subjects/bust/bust.h"

namespace dermis {
namespace {

TEST(BustParams, DefaultsAreWithinTheirRanges) {
    EXPECT_TRUE(check_bust_params({}).ok());
}

TEST(BustParams, EveryNumberIsCheckedAgainstItsRangeWithItsName) {
    for (const Parameter& row : bust_parameters().parameters)
        for (const double bad : {row.min - 1, row.max + 1, std::numeric_limits<double>::quiet_NaN()}) {
            if (row.kind == ParameterKind::integer && bad != row.min - 1) continue;  // no int32_t is beyond
            ParameterValues values(bust_parameters());
            values.put(row, {bad});
            const auto params = values.as<BustParams>();
            const Result<void> result = check_bust_params(params);
            ASSERT_FALSE(result.ok()) << row.name;
            EXPECT_NE(result.error().message.find(row.name), std::string::npos);
            EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
            EXPECT_FALSE(make_bust(params).ok());
        }
}

}  // namespace
}  // namespace dermis
