#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <new>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/result.h"
#include "dermis/base/shared_bytes.h"
#include "dermis/base/stop.h"
#include "dermis/base/text.h"
#include "support/environment.h"
#include "support/temporary_directory.h"

namespace fs = std::filesystem;
using namespace dermis;

TEST(Error, keeps_its_code_when_a_place_is_put_before_it) {
    const Error lost{"the GPU was lost", ErrorCode::device_lost};
    const Error placed = lost.within("script.txt:3");
    EXPECT_EQ(placed.message, "script.txt:3: the GPU was lost");
    EXPECT_EQ(placed.code, ErrorCode::device_lost);
    EXPECT_EQ(Error{"no file"}.code, ErrorCode::general);
}

TEST(SharedBytes, are_shared_by_copies_and_compared_by_value) {
    const SharedBytes bytes = {std::byte{1}, std::byte{2}}, copy = bytes;
    EXPECT_EQ(copy.span().data(), bytes.span().data());
    EXPECT_EQ(copy, SharedBytes(std::vector{std::byte{1}, std::byte{2}}));
    EXPECT_NE(copy, SharedBytes({std::byte{1}, std::byte{3}}));
    EXPECT_TRUE(SharedBytes().empty());
    EXPECT_EQ(SharedBytes(), SharedBytes(std::vector<std::byte>()));
}

TEST(Text, numbers_round_trip_in_their_shortest_form) {
    EXPECT_EQ(to_text(0.1f), "0.1");
    EXPECT_EQ(to_text(1.0 / 3.0), "0.3333333333333333");
    EXPECT_EQ(parse_number(" +0.25 "), 0.25);
    EXPECT_EQ(parse_number("1e-3"), 1e-3);
    for (const char* wrong : {"", "1,5", "1 2", "0x", "mm", "--1"})
        EXPECT_FALSE(parse_number(wrong)) << wrong;
}

TEST(Text, an_unknown_name_proposes_the_closest) {
    const std::vector<std::string> names = {"lambert", "oren_nayar", "wrap"};
    EXPECT_EQ(unknown_name("technique", "lamber", names),
              "unknown technique 'lamber'; did you mean 'lambert'? known: lambert, oren_nayar, wrap");
    EXPECT_EQ(closest_name("subsurface", names), std::nullopt);
    const std::vector<std::string> keys = {"exposure_ev", "explosion"};
    EXPECT_EQ(closest_name("exposure", keys), "exposure_ev");
    EXPECT_EQ(closest_name("wrpa", names), "wrap");
}

TEST(Text, a_printable_line_is_one_line_for_any_quoted_text) {
    struct Case {
        std::string_view text, printed;
    };
    using namespace std::string_view_literals;
    const Case cases[] = {
        {"a b", "a b"},
        {"a\nb\rc\td", "a?b?c?d"},
        {"\x1b[31mred", "?[31mred"},
        {"\x7f\0x"sv, "??x"},
        {"h\xc3\xa4ut \xe2\x82\xac \xf0\x9f\x98\x80", "h\xc3\xa4ut \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"\xc2\x9b"
         "31m",
         "?31m"},
        {"\x9b"
         "31m",
         "?31m"},
        {"\xc3", "?"},
        {"\xe2\x82", "??"},
        {"\xff\xfe", "??"}};
    for (const Case& c : cases) EXPECT_EQ(printable_line(c.text), c.printed) << c.printed;
    EXPECT_EQ(printable_line("abcdef", 3), "abc...");
    EXPECT_EQ(printable_line("ab\xc3\xa4", 3), "ab...") << "no half of a character";
    EXPECT_LT(printable_line(std::string(100000, 'x')).size(), 1100u);
}

TEST(File, names_are_utf_8) {
    const TemporaryDirectory dir;
    const fs::path folder = dir.path / utf8_path("h\xc3\xa4ut"),
                   file = folder / utf8_path("\xe7\x9a\xae\xe8\x86\x9a.txt");
    ASSERT_TRUE(write_text_file(file, "skin"));
    EXPECT_EQ(*read_text_file(file), "skin");
    EXPECT_TRUE(fs::directory_iterator(folder)->path().filename().u8string() == u8"皮膚.txt");
}

TEST(File, reading_what_is_no_file_names_the_path) {
    const TemporaryDirectory dir;
    EXPECT_NE(read_file(dir.path).error().message.find("is a directory"), std::string::npos);
    EXPECT_NE(read_file(dir.path / "none").error().message.find("none: cannot open"), std::string::npos);
}

