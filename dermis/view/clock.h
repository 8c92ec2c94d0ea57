#pragma once
// The window's time.

#include <chrono>

namespace dermis::view {

class Clock {
  public:
    /// `by_frames`: a script's time goes by frames, so that it does the same on every machine.
    explicit Clock(bool by_frames) : by_frames_(by_frames) {}

    [[nodiscard]] double now_s() const { return by_frames_ ? frames_ * kScriptFrameS : elapsed_s(); }
    /// By the machine's clock, since the window was asked for.
    [[nodiscard]] double elapsed_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    }
    void end_frame() { ++frames_; }
    [[nodiscard]] int frames() const { return frames_; }

  private:
    static constexpr double kScriptFrameS = 1.0 / 30;

    bool by_frames_;
    int frames_ = 0;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace dermis::view
