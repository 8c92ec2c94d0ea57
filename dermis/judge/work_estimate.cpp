#include "dermis/judge/work_estimate.h"

#include <algorithm>
#include <numeric>

namespace dermis::inline judge {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void WorkEstimate::begin(Part part) {
    if (part == current_) return;
    for (size_t before = 0; before < size_t(part); ++before) left_s_[before] = 0;
    current_ = part;
    part_start_ = Clock::now();
}

void WorkEstimate::advance(Part part, double done) {
    begin(part);
    // The first of a part says too little of its speed: the guess counts until a tenth is done.
    constexpr double kTrusted = 0.1;
    if (done >= kTrusted) left_s_[size_t(part)] = seconds_since(part_start_) * (1 - done) / done;
}

double WorkEstimate::done() {
    const double left_s = std::accumulate(left_s_.begin(), left_s_.end(), 0.0),
                 past_s = seconds_since(start_);
    if (past_s + left_s > 0) most_ = std::max(most_, std::min(past_s / (past_s + left_s), 1.0));
    return most_;
}

}  // namespace dermis::inline judge
