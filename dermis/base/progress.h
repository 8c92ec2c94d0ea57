#pragma once
// A progress line with an ETA for work over a second: on a terminal only, never on a pipe. Lines above it,
// such as first results, go to a pipe too.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    /// Lines of at most 79 columns on standard error. On a terminal they take the place of those before, and
    /// the destructor erases them.
    void print(const std::vector<std::string>& lines);
    /// The estimated time to the end; nothing before it can be known.
    [[nodiscard]] std::optional<double> left_s() const;

  private:
    using Clock = std::chrono::steady_clock;
    void draw_if_due(double fraction);
    void draw(double fraction);
    void erase();

    [[nodiscard]] std::string text(double fraction) const;
    friend std::string current_progress();

    double first_fraction_ = 0;  ///< where set() began: earlier work does not measure the speed
    bool begun_ = false;

    std::string what_;
    size_t total_;
    bool terminal_;
    bool drawn_ = false;
    size_t lines_above_ = 0;
    std::atomic<size_t> done_ = 0;
    std::atomic<double> fraction_ = 0;
    std::mutex mutex_;
    Clock::time_point start_, last_;
};

/// "occlusion at the vertices  34 %, 2 s left": the work that began last in this process; empty if none is in
/// progress.
[[nodiscard]] std::string current_progress();

}  // namespace dermis::inline base
