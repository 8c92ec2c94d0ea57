#pragma once
// Loops over all cores.

#include <cstddef>
#include <functional>

namespace dermis::inline base {

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on all cores; returns when all are
/// done. `grain` is the least number of items worth a task. The split depends on the machine, so a body must
/// not let its result depend on it (seed by item, sum in order). The first exception that leaves a body ends
/// the loop and is thrown again here; a StopScope of the
/// caller's leaves it between chunks (dermis/base/stop.h). Where the system gives no more threads, those that
/// there are do the work.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

/// Whether the system gives this program a thread for each core, and one more, now: libraries and drivers
/// with pools of their own end the program or wait for ever when it does not.
[[nodiscard]] bool can_start_threads();

/// At most this many threads from here on (0: all cores). For tests and benchmarks.
void set_thread_limit(unsigned threads);
[[nodiscard]] unsigned thread_limit();

}  // namespace dermis::inline base
