#pragma once
// A progress line with an ETA for work over a second: on a terminal only, never on a pipe.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace dermis {

/// Counts finished items from any thread; draws on standard error at most ten times a second, after the first
/// second. The line is erased when the object dies.
class Progress {
  public:
    Progress(std::string what, size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(size_t items = 1);

  private:
    using Clock = std::chrono::steady_clock;
    void draw(size_t done);

    std::string what_;
    size_t total_;
    bool terminal_;
    bool drawn_ = false;
    std::atomic<size_t> done_ = 0;
    std::mutex mutex_;
    Clock::time_point start_, last_;
};

}  // namespace dermis
