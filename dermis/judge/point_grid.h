#pragma once
// Points in cubes of the search distance: what is near lies in a cube or the 26 around it.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis::inline judge {

class PointGrid {
  public:
    PointGrid(std::vector<Vec3> points_mm, float near_mm)
        : points_mm_(std::move(points_mm)), near_mm_(near_mm) {
        for (size_t i = 0; i < points_mm_.size(); ++i)
            cells_[key(cell(points_mm_[i].x), cell(points_mm_[i].y), cell(points_mm_[i].z))].push_back(i);
    }
    [[nodiscard]] bool any_near(Vec3 p_mm) const {
        const int x = cell(p_mm.x), y = cell(p_mm.y), z = cell(p_mm.z);
        for (int i = 0; i < 27; ++i) {
            const auto found = cells_.find(key(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1));
            if (found == cells_.end()) continue;
            for (const size_t other : found->second)
                if (length(points_mm_[other] - p_mm) <= near_mm_) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] int cell(float v) const { return int(std::floor(v / near_mm_)); }
    static uint64_t key(int x, int y, int z) {
        constexpr uint64_t kMask = (1u << 21) - 1;
        return (uint64_t(x) & kMask) << 42 | (uint64_t(y) & kMask) << 21 | (uint64_t(z) & kMask);
    }
    std::vector<Vec3> points_mm_;
    float near_mm_;
    std::unordered_map<uint64_t, std::vector<size_t>> cells_;
};

}  // namespace dermis::inline judge
