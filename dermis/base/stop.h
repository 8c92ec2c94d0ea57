#pragma once
// Ends work that takes long and has no other way out: loading a scene, with all that it computes on the way.

#include <atomic>

namespace dermis::inline base {

/// Thrown to leave stopped work. Not a std::exception, so that no handler on the way catches it.
struct Stopped {};

/// While it exists, leave_if_stopped() throws on this thread, and on the threads of its parallel_for(), once
/// `flag` is set. Of two scopes the inner one counts.
class StopScope {
  public:
    explicit StopScope(const std::atomic<bool>* flag);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    /// The flag of this thread; null outside of every scope.
    [[nodiscard]] static const std::atomic<bool>* flag();

  private:
    const std::atomic<bool>* before_;
};

/// For loops that are long and on one thread. parallel_for() calls it between its chunks. Throws Stopped.
void leave_if_stopped();

}  // namespace dermis::inline base
