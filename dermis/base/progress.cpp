#include "dermis/base/progress.h"

#include <cstdio>

#include "dermis/base/system/system.h"

namespace dermis::inline base {

using namespace std::chrono_literals;

Progress::Progress(std::string what, size_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(system::stderr_is_terminal()),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::advance(size_t items) {
    const size_t done = done_.fetch_add(items) + items;
    if (!terminal_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) draw_if_due(total_ == 0 ? 1.0 : double(done) / double(total_));
}

void Progress::set(double fraction, std::string_view what) {
    if (!terminal_) return;
    const std::lock_guard lock(mutex_);
    if (!begun_) first_fraction_ = fraction;
    begun_ = true;
    if (!what.empty()) what_ = what;
    draw_if_due(fraction);
}

void Progress::draw_if_due(double fraction) {
    const auto now = Clock::now();
    if (now - start_ < 1s || now - last_ < 100ms) return;
    last_ = now;
    draw(fraction);
}

void Progress::draw(double fraction) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    std::fprintf(stderr, "\r\x1b[K%s %3.0f %%", what_.c_str(), 100 * fraction);
    const double made = fraction - first_fraction_;
    if (made > 0) std::fprintf(stderr, ", %.0f s left", elapsed_s * (1 - fraction) / made);
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace dermis::inline base
