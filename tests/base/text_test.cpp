#include "dermis/base/text.h"

#include <gtest/gtest.h>

using namespace dermis;

TEST(Texts, come_once_with_their_count) {
    const std::vector<std::string> texts = {"b", "a", "b", "b"};
    EXPECT_EQ(each_once(texts), (std::vector<std::string>{"b (3 times)", "a"}));
}

TEST(Texts, for_the_terminal_keep_their_direction) {
    EXPECT_EQ(printable_line("a\u202eb\u2066c\u2069d"), "a?b?c?d");
    EXPECT_EQ(printable_line("\u2029\u202f\u2065"), "\u2029\u202f\u2065");
}
