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

/// The path of a name in UTF-8, which names inside of files and in arguments are. std::filesystem::path takes
/// plain text for the system's encoding, which on Windows is another one. Where bytes are not UTF-8,
/// Windows gets U+FFFD.
[[nodiscard]] std::filesystem::path utf8_path(std::string_view name);

/// Largest file any loader reads, so that a wrong path (a device, a disk image) cannot exhaust memory.
inline constexpr uint64_t kMaxFileBytes = uint64_t{2} << 30;

/// The whole file. Errors: missing, a directory, a pipe or device, unreadable, larger than kMaxFileBytes; the
/// message names the path.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path);

/// Writes beside the target (same directory, a temporary name), flushes, then renames over it; makes missing
/// directories. On failure the temporary file is removed and an existing target is untouched.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
[[nodiscard]] Result<void> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Files that are one result: all are written beside their targets before the first is renamed over its own,
/// so a full disk leaves none of them new.
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

/// Whether write_file() could write there, before hours of work: makes a file beside the target and removes
/// it again with every directory that it needed. Errors as those of write_file().
[[nodiscard]] Result<void> try_output(const std::filesystem::path& path);

/// Removes the temporary files of the functions above that exist now. For the end of a program: it may be
/// called by a signal handler, and where memory is exhausted.
void remove_temporary_files() noexcept;

/// From here on an interrupt, a hangup or a request to end removes the temporary files of the functions above
/// before the program ends. For programs, not for libraries: it replaces the handlers of these signals.
void remove_temporary_files_on_signals();

[[nodiscard]] inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace dermis::inline base
