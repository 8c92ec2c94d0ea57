#pragma once
// How the module calls the libraries: errors become dermis.Error, Python's lock is released, and work that
// takes long can be ended with Ctrl-C.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <string_view>

#include "dermis/base/result.h"

namespace dermis::python {

namespace py = pybind11;

/// Becomes dermis.Error with the sentence that the command line prints.
class Failure : public std::exception {
  public:
    explicit Failure(const Error& error);
    [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

  private:
    std::string message_;
};

void check(const Result<void>& result);

template <class T>
T value_of(Result<T> result) {
    if (!result) throw Failure(result.error());
    return std::move(*result);
}

/// For short work on C++ values alone; other threads of Python go on meanwhile.
template <class Work>
auto unlocked(Work work) {
    const py::gil_scoped_release released;
    return work();
}

/// What work that takes long is given: it says how far it is, and asks whether to stop.
class Watch {
  public:
    void report(double done) { done_ = done; }
    [[nodiscard]] double done() const { return done_; }
    void stop() { stop_ = true; }
    [[nodiscard]] const std::atomic<bool>& stopped() const { return stop_; }

  private:
    std::atomic<double> done_ = 0;
    std::atomic<bool> stop_ = false;
};

/// Runs `work` on a thread of its own, where it may be left by Stopped (dermis/base/stop.h). This one, which
/// Python called, waits without Python's lock, looks for Ctrl-C twenty times a second and hands the progress
/// to `progress` (None or a callable of one number, 0 to 1). An exception of either stops the work, and is
/// thrown when the work has ended.
void run_watched(const py::object& progress, const std::function<void(Watch&)>& work);

/// The same for work with a result.
template <class Work>
auto watched(const py::object& progress, Work work) {
    decltype(work(std::declval<Watch&>())) result(Error{"stopped"});
    run_watched(progress, [&](Watch& watch) { result = work(watch); });
    return value_of(std::move(result));
}

/// "--penumbra-mm" of "penumbra_mm".
[[nodiscard]] std::string flag_of(std::string_view name);

/// Sets `member` where `options` has `name`. Another type is Python's TypeError; a number must be finite.
template <class T>
void take(T& member, const py::dict& options, const char* name);

/// A number as an option takes it: finite, and within the range of float. The error names `option`.
[[nodiscard]] double finite(std::string_view option, double value);

template <class T>
void take(T& member, const py::dict& options, const char* name) {
    if (!options.contains(name)) return;
    const py::object value = options[name];
    try {
        if constexpr (std::is_floating_point_v<T>)
            member = T(finite(flag_of(name), value.cast<double>()));
        else
            member = value.cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error(std::string(name) + ": " + py::repr(value).cast<std::string>() +
                             " has a type that is not taken here");
    }
}

}  // namespace dermis::python
