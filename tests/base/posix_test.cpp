// What only POSIX has: pipes and devices in the file system, signals, fork.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "support/temporary_directory.h"

namespace fs = std::filesystem;
using namespace dermis;

TEST(Cache, a_pipe_in_place_of_an_entry_is_neither_read_nor_written) {
    const TemporaryDirectory directory;
    ASSERT_EQ(::setenv("DERMIS_CACHE", directory.path.c_str(), 1), 0);
    fs::create_directory(directory.path / "kind");
    ASSERT_EQ(::mkfifo((directory.path / "kind/hash").c_str(), 0600), 0);
    EXPECT_FALSE(cache_load("kind", "hash"));
    EXPECT_FALSE(cache_store("kind", "hash", {std::byte{1}}));  // opening it would wait for its reader
    EXPECT_TRUE(cache_store("kind", "other", {std::byte{1}}));
    ::unsetenv("DERMIS_CACHE");
}

TEST(File, pipes_and_devices_are_refused_at_once) {
    const TemporaryDirectory dir;
    ASSERT_EQ(::mkfifo((dir.path / "pipe").c_str(), 0600), 0);
    const auto message = [](const fs::path& path) {
        const auto read = read_text_file(path);
        return read ? "read it" : read.error().message;
    };
    EXPECT_NE(message(dir.path / "pipe").find("is a pipe, device or socket"), std::string::npos);
    EXPECT_NE(message("/dev/zero").find("is a pipe, device or socket"), std::string::npos);
    EXPECT_NE(message("/dev/null").find("is a pipe, device or socket"), std::string::npos);
    if (fs::exists("/proc/self/status")) {
        EXPECT_GT(read_text_file("/proc/self/status")->size(), 100u);
    }
}

TEST(File, an_interrupt_while_writing_leaves_the_old_file_and_no_temporary_one) {
    const TemporaryDirectory dir;
    const fs::path path = dir.path / "a.txt";
    ASSERT_TRUE(write_text_file(path, "old"));
    const pid_t child = ::fork();
    ASSERT_NE(child, -1);
    if (child == 0) {
        remove_temporary_files_on_signals();
        (void)write_beside(path, [](const fs::path& temporary) -> Result<void> {
            std::ofstream(temporary) << "half";
            std::raise(SIGTERM);
            return {};
        });
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
    EXPECT_EQ(*read_text_file(path), "old");
    EXPECT_EQ(dir.file_count(), 1u);
}

TEST(File, threads_that_write_while_the_program_ends_leave_no_temporary_file) {
    const TemporaryDirectory dir;
    for (int end = 0; end < 60; ++end) {
        const pid_t child = ::fork();
        ASSERT_NE(child, -1);
        if (child == 0) {
            for (int i = 0; i < 8; ++i)
                std::thread([&dir, i] {
                    for (;;) (void)write_text_file(dir.path / std::to_string(i), "whole");
                }).detach();
            ::usleep(1000);
            end_temporary_files();
            ::usleep(1000);  // what is left of a program may take as long
            ::_exit(0);
        }
        ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    }
    for (const auto& entry : fs::directory_iterator(dir.path))
        EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

TEST(File, a_full_disk_is_an_error) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_FALSE(write_text_file("/dev/full", "x"));
}

TEST(Process, its_status_and_both_outputs_come_back) {
    const TemporaryDirectory dir;
    const fs::path log = dir.path / "log";
    EXPECT_EQ(run_program({"sh", "-c", "echo \"$0\"; echo err >&2; exit 3", "a b\\\""}, log), 3);
    EXPECT_EQ(*read_text_file(log), "a b\\\"\nerr\n");
    const int none = run_program({"no-such-program-of-dermis"}, log);
    EXPECT_TRUE(none == 127 || none == -1) << none;
}
