#include "dermis/base/progress.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "dermis/base/system/system.h"

namespace dermis::inline base {

using namespace std::chrono_literals;

namespace {

std::mutex running_mutex;
std::vector<Progress*> running;  // in the order in which they began

}  // namespace

Progress::Progress(std::string what, size_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(system::stderr_is_terminal()),
      start_(Clock::now()),
      last_(start_) {
    const std::lock_guard lock(running_mutex);
    running.push_back(this);
}

Progress::~Progress() {
    {
        const std::lock_guard lock(running_mutex);
        std::erase(running, this);
    }
    erase();
}

// The line, and on a terminal the lines above it.
void Progress::erase() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
    if (terminal_ && lines_above_ > 0) std::fprintf(stderr, "\x1b[%zuA\x1b[J", lines_above_);
    drawn_ = false;
    lines_above_ = 0;
}

void Progress::print(const std::vector<std::string>& lines) {
    const std::lock_guard lock(mutex_);
    erase();
    for (const std::string& line : lines) std::fprintf(stderr, "%s\n", line.c_str());
    std::fflush(stderr);
    lines_above_ = lines.size();
}

std::optional<double> Progress::left_s() const {
    const double made = fraction_ - first_fraction_;
    if (made <= 0) return std::nullopt;
    return std::chrono::duration<double>(Clock::now() - start_).count() * (1 - fraction_) / made;
}

void Progress::advance(size_t items) {
    const size_t done = done_.fetch_add(items) + items;
    const double fraction = total_ == 0 ? 1.0 : double(done) / double(total_);
    fraction_ = fraction;
    if (!terminal_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) draw_if_due(fraction);
}

void Progress::set(double fraction, std::string_view what) {
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    if (!begun_) first_fraction_ = fraction;
    begun_ = true;
    if (!what.empty()) what_ = what;
    if (terminal_) draw_if_due(fraction);
}

void Progress::draw_if_due(double fraction) {
    const auto now = Clock::now();
    if (now - start_ < 1s || now - last_ < 100ms) return;
    last_ = now;
    draw(fraction);
}

void Progress::draw(double fraction) {
    std::fprintf(stderr, "\r\x1b[K%s", text(fraction).c_str());
    std::fflush(stderr);
    drawn_ = true;
}

std::string Progress::text(double fraction) const {
    char numbers[64];
    int length = std::snprintf(numbers, sizeof numbers, " %3.0f %%", 100 * fraction);
    if (const std::optional<double> left = left_s())
        length += std::snprintf(numbers + length, sizeof numbers - size_t(length), ", %.0f s left", *left);
    return what_ + std::string(numbers, size_t(length));
}

std::string current_progress() {
    const std::lock_guard lock(running_mutex);
    if (running.empty()) return "";
    Progress& last = *running.back();
    const std::lock_guard its_lock(last.mutex_);
    return last.text(last.fraction_);
}

}  // namespace dermis::inline base
