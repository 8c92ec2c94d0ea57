#include "dermis/base/stop.h"

namespace dermis::inline base {
namespace {
thread_local const std::atomic<bool>* t_flag = nullptr;
}

StopScope::StopScope(const std::atomic<bool>* flag) : before_(t_flag) {
    t_flag = flag;
}

StopScope::~StopScope() {
    t_flag = before_;
}

const std::atomic<bool>* StopScope::flag() {
    return t_flag;
}

void leave_if_stopped() {
    if (t_flag && *t_flag) throw Stopped();
}

}  // namespace dermis::inline base
