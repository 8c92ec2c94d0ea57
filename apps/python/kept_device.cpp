#include "kept_device.h"

#include <unistd.h>

#include <memory>

namespace dermis::python {
namespace {

struct KeptDevice {
    std::mutex mutex;
    std::string name_contains;
    pid_t process = 0;
    std::unique_ptr<gpu::Device> device;
};

KeptDevice& kept_device() {
    static KeptDevice kept;
    return kept;
}

// A process that was forked has no threads of the driver: it leaves the device it inherited.
void leave_inherited(KeptDevice& kept) {
    if (kept.process != getpid()) (void)kept.device.release();
}

}  // namespace

Result<LentDevice> lend_device(const std::string& name_contains) {
    KeptDevice& kept = kept_device();
    std::unique_lock lock(kept.mutex);
    leave_inherited(kept);
    if (!kept.device || kept.name_contains != name_contains) {
        kept.device.reset();
        DERMIS_TRY_ASSIGN(gpu::Device opened, gpu::Device::create({.name_contains = name_contains}));
        kept.device = std::make_unique<gpu::Device>(std::move(opened));
        kept.name_contains = name_contains;
        kept.process = getpid();
    }
    return LentDevice(std::move(lock), *kept.device);
}

void close_kept_device() {
    KeptDevice& kept = kept_device();
    const std::lock_guard lock(kept.mutex);
    leave_inherited(kept);
    kept.device.reset();
}

}  // namespace dermis::python
