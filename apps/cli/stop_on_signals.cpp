#include "stop_on_signals.h"

#include <csignal>
#include <cstdint>
#include <ctime>

namespace dermis::cli {
namespace {

using SignalHandler = void (*)(int);

struct Watched {
    int signal;
    SignalHandler before;
};
// Ctrl-C, a request to end, a terminal or a connection that went away.
Watched g_watched[] = {{SIGINT, SIG_DFL}, {SIGTERM, SIG_DFL}, {SIGHUP, SIG_DFL}};

std::atomic<int> g_signal = 0;
std::atomic<bool> g_stop = false;
std::atomic<int64_t> g_stopped_ms = 0;

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
        for (const Watched& watched : g_watched)
            if (watched.signal == signal) std::signal(signal, watched.before);
        std::raise(signal);
    }
}

}  // namespace

StopOnSignals::StopOnSignals() {
    for (Watched& watched : g_watched) {
        watched.before = std::signal(watched.signal, stop_on_signal);
        if (watched.before == SIG_IGN) std::signal(watched.signal, SIG_IGN);  // nohup
    }
}

StopOnSignals::~StopOnSignals() {
    for (const Watched& watched : g_watched) std::signal(watched.signal, watched.before);
}

const std::atomic<bool>& stop_requested() {
    return g_stop;
}

int stopped_exit_code() {
    return 128 + g_signal;
}

}  // namespace dermis::cli
