#pragma once
// How much of a comparison is done, by time: each part says what it has left, or is guessed until it begins.

#include <array>
#include <chrono>
#include <cstddef>

namespace dermis::inline judge {

class WorkEstimate {
  public:
    /// first_samples, pictures: of the first reference and of the techniques that it judges; then those of
    /// the second. frames: timed ones; unscattered: the pictures without scattering.
    enum class Part {
        first_samples,
        pictures,
        second_samples,
        second_pictures,
        frames,
        unscattered,
        references,
        judging
    };

    /// Of a part that has not begun, or that knows what it has left. References may go on between others.
    void set_left(Part part, double left_s) { left_s_[size_t(part)] = left_s; }
    /// Of a part in work that goes evenly: the parts before it have nothing left.
    void advance(Part part, double done);

    /// Share of the whole time, 0 to 1. Never falls.
    [[nodiscard]] double done();

  private:
    using Clock = std::chrono::steady_clock;
    void begin(Part part);

    std::array<double, size_t(Part::judging) + 1> left_s_{};
    Part current_ = Part::first_samples;
    Clock::time_point start_ = Clock::now(), part_start_ = start_;
    double most_ = 0;
};

}  // namespace dermis::inline judge
