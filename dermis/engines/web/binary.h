#pragma once
// scene.bin: what the page hands to the GPU as it is. Internal to dermis/engines.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis::inline engines::web {

/// Little-endian values, one behind the other.
class Binary {
  public:
    /// Where the next value will be; blocks begin at a multiple of four.
    [[nodiscard]] size_t begin_block() {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return bytes_.size();
    }
    template <class T>
    void put(T value) {
        const size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &value, sizeof(T));
    }
    [[nodiscard]] std::vector<std::byte> finish() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

/// Three colours in 32 bits: mantissas of 9 bits under one exponent (EXT_texture_shared_exponent). Error at
/// most 0.2 % of the largest channel; negative channels count as 0.
[[nodiscard]] uint32_t shared_exponent(Vec3 color_linear);

}  // namespace dermis::inline engines::web
