#include <windows.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "dermis/base/file.h"
#include "dermis/base/system/system.h"

namespace dermis::inline base::system {
namespace fs = std::filesystem;
namespace {

// A program that reads the target, and every virus scanner, keeps it from being replaced for a moment.
constexpr int kReplaceAttempts = 50;
constexpr DWORD kReplaceWait_ms = 20;
// ReadFile() and WriteFile() count in 32 bits.
constexpr size_t kMostBytesAtOnce = size_t{1} << 30;

std::error_code last_error() {
    return {int(::GetLastError()), std::system_category()};
}

Error last_reason() {
    return Error{last_error().message()};
}

struct Handle {
    HANDLE handle = INVALID_HANDLE_VALUE;
    ~Handle() {
        if (handle != INVALID_HANDLE_VALUE) ::CloseHandle(handle);
    }
};

void (*g_clean_up)() noexcept = nullptr;

// Called on a thread of its own. FALSE: the next handler, which ends the program, is called too.
BOOL WINAPI clean_up_on_control(DWORD) {
    g_clean_up();
    return FALSE;
}

}  // namespace

InputFile::~InputFile() {
    if (handle_ != -1) ::CloseHandle(reinterpret_cast<HANDLE>(handle_));
}

Result<void> InputFile::open(const fs::path& path) {
    constexpr DWORD kAnyShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    // FILE_FLAG_BACKUP_SEMANTICS distinguishes a directory from an unreadable file.
    const HANDLE handle = ::CreateFileW(path.c_str(), GENERIC_READ, kAnyShare, nullptr, OPEN_EXISTING,
                                        FILE_ATTRIBUTE_NORMAL | FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return last_reason();
    handle_ = reinterpret_cast<intptr_t>(handle);
    return {};
}

Result<InputFile::Kind> InputFile::kind(uint64_t& bytes) const {
    const HANDLE handle = reinterpret_cast<HANDLE>(handle_);
    if (::GetFileType(handle) != FILE_TYPE_DISK) return Kind::other;
    BY_HANDLE_FILE_INFORMATION information{};
    if (!::GetFileInformationByHandle(handle, &information)) return last_reason();
    bytes = uint64_t{information.nFileSizeHigh} << 32 | information.nFileSizeLow;
    return information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? Kind::directory : Kind::file;
}

Result<size_t> InputFile::read(std::span<std::byte> to) {
    DWORD got = 0;
    if (!::ReadFile(reinterpret_cast<HANDLE>(handle_), to.data(),
                    DWORD(std::min(to.size(), kMostBytesAtOnce)), &got, nullptr))
        return last_reason();
    return size_t{got};
}

Result<void> write_through(const fs::path& path, std::span<const std::byte> bytes) {
    Handle file{::CreateFileW(path.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL,
                              nullptr)};
    if (file.handle == INVALID_HANDLE_VALUE) return last_reason();
    while (!bytes.empty()) {
        DWORD written = 0;
        if (!::WriteFile(file.handle, bytes.data(), DWORD(std::min(bytes.size(), kMostBytesAtOnce)), &written,
                         nullptr))
            return last_reason();
        bytes = bytes.subspan(written);
    }
    // A device (NUL) has nothing to flush.
    if (::GetFileType(file.handle) == FILE_TYPE_DISK && !::FlushFileBuffers(file.handle))
        return last_reason();
    if (!::CloseHandle(std::exchange(file.handle, INVALID_HANDLE_VALUE))) return last_reason();
    return {};
}

std::error_code replace_file(const fs::path& from, const fs::path& to) noexcept {
    for (int attempt = 1;; ++attempt) {
        if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
            return {};
        const std::error_code error = last_error();
        const bool in_use = error.value() == ERROR_SHARING_VIOLATION || error.value() == ERROR_ACCESS_DENIED;
        if (!in_use || attempt == kReplaceAttempts) return error;
        ::Sleep(kReplaceWait_ms);
    }
}

void remove_file(const wchar_t* path) noexcept {
    ::DeleteFileW(path);
}

unsigned long process_id() noexcept {
    return ::GetCurrentProcessId();
}

void before_the_end(void (*clean_up)() noexcept) {
    g_clean_up = clean_up;
    ::SetConsoleCtrlHandler(clean_up_on_control, TRUE);
}

fs::path environment_path(const char* name) {
    const wchar_t* value = ::_wgetenv(fs::path(name).c_str());
    return value ? value : L"";
}

fs::path user_cache_directory() {
    const fs::path local = environment_path("LOCALAPPDATA");
    return local.empty() ? local : local / "dermis" / "cache";
}

bool stderr_is_terminal() {
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    constexpr DWORD kEscapeSequences = 0x0004;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING of Windows 10
    return ::GetConsoleMode(console, &mode) && ::SetConsoleMode(console, mode | kEscapeSequences);
}

}  // namespace dermis::inline base::system

std::filesystem::path dermis::utf8_path(std::string_view name) {
    const int bytes = int(std::min<size_t>(name.size(), 1 << 20));  // no path is longer
    std::wstring wide(size_t(::MultiByteToWideChar(CP_UTF8, 0, name.data(), bytes, nullptr, 0)), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, name.data(), bytes, wide.data(), int(wide.size()));
    return wide;
}
