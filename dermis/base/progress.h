#pragma once
// A progress line with an ETA for work over a second: on a terminal only, never on a pipe.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace dermis::inline base {

/// Counts finished items from any thread; draws on standard error at most ten times a second, after the first
/// second. The destructor erases the line.
class Progress {
  public:
    Progress(std::string what, size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(size_t items = 1);
    /// For estimated work: the share that is done, 0 to 1; it may fall. `what` replaces the line's text
    /// unless it is empty. Call from one thread.
    void set(double fraction, std::string_view what = {});

  private:
    using Clock = std::chrono::steady_clock;
    void draw_if_due(double fraction);
    void draw(double fraction);

    [[nodiscard]] std::string text(double fraction) const;
    friend std::string current_progress();

    double first_fraction_ = 0;  ///< where set() began: earlier work does not measure the speed
    bool begun_ = false;

    std::string what_;
    size_t total_;
    bool terminal_;
    bool drawn_ = false;
    std::atomic<size_t> done_ = 0;
    std::atomic<double> fraction_ = 0;
    std::mutex mutex_;
    Clock::time_point start_, last_;
};

/// "occlusion at the vertices  34 %, 2 s left": the work that began last in this process; empty if none is in
/// progress.
[[nodiscard]] std::string current_progress();

}  // namespace dermis::inline base
