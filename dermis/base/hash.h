#pragma once
// Content hashes: the names of cache entries.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dermis::inline base {

/// 128-bit XXH3 of everything added, in order. Lengths are hashed too, so ("ab","c") differs from
/// ("a","bc"). Not for security. About 10 GB/s on one core.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& add(std::span<const std::byte> bytes);
    Hasher& add(std::string_view text);
    template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Hasher& add(T value) {
        return add(std::as_bytes(std::span(&value, 1)));
    }
    /// Elements must have no padding.
    template <class T>
    requires std::is_trivially_copyable_v<T> Hasher& add(const std::vector<T>& values) {
        return add(std::as_bytes(std::span(values)));
    }

    /// The hash of everything added so far, as 32 hexadecimal digits.
    [[nodiscard]] std::string hex() const;

  private:
    void* state_;
};

}  // namespace dermis::inline base
