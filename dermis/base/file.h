#pragma once
// Files, read whole and written whole: a reader sees the old file or the new one, never half of one.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline base {

/// The path of a UTF-8 name, such as names in files and arguments. (std::filesystem::path reads plain text in
/// the system's encoding, which differs on Windows.) On Windows, bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::filesystem::path utf8_path(std::string_view name);

/// Largest file that a loader reads: a wrong path (a disk image) must not exhaust memory.
inline constexpr uint64_t kMaxFileBytes = uint64_t{2} << 30;

/// The whole file. Errors: missing, a directory, a pipe or device, unreadable, larger than kMaxFileBytes; the
/// message names the path.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path);

/// Writes beside the target (same directory, a temporary name), flushes, then renames over it; makes missing
/// directories. On failure the temporary file is removed and an existing target is untouched.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
[[nodiscard]] Result<void> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Files of one result: all are written beside their targets before the first is renamed, so a full disk
/// changes none of them.
struct FileContent {
    std::filesystem::path path;
    std::span<const std::byte> bytes;
};
[[nodiscard]] Result<void> write_files(std::span<const FileContent> files);

/// The same for libraries that can only write to a path: `write` gets the temporary path (same
/// extension as the target) and the rename follows only if it returns success.
[[nodiscard]] Result<void> write_beside(
    const std::filesystem::path& path,
    const std::function<Result<void>(const std::filesystem::path&)>& write);

/// Checks before long work that write_file() can write there: makes a file beside the target and removes it
/// with every directory that it made. Errors as write_file().
[[nodiscard]] Result<void> try_output(const std::filesystem::path& path);

/// For a program that ends now: removes the temporary files of the functions above; threads that begin to
/// write one wait for the end. Takes at most 50 ms. Safe in a signal handler and when memory is exhausted.
void end_temporary_files() noexcept;

/// Makes SIGINT, SIGHUP and SIGTERM remove the temporary files of the functions above before the program
/// ends. For programs, not for libraries: replaces the handlers of these signals.
void remove_temporary_files_on_signals();

[[nodiscard]] inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace dermis::inline base
