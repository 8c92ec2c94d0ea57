// The cache beside things that are no entries.

#include "dermis/base/cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>

#include "dermis/base/text.h"
#include "support/temporary_directory.h"

using namespace dermis;

TEST(Cache, a_pipe_in_place_of_an_entry_is_neither_read_nor_written) {
    const dermis::TemporaryDirectory directory;
    ASSERT_EQ(::setenv("DERMIS_CACHE", directory.path.c_str(), 1), 0);
    std::filesystem::create_directory(directory.path / "kind");
    ASSERT_EQ(::mkfifo((directory.path / "kind/hash").c_str(), 0600), 0);
    EXPECT_FALSE(cache_load("kind", "hash"));
    EXPECT_FALSE(cache_store("kind", "hash", {std::byte{1}}));  // opening it would wait for its reader
    EXPECT_TRUE(cache_store("kind", "other", {std::byte{1}}));
    ::unsetenv("DERMIS_CACHE");
}

TEST(Texts, come_once_with_their_count) {
    const std::vector<std::string> texts = {"b", "a", "b", "b"};
    EXPECT_EQ(each_once(texts), (std::vector<std::string>{"b (3 times)", "a"}));
}

TEST(Texts, for_the_terminal_keep_their_direction) {
    EXPECT_EQ(printable_line("a\u202eb\u2066c\u2069d"), "a?b?c?d");
    EXPECT_EQ(printable_line("\u2029\u202f\u2065"), "\u2029\u202f\u2065");
}
