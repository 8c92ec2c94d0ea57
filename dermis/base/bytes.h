#pragma once
// Values as consecutive bytes, vectors and text with their length: the content of a cache entry.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace dermis::inline base {

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto view = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), view.begin(), view.end());
}

inline void append(std::vector<std::byte>& bytes, const std::string& text) {
    append(bytes, uint64_t(text.size()));
    const auto view = std::as_bytes(std::span(text));
    bytes.insert(bytes.end(), view.begin(), view.end());
}

template <class T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& values) {
    append(bytes, uint64_t(values.size()));
    if constexpr (std::is_trivially_copyable_v<T>) {
        const auto view = std::as_bytes(std::span(values));
        bytes.insert(bytes.end(), view.begin(), view.end());
    } else {
        for (const T& value : values) append(bytes, value);
    }
}

template <class T>
[[nodiscard]] bool take(std::span<const std::byte>& bytes, T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes.size() < sizeof value) return false;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes = bytes.subspan(sizeof value);
    return true;
}

[[nodiscard]] inline bool take(std::span<const std::byte>& bytes, std::string& text) {
    uint64_t count = 0;
    if (!take(bytes, count) || count > bytes.size()) return false;
    text.assign(reinterpret_cast<const char*>(bytes.data()), count);
    bytes = bytes.subspan(count);
    return true;
}

/// Refuses bytes of another length than a vector that is not empty.
template <class T>
[[nodiscard]] bool take(std::span<const std::byte>& bytes, std::vector<T>& values) {
    uint64_t count = 0;
    if (!take(bytes, count) || (!values.empty() && count != values.size())) return false;
    constexpr bool kPlain = std::is_trivially_copyable_v<T>;
    if (count > bytes.size() / (kPlain ? sizeof(T) : sizeof count)) return false;
    values.resize(count);
    if constexpr (kPlain) {
        if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
        bytes = bytes.subspan(count * sizeof(T));
        return true;
    } else {
        return std::ranges::all_of(values, [&](T& value) { return take(bytes, value); });
    }
}

template <class... T>
[[nodiscard]] std::vector<std::byte> pack(const T&... values) {
    std::vector<std::byte> bytes;
    (append(bytes, values), ...);
    return bytes;
}

/// The inverse of pack(). Returns false if `bytes` do not hold exactly these values; some may have changed.
template <class... T>
[[nodiscard]] bool unpack(std::span<const std::byte> bytes, T&... values) {
    return (take(bytes, values) && ...) && bytes.empty();
}

}  // namespace dermis::inline base
