// What only Windows has: files that cannot be replaced while they are open, one line for all arguments.

#include <windows.h>
// After windows.h, which declares what it uses.
#include <shellapi.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/system/command_line.h"
#include "support/environment.h"
#include "support/temporary_directory.h"

namespace fs = std::filesystem;
using namespace dermis;

namespace {

HANDLE open_unshared(const fs::path& path) {
    return ::CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ, nullptr, OPEN_EXISTING, 0, nullptr);
}

}  // namespace

TEST(WindowsFile, names_are_utf_16_on_the_disk) {
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_text_file(dir.path / utf8_path("h\xc3\xa4ut.txt"), "skin"));
    EXPECT_NE(::GetFileAttributesW((dir.path / L"h\u00e4ut.txt").c_str()), INVALID_FILE_ATTRIBUTES);
}

TEST(WindowsFile, a_file_is_replaced_as_soon_as_another_program_closes_it) {
    const TemporaryDirectory dir;
    const fs::path path = dir.path / "a.txt";
    ASSERT_TRUE(write_text_file(path, "old"));
    const HANDLE reader = open_unshared(path);
    ASSERT_NE(reader, INVALID_HANDLE_VALUE);
    std::jthread closes([reader] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ::CloseHandle(reader);
    });
    const Result<void> written = write_text_file(path, "new");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(*read_text_file(path), "new");
}

TEST(WindowsFile, a_file_that_stays_open_is_kept_and_no_temporary_one_is_left) {
    const TemporaryDirectory dir;
    const fs::path path = dir.path / "a.txt";
    ASSERT_TRUE(write_text_file(path, "old"));
    const HANDLE reader = open_unshared(path);
    ASSERT_NE(reader, INVALID_HANDLE_VALUE);
    EXPECT_FALSE(write_text_file(path, "new"));
    ::CloseHandle(reader);
    EXPECT_EQ(*read_text_file(path), "old");
    EXPECT_EQ(dir.file_count(), 1u);
}

TEST(WindowsFile, devices_are_refused) {
    EXPECT_NE(read_file("NUL").error().message.find("is a pipe, device or socket"), std::string::npos);
}

TEST(WindowsCache, is_in_the_folder_of_local_data) {
    const EnvironmentVariable local("LOCALAPPDATA", "C:\\local");
    EXPECT_EQ(cache_directory(), fs::path("C:\\local\\dermis\\cache"));
}

TEST(WindowsProcess, its_status_and_its_output_come_back) {
    const TemporaryDirectory dir;
    const fs::path log = dir.path / "log";
    EXPECT_EQ(run_program({"cmd", "/c", "echo out & exit 3"}, log), 3);
    EXPECT_TRUE(read_text_file(log)->starts_with("out"));
    EXPECT_EQ(run_program({"no-such-program-of-dermis"}, log), -1);
}

TEST(WindowsProcess, a_command_line_splits_into_the_same_arguments) {
    const std::vector<std::string> arguments = {"program",   "plain", "",         "a b",
                                                "c:\\d e\\", "\"",    "x\\\"y z", "h\xc3\xa4ut"};
    int count = 0;
    wchar_t** split = ::CommandLineToArgvW(utf8_path(command_line(arguments)).c_str(), &count);
    ASSERT_NE(split, nullptr);
    ASSERT_EQ(count, int(arguments.size()));
    for (int i = 0; i < count; ++i) EXPECT_EQ(fs::path(split[i]), utf8_path(arguments[size_t(i)]));
    ::LocalFree(split);
}
