#pragma once
// Ctrl-C or a request to end, for commands that have something to finish first.

#include <atomic>

namespace dermis::cli {

/// While an object exists, the first SIGINT, SIGTERM or SIGHUP only sets stop_requested(); a later one ends
/// the program at once.
class StopOnSignals {
  public:
    StopOnSignals();
    ~StopOnSignals();
    StopOnSignals(const StopOnSignals&) = delete;
    StopOnSignals& operator=(const StopOnSignals&) = delete;
};

[[nodiscard]] const std::atomic<bool>& stop_requested();
/// The exit status of a program that this signal ended.
[[nodiscard]] int stopped_exit_code();

}  // namespace dermis::cli
