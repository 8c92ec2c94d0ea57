#pragma once
// Loops over all cores.

#include <cstddef>
#include <functional>

namespace dermis::inline base {

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on all cores; returns when all are
/// done. `grain` is the least number of items worth a task. The split depends on the machine; results must
/// not (seed by item, sum in order). The first exception of a body ends the loop and is rethrown here; a
/// StopScope of the caller ends it between chunks (dermis/base/stop.h). Works with fewer threads if the
/// system refuses more.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

/// Whether the system can start one thread more than there are cores. Libraries and drivers with their own
/// pools abort or hang if it cannot.
[[nodiscard]] bool can_start_threads();

/// Limits later loops to this many threads (0: all cores). For tests and benchmarks.
void set_thread_limit(unsigned threads);
[[nodiscard]] unsigned thread_limit();

}  // namespace dermis::inline base
