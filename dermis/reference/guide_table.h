#pragma once
// Where a search in a cumulative distribution starts and ends: a table by equal steps of the value sought, so
// that mostly no step of the search is left (Chen, Asau 1974, "On generating random variates from an
// empirical distribution").

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace dermis::inline reference {

class GuideTable {
  public:
    GuideTable() = default;
    /// `values`: at least 0, not decreasing, at most 2^24.
    template <class Value>
    explicit GuideTable(const std::vector<Value>& cumulative) {
        const size_t steps = std::bit_ceil(cumulative.size());
        first_.reserve(steps + 1);
        size_t at = 0;
        for (size_t step = 0; step <= steps; ++step) {
            while (at < cumulative.size() && cumulative[at] < Value(step) / Value(steps)) ++at;
            first_.push_back(uint32_t(at));
        }
    }

    struct Range {
        size_t begin = 0, end = 0;
    };
    /// lower_bound and upper_bound of u, from 0 to less than 1, lie from begin to end, both included.
    [[nodiscard]] Range range(float u) const {
        const auto step = size_t(u * float(first_.size() - 1));  // exact, as the steps are a power of two
        return {first_[step], first_[step + 1]};
    }

  private:
    std::vector<uint32_t> first_;  // not below step / steps
};

}  // namespace dermis::inline reference