TEST(File, writing_replaces_the_whole_file_and_leaves_no_temporary_one) {
    const TemporaryDirectory dir;
    const fs::path path = dir.path / "new" / "a.txt";
    ASSERT_TRUE(write_text_file(path, "one"));
    ASSERT_TRUE(write_text_file(path, "two"));
    EXPECT_EQ(*read_text_file(path), "two");
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST(File, a_failed_write_keeps_the_old_file_and_removes_the_new) {
    const TemporaryDirectory dir;
    const fs::path path = dir.path / "a.txt";
    ASSERT_TRUE(write_text_file(path, "old"));
    const Result<void> written = write_beside(path, [](const fs::path& temporary) -> Result<void> {
        (void)write_text_file(temporary, "half");
        return Error{"the disk is full"};
    });
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("the disk is full"), std::string::npos);
    EXPECT_EQ(*read_text_file(path), "old");
    EXPECT_EQ(dir.file_count(), 1u);
}

TEST(Hash, depends_on_content_and_on_where_parts_end) {
    EXPECT_EQ(Hasher().add("ab").hex(), Hasher().add("ab").hex());
    EXPECT_NE(Hasher().add("ab").add("c").hex(), Hasher().add("a").add("bc").hex());
    EXPECT_EQ(Hasher().hex().size(), 32u);
}

TEST(Cache, returns_what_was_stored_and_nothing_from_a_damaged_file) {
    const TemporaryDirectory dir;
    const EnvironmentVariable cache("DERMIS_CACHE", dir.path.string());
    const std::vector<std::byte> bytes = {std::byte{1}, std::byte{2}, std::byte{3}};
    EXPECT_FALSE(cache_load("kind", "hash"));
    ASSERT_TRUE(cache_store("kind", "hash", bytes));
    EXPECT_EQ(cache_load("kind", "hash"), bytes);

    std::vector<std::byte> damaged = *read_file(dir.path / "kind" / "hash");
    damaged[1] = std::byte{9};
    ASSERT_TRUE(write_file(dir.path / "kind" / "hash", damaged));
    EXPECT_FALSE(cache_load("kind", "hash"));
}

TEST(Cache, an_entry_under_anothers_name_is_made_again) {
    const TemporaryDirectory dir;
    const EnvironmentVariable cache("DERMIS_CACHE", dir.path.string());
    const std::vector<std::byte> bytes(8, std::byte{1});
    ASSERT_TRUE(cache_store("kind", "one", bytes));
    ASSERT_TRUE(cache_store("other", "two", bytes));
    const auto move_here = [&](const char* from, const char* to) {
        fs::create_directories((dir.path / to).parent_path());
        fs::copy_file(dir.path / from, dir.path / to, fs::copy_options::overwrite_existing);
    };
    move_here("kind/one", "kind/two");
    move_here("kind/one", "other/one");
    EXPECT_EQ(cache_load("kind", "one"), bytes);
    EXPECT_FALSE(cache_load("kind", "two"));
    EXPECT_FALSE(cache_load("other", "one"));
}

TEST(Cache, beyond_its_limit_loses_what_was_not_used_for_longest) {
    const TemporaryDirectory dir;
    const EnvironmentVariable cache("DERMIS_CACHE", dir.path.string());
    const std::vector<std::byte> bytes(100);
    const auto age = [&](const char* name, int days) {
        fs::last_write_time(dir.path / "kind" / name,
                            fs::file_time_type::clock::now() - std::chrono::hours(24 * days + 1));
    };
    ASSERT_TRUE(cache_store("kind", "oldest", std::vector<std::byte>(300)));
    for (const char* name : {"older", "loaded", "today"}) ASSERT_TRUE(cache_store("kind", name, bytes));
    ASSERT_TRUE(write_file(dir.path / "kind" / "own_file", bytes));
    age("own_file", 9);
    age("oldest", 4);
    age("older", 3);
    age("loaded", 5);
    EXPECT_TRUE(cache_load("kind", "loaded"));

    limit_cache(10000);
    EXPECT_TRUE(fs::exists(dir.path / "kind" / "oldest")) << "the cache is smaller than that";
    limit_cache(800);
    EXPECT_FALSE(fs::exists(dir.path / "kind" / "oldest"));
    EXPECT_TRUE(fs::exists(dir.path / "kind" / "older")) << "three quarters are left";
    limit_cache(1);
    EXPECT_FALSE(fs::exists(dir.path / "kind" / "older"));
    for (const char* name : {"loaded", "today", "own_file"})
        EXPECT_TRUE(fs::exists(dir.path / "kind" / name)) << name;
}

