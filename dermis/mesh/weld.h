#pragma once
// Which of many records are the same: vertices that share a position across a UV seam, corners that share all
// attributes.

#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis::inline mesh {

struct Weld {
    std::vector<uint32_t> ids;  ///< of every record: the number of its distinct value, 0 .. first.size() - 1
    std::vector<uint32_t> first;  ///< of every distinct value: the first record that has it

    [[nodiscard]] uint32_t count() const { return uint32_t(first.size()); }
};

/// Records of `width` words each, equal when all words are. Ids follow first appearance. Linear time.
[[nodiscard]] Weld weld_records(std::span<const uint32_t> words, size_t width);

/// Exactly equal positions (-0 equals +0). Nothing is merged by distance: what a file keeps apart stays
/// apart.
[[nodiscard]] Weld weld_positions(std::span<const Vec3> positions);

/// The bits of a number as a weld key: -0 and +0 give the same.
[[nodiscard]] uint32_t weld_key(float value);

}  // namespace dermis::inline mesh
