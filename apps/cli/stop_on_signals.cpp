#include "stop_on_signals.h"

#include <csignal>
#include <cstdint>
#include <ctime>

namespace dermis::cli {
namespace {

using SignalHandler = void (*)(int);

std::atomic<int> g_signal = 0;
std::atomic<bool> g_stop = false;
std::atomic<int64_t> g_stopped_ms = 0;
SignalHandler g_interrupt_before = SIG_DFL, g_terminate_before = SIG_DFL;

// Ctrl-C or a request to end. The first signal ends the passes, the picture so far is written, then the
// program ends; one that comes later ends the program at once. `timeout`, make and shells send the same
// signal twice, to the process and to its group: what comes within a second is the first one again.
extern "C" void stop_on_signal(int signal) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const int64_t now_ms = int64_t(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
    if (!g_stop) {
        g_signal = signal;
        g_stopped_ms = now_ms;
        g_stop = true;
    } else if (now_ms > g_stopped_ms + 1000) {
        std::signal(signal, signal == SIGINT ? g_interrupt_before : g_terminate_before);
        std::raise(signal);
    }
}

}  // namespace

StopOnSignals::StopOnSignals() {
    g_interrupt_before = std::signal(SIGINT, stop_on_signal);
    g_terminate_before = std::signal(SIGTERM, stop_on_signal);
}

StopOnSignals::~StopOnSignals() {
    std::signal(SIGINT, g_interrupt_before);
    std::signal(SIGTERM, g_terminate_before);
}

const std::atomic<bool>& stop_requested() {
    return g_stop;
}

int stopped_exit_code() {
    return 128 + g_signal;
}

}  // namespace dermis::cli
