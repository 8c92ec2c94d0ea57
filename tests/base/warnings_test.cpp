#include "dermis/base/warnings.h"

#include <gtest/gtest.h>

using namespace dermis;

TEST(Warnings, come_once_with_their_number_in_their_order) {
    std::vector<std::string> lines = {"b", "a", "b", "c\n", "b"};
    tidy_warnings(lines);
    EXPECT_EQ(lines, (std::vector<std::string>{"b (3 times)", "a", "c?"}));
}

TEST(Warnings, beyond_50_are_counted) {
    std::vector<std::string> lines;
    for (int i = 0; i < 20'000; ++i) lines.push_back("line " + std::to_string(i % 60));
    tidy_warnings(lines);
    ASSERT_EQ(lines.size(), 51u);
    EXPECT_EQ(lines[0], "line 0 (334 times)");
    EXPECT_EQ(lines[50], "and 10 more warnings");
}
