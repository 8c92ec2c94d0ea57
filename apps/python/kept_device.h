#pragma once
// One Vulkan device for all pictures of the process: a driver keeps some of what each new one takes (lavapipe
// 37 KB).

#include <mutex>
#include <string>

#include "dermis/gpu/device.h"

namespace dermis::python {

/// The device, for one thread at a time: others wait until it is destroyed.
class LentDevice {
  public:
    LentDevice(std::unique_lock<std::mutex> lock, gpu::Device& device)
        : lock_(std::move(lock)), device_(&device) {}
    [[nodiscard]] gpu::Device& device() const { return *device_; }

  private:
    std::unique_lock<std::mutex> lock_;
    gpu::Device* device_;
};

/// The device that was lent last if the same name was asked for, otherwise a new one in its place. Errors: as
/// gpu::Device::create.
[[nodiscard]] Result<LentDevice> lend_device(const std::string& name_contains);

/// Closes it, while the driver is still loaded.
void close_kept_device();

}  // namespace dermis::python
