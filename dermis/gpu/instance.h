#pragma once
// The Vulkan instance, the validation layers' messages, and which devices can run dermis.

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dermis/gpu/device.h"
#include "dermis/gpu/vulkan.h"

namespace dermis::gpu {

/// Filled by the validation layers, from any thread.
class MessageLog {
  public:
    explicit MessageLog(std::function<void(const std::string&)> on_message)
        : on_message_(std::move(on_message)) {}
    void add(std::string message);
    [[nodiscard]] std::vector<std::string> all() const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::function<void(const std::string&)> on_message_;
};

class Instance {
  public:
    /// Errors: no loader, no driver, no validation layer, a missing extension; each says what to install.
    [[nodiscard]] static Result<Instance> create(const DeviceOptions& options);
    Instance() = default;
    ~Instance();
    Instance(Instance&& other) noexcept;
    Instance& operator=(Instance&& other) noexcept;

    [[nodiscard]] VkInstance get() const { return handle_; }
    [[nodiscard]] const MessageLog& log() const { return *log_; }
    [[nodiscard]] bool has_debug_utils() const { return has_debug_utils_; }

  private:
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<MessageLog> log_;
    bool has_debug_utils_ = false;
};

struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties = {};
    DeviceInfo info;
    uint32_t queue_family = 0, timestamp_bits = 0;
    VkSampleCountFlags sample_counts = 0;
    VkPhysicalDeviceFeatures features = {};  ///< those it has
};

/// All devices, the preferred first: discrete, integrated, virtual, CPU; those that cannot run dermis last.
[[nodiscard]] Result<std::vector<PhysicalDevice>> physical_devices(const Instance& instance);

/// The requirements that a device with these format features does not meet, one text each.
[[nodiscard]] std::vector<std::string> missing_formats(
    const std::function<VkFormatFeatureFlags(VkFormat)>& features_of);

/// The first that runs dermis and whose name contains `name_contains` (any case).
[[nodiscard]] Result<PhysicalDevice> pick(std::span<const PhysicalDevice> devices,
                                          std::string_view name_contains);

}  // namespace dermis::gpu