TEST(Cache, an_entry_of_another_size_is_made_again) {
    const TemporaryDirectory dir;
    const EnvironmentVariable cache("DERMIS_CACHE", dir.path.string());
    const std::vector<int> right(8, 7);
    for (const std::vector<std::byte>& wrong :
         {std::vector<std::byte>(), pack(std::vector<int>(7)), pack(right, 1)}) {
        ASSERT_TRUE(cache_store("kind", "hash", wrong));
        int made = 0;
        const auto make = [&] { return ++made, Result(right); };
        for (int i = 0; i < 2; ++i) EXPECT_EQ(*cached("kind", "hash", std::vector<int>(8), make), right);
        EXPECT_EQ(made, 1);
    }
}

TEST(Bytes, come_back_as_they_were_and_every_prefix_is_refused) {
    const std::vector<std::vector<float>> nested = {{1, 2}, {}, {3}};
    const std::vector<std::byte> bytes = pack(7, nested, 2.5);
    int whole = 0;
    std::vector<std::vector<float>> lists;
    double real = 0;
    ASSERT_TRUE(unpack(bytes, whole, lists, real));
    EXPECT_EQ(whole, 7);
    EXPECT_EQ(lists, nested);
    EXPECT_EQ(real, 2.5);
    for (size_t size = 0; size < bytes.size(); ++size) {
        lists.clear();
        EXPECT_FALSE(unpack(std::span(bytes).first(size), whole, lists, real)) << size;
    }
}

TEST(Bytes, a_count_beyond_the_content_is_refused) {
    std::vector<int> values;
    EXPECT_FALSE(unpack(pack(uint64_t(1) << 62), values));
    std::vector<std::vector<int>> lists;
    EXPECT_FALSE(unpack(pack(uint64_t(1) << 62), lists));
}

TEST(ParallelFor, visits_every_item_once_for_any_thread_count) {
    for (unsigned threads : {1u, 2u, 7u}) {
        set_thread_limit(threads);
        std::vector<std::atomic<int>> visits(10007);
        parallel_for(visits.size(), 16, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) ++visits[i];
        });
        EXPECT_TRUE(std::ranges::all_of(visits, [](const auto& v) { return v == 1; }));
    }
    set_thread_limit(0);
    parallel_for(0, 1, [](size_t, size_t) { FAIL(); });
}

TEST(ParallelFor, passes_on_exceptions_of_its_body) {
    for (unsigned threads : {1u, 3u}) {
        set_thread_limit(threads);
        EXPECT_THROW(parallel_for(1000, 1,
                                  [](size_t begin, size_t) {
                                      if (begin >= 100 || begin == 0) throw std::bad_alloc();
                                  }),
                     std::bad_alloc);
    }
    set_thread_limit(0);
}

// On one core and on several: in the second chunk of a thread at the latest.
TEST(Stop, leaves_a_loop_between_its_chunks) {
    for (const unsigned threads : {1u, 4u}) {
        set_thread_limit(threads);
        std::atomic<bool> stop = false;
        std::atomic<size_t> chunks = 0;
        const auto body = [&](size_t, size_t) {
            stop = true;
            ++chunks;
        };
        const StopScope scope(&stop);
        EXPECT_THROW(parallel_for(1000, 1, body), Stopped);
        EXPECT_LE(chunks, threads);
    }
    set_thread_limit(0);
}

TEST(Stop, reaches_the_loops_inside_a_loop_and_ends_with_its_scope) {
    std::atomic<bool> stop = true;
    std::atomic<size_t> inner = 0;
    {
        const StopScope scope(&stop);
        EXPECT_THROW(leave_if_stopped(), Stopped);
        std::atomic<bool> other = false;
        {
            const StopScope without(&other);
            EXPECT_NO_THROW(parallel_for(8, 1, [&](size_t, size_t) {
                parallel_for(8, 1, [&](size_t begin, size_t end) { inner += end - begin; });
            }));
        }
        EXPECT_THROW(leave_if_stopped(), Stopped);
    }
    EXPECT_NO_THROW(leave_if_stopped());
    EXPECT_GT(inner, 0u);
}
