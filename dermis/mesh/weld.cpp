#include "dermis/mesh/weld.h"

#include <algorithm>
#include <bit>

namespace dermis::inline mesh {
namespace {

constexpr uint32_t kEmpty = ~0u;

uint64_t hash_words(std::span<const uint32_t> words) {
    uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const uint32_t word : words) {
        hash = (hash ^ word) * 0xff51afd7ed558ccdu;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

uint32_t weld_key(float value) {
    return std::bit_cast<uint32_t>(value == 0 ? 0.0f : value);
}

Weld weld_records(std::span<const uint32_t> words, size_t width) {
    const size_t count = words.size() / width;
    Weld weld;
    weld.ids.resize(count);
    // Open addressing at a load of at most one half; slots hold ids.
    std::vector<uint32_t> slots(std::bit_ceil(std::max<size_t>(16, count * 2)), kEmpty);
    const size_t mask = slots.size() - 1;
    for (size_t i = 0; i < count; ++i) {
        const auto record = words.subspan(i * width, width);
        size_t slot = hash_words(record) & mask;
        while (slots[slot] != kEmpty &&
               !std::ranges::equal(record, words.subspan(weld.first[slots[slot]] * width, width)))
            slot = (slot + 1) & mask;
        if (slots[slot] == kEmpty) {
            slots[slot] = weld.count();
            weld.first.push_back(uint32_t(i));
        }
        weld.ids[i] = slots[slot];
    }
    return weld;
}

Weld weld_positions(std::span<const Vec3> positions) {
    std::vector<uint32_t> words;
    words.reserve(positions.size() * 3);
    for (const Vec3& p : positions)
        for (const float value : {p.x, p.y, p.z}) words.push_back(weld_key(value));
    return weld_records(words, 3);
}

}  // namespace dermis::inline mesh
