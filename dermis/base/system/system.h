#pragma once
// Inside dermis/base only: what the operating system does, once for POSIX (posix.cpp), once for Windows
// (windows.cpp). Paths from text are UTF-8. Errors carry the system's reason alone; the callers put the path
// before it.

#include <cstddef>
#include <filesystem>
#include <span>
#include <system_error>

#include "dermis/base/result.h"

namespace dermis::inline base::system {

/// A regular file that is open for reading. Others may replace or remove the file meanwhile.
class InputFile {
  public:
    enum class Kind { file, directory, other };  ///< other: a pipe, a device or a socket

    InputFile() = default;
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Never waits, as opening a pipe would.
    [[nodiscard]] Result<void> open(const std::filesystem::path& path);
    /// Kind of the opened file. `bytes` gets its size, which is 0 for some files that have content (/proc).
    [[nodiscard]] Result<Kind> kind(uint64_t& bytes) const;
    /// How many bytes were read into `to`; 0 at the end.
    [[nodiscard]] Result<size_t> read(std::span<std::byte> to);

  private:
    intptr_t handle_ = -1;
};

/// Makes or overwrites the file; the bytes are on the disk when it returns.
[[nodiscard]] Result<void> write_through(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Renames over `to`, in one step for readers. Allocates nothing.
[[nodiscard]] std::error_code replace_file(const std::filesystem::path& from,
                                           const std::filesystem::path& to) noexcept;

/// Neither locks nor allocates.
void remove_file(const std::filesystem::path::value_type* path) noexcept;

[[nodiscard]] unsigned long process_id() noexcept;

/// Calls `clean_up` when the user or the system ends the program, then lets it end.
void before_the_end(void (*clean_up)() noexcept);

/// The environment's variable as a path; empty when it is not set.
[[nodiscard]] std::filesystem::path environment_path(const char* name);

/// Where this system keeps the caches of programs for this user, with a folder for ours; empty when unknown.
[[nodiscard]] std::filesystem::path user_cache_directory();

/// Whether standard error is a terminal that erases a line on an escape sequence.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace dermis::inline base::system
