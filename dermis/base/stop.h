#pragma once
// Stops long work without results, such as loading a scene.

#include <atomic>

namespace dermis::inline base {

/// Thrown to leave stopped work. Not a std::exception, so that no other handler catches it.
struct Stopped {};

/// While it exists and `flag` is set, leave_if_stopped() throws on this thread and on those of its
/// parallel_for(). The innermost scope counts.
class StopScope {
  public:
    explicit StopScope(const std::atomic<bool>* flag);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    /// The flag of this thread; null outside every scope.
    [[nodiscard]] static const std::atomic<bool>* flag();

  private:
    const std::atomic<bool>* before_;
};

/// For long loops on one thread. parallel_for() calls it between its chunks. Throws Stopped.
void leave_if_stopped();

}  // namespace dermis::inline base
