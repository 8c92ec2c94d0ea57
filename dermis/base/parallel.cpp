#include "dermis/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "dermis/base/stop.h"

namespace dermis::inline base {
namespace {
std::atomic<unsigned> g_limit = 0;
}

void set_thread_limit(unsigned threads) {
    g_limit = threads;
}

bool can_start_threads() {
    const size_t count = std::max(1u, std::thread::hardware_concurrency()) + size_t{1};
    std::vector<std::jthread> threads;
    std::atomic<bool> counted = false;  // all of them exist at once
    bool started = true;
    try {
        while (threads.size() < count) threads.emplace_back([&] { counted.wait(false); });
    } catch (const std::system_error&) {
        started = false;
    }
    counted = true;
    counted.notify_all();
    threads.clear();
    return started;
}

unsigned thread_limit() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    return g_limit == 0 ? cores : std::min<unsigned>(g_limit, 256);
}

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    if (count == 0) return;
    grain = std::max<size_t>(grain, 1);
    const size_t tasks = (count + grain - 1) / grain;
    const size_t threads = std::min<size_t>(thread_limit(), tasks);
    const std::atomic<bool>* stop = StopScope::flag();
    if (threads <= 1 && !stop) return body(0, count);
    // Threads take chunks by a counter, so that uneven items balance. Eight chunks per thread keep the
    // contention on the counter low.
    const size_t chunk = std::max(grain, count / (threads * 8));
    std::atomic<size_t> next = 0;
    std::once_flag first;
    std::exception_ptr thrown;
    const auto work = [&] {
        const StopScope scope(stop);  // of the thread that called
        try {
            for (size_t begin; (begin = next.fetch_add(chunk)) < count;) {
                leave_if_stopped();
                body(begin, std::min(begin + chunk, count));
            }
        } catch (...) {
            std::call_once(first, [&] { thrown = std::current_exception(); });
            next = count;
        }
    };
    {
        std::vector<std::jthread> workers;
        workers.reserve(threads);
        try {
            for (size_t i = 1; i < threads; ++i) workers.emplace_back(work);
        } catch (const std::system_error&) {  // no more threads: the existing ones do the work
        }
        work();
    }
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace dermis::inline base
