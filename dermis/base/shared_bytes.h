#pragma once
// Bytes that are shared by their copies.

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace dermis::inline base {

/// Bytes that never change, such as those of an image: a copy costs a pointer. Threads may share them.
class SharedBytes {
  public:
    SharedBytes() = default;
    SharedBytes(std::vector<std::byte> bytes)
        : bytes_(std::make_shared<const std::vector<std::byte>>(std::move(bytes))) {}
    SharedBytes(std::initializer_list<std::byte> bytes) : SharedBytes(std::vector(bytes)) {}

    [[nodiscard]] std::span<const std::byte> span() const {
        return bytes_ ? std::span(*bytes_) : std::span<const std::byte>();
    }
    operator std::span<const std::byte>() const { return span(); }
    [[nodiscard]] bool empty() const { return span().empty(); }
    [[nodiscard]] size_t size() const { return span().size(); }
    std::byte operator[](size_t i) const { return span()[i]; }

    friend bool operator==(const SharedBytes& a, const SharedBytes& b) {
        return std::ranges::equal(a.span(), b.span());
    }

  private:
    std::shared_ptr<const std::vector<std::byte>> bytes_;
};

}  // namespace dermis::inline base
