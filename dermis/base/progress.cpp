#include "dermis/base/progress.h"

#include <unistd.h>

#include <cstdio>

namespace dermis {

using namespace std::chrono_literals;

Progress::Progress(std::string what, size_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::advance(size_t items) {
    const size_t done = done_.fetch_add(items) + items;
    if (!terminal_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const auto now = Clock::now();
    if (now - start_ < 1s || now - last_ < 100ms) return;
    last_ = now;
    draw(done);
}

void Progress::draw(size_t done) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const double fraction = total_ == 0 ? 1.0 : double(done) / double(total_);
    const double left_s = fraction > 0 ? elapsed_s * (1 - fraction) / fraction : 0;
    std::fprintf(stderr, "\r\x1b[K%s %3.0f %%, %.0f s left", what_.c_str(), 100 * fraction, left_s);
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace dermis
