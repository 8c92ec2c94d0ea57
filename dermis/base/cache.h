#pragma once
// The disk cache of everything expensive, by content hash: $DERMIS_CACHE, else $XDG_CACHE_HOME/dermis, else
// ~/.cache/dermis (Windows: %LOCALAPPDATA%/dermis/cache). Deleting it is always safe. If a
// file cannot be written, the caller goes on and computes the result again next time.

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline base {

[[nodiscard]] std::filesystem::path cache_directory();

/// The bytes stored as `kind`/`hash`, or nothing. The stored file carries a checksum of its name and content:
/// damage, and another entry's content, read as absence.
[[nodiscard]] std::optional<std::vector<std::byte>> cache_load(std::string_view kind, std::string_view hash);

/// Best effort; false when nothing could be stored (a full disk, a read-only home).
bool cache_store(std::string_view kind, std::string_view hash, const std::vector<std::byte>& bytes);

/// Loads, or makes and stores. An entry of another size than `expected_bytes` is made again. For content that
/// can be wrong in other ways: cache_load, decode, and cache_store again if that fails.
[[nodiscard]] Result<std::vector<std::byte>> cached(
    std::string_view kind, std::string_view hash, size_t expected_bytes,
    const std::function<Result<std::vector<std::byte>>()>& make);

}  // namespace dermis::inline base
