#pragma once
// The disk cache of everything expensive, by content hash: $DERMIS_CACHE, else $XDG_CACHE_HOME/dermis, else
// ~/.cache/dermis (Windows: %LOCALAPPDATA%/dermis/cache). Deleting it is always safe. If a file cannot be
// written, the caller continues without it. The first store of a process limits it to kCacheLimitBytes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "dermis/base/bytes.h"
#include "dermis/base/result.h"

namespace dermis::inline base {

[[nodiscard]] std::filesystem::path cache_directory();

/// The bytes stored as `kind`/`hash`, or nothing. A checksum of name and content makes a damaged or renamed
/// file count as missing.
[[nodiscard]] std::optional<std::vector<std::byte>> cache_load(std::string_view kind, std::string_view hash);

/// Heads take tens of megabytes each, so that dozens of them fit.
inline constexpr uint64_t kCacheLimitBytes = uint64_t(4) << 30;

/// If the cache is larger than most_bytes, removes the least recently used entries until three quarters of
/// most_bytes are left. Keeps entries that were used within a day, because a job may need them again, and
/// files whose checksum is wrong, because they are not from this cache.
void limit_cache(uint64_t most_bytes = kCacheLimitBytes);

/// Best effort; false when nothing could be stored (a full disk, a read-only home).
bool cache_store(std::string_view kind, std::string_view hash, const std::vector<std::byte>& bytes);

/// Loads into a std::tie() of values. A vector that is not empty must have the length of the stored one.
/// Returns false if there is no such entry; some of the values may have changed then.
template <class... T>
[[nodiscard]] bool cache_load(std::string_view kind, std::string_view hash, std::tuple<T&...> values) {
    const auto bytes = cache_load(kind, hash);
    return bytes && std::apply([&](T&... value) { return unpack(*bytes, value...); }, values);
}
template <class... T>
bool cache_store(std::string_view kind, std::string_view hash, std::tuple<T&...> values) {
    return cache_store(kind, hash, std::apply([](const T&... value) { return pack(value...); }, values));
}

/// Loads a T from the cache, or makes and stores it. `parts` returns the stored members as a std::tie().
template <class T, class Make, class Parts>
[[nodiscard]] Result<T> cached(std::string_view kind, std::string_view hash, T blank, const Make& make,
                               const Parts& parts) {
    if (cache_load(kind, hash, parts(blank))) return blank;
    Result<T> made = make();
    if (made) cache_store(kind, hash, parts(*made));
    return made;
}

/// The same for a vector.
template <class T, class Make>
[[nodiscard]] Result<std::vector<T>> cached(std::string_view kind, std::string_view hash,
                                            std::vector<T> blank, const Make& make) {
    return cached(kind, hash, std::move(blank), make, [](auto& values) { return std::tie(values); });
}

}  // namespace dermis::inline base
