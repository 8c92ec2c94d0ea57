#include "calls.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "dermis/base/stop.h"
#include "dermis/base/text.h"

namespace dermis::python {
namespace {

constexpr size_t kMaxMessageBytes = 4000;  // as the command line prints
constexpr std::chrono::milliseconds kLookEvery{50};

// The work's thread tells the waiting one that it has ended.
class Finish {
  public:
    void set() {
        const std::lock_guard lock(mutex_);
        finished_ = true;
        changed_.notify_one();
    }
    bool wait() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kLookEvery, [this] { return finished_; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool finished_ = false;
};

// Ctrl-C, and the caller's own function; both throw what Python raised.
void look_at_python(const py::object& progress, double done, double& told) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none() || done == told) return;
    told = done;
    progress(done);
}

}  // namespace

Failure::Failure(const Error& error) : message_(printable_line(error.message, kMaxMessageBytes)) {}

void check(const Result<void>& result) {
    if (!result) throw Failure(result.error());
}

void run_watched(const py::object& progress, const std::function<void(Watch&)>& work) {
    if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
        throw py::type_error("progress: a function of one number, or None");
    Watch watch;
    Finish finish;
    std::exception_ptr thrown, raised;
    const auto run = [&] {
        const StopScope scope(&watch.stopped());
        try {
            work(watch);
        } catch (const Stopped&) {
        } catch (...) {
            thrown = std::current_exception();
        }
        finish.set();
    };
    double told = -1;
    {
        const py::gil_scoped_release released;
        std::thread thread;
        try {
            thread = std::thread(run);
        } catch (const std::system_error&) {
            run();  // the system gives no more threads: Ctrl-C is seen afterwards
        }
        while (!finish.wait()) {
            if (raised) continue;
            const py::gil_scoped_acquire locked;
            try {
                look_at_python(progress, watch.done(), told);
            } catch (...) {
                raised = std::current_exception();
                watch.stop();
            }
        }
        if (thread.joinable()) thread.join();
    }
    if (!raised && !thrown) look_at_python(progress, 1, told);
    if (raised) std::rethrow_exception(raised);
    if (thrown) std::rethrow_exception(thrown);
}

std::string flag_of(std::string_view name) {
    std::string flag = "--" + std::string(name);
    std::ranges::replace(flag, '_', '-');
    return flag;
}

double finite(std::string_view option, double value) {
    if (std::abs(value) <= double(std::numeric_limits<float>::max())) return value;
    throw Failure({std::string(option) + ": " + to_text(value) + " is not a finite number"});
}

}  // namespace dermis::python
