#pragma once
// Loops over all cores.

#include <cstddef>
#include <functional>

namespace dermis::inline base {

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on all cores; returns when all are
/// done. `grain` is the least number of items worth a task. The split depends on the machine; a result must
/// not (seed by item, sum in order). The first exception of a body ends the loop and is thrown again here; a
/// StopScope of the caller ends it between chunks (dermis/base/stop.h). Works with fewer threads if the
/// system gives no more.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

/// Whether the system gives this program a thread for each core, and one more, now: libraries and drivers
/// with pools of their own end the program or wait for ever when it does not.
[[nodiscard]] bool can_start_threads();

/// At most this many threads from here on (0: all cores). For tests and benchmarks.
void set_thread_limit(unsigned threads);
[[nodiscard]] unsigned thread_limit();

}  // namespace dermis::inline base
