#define VOLK_IMPLEMENTATION
#include "dermis/gpu/vulkan.h"

namespace dermis::gpu {

std::string_view result_text(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of GPU memory; use a smaller size or fewer samples";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "the descriptor pool is full";
        case VK_ERROR_DEVICE_LOST:
            return "the GPU was lost (a crash or a time-out of its driver)";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "the driver failed to start";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "a layer is not installed";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "an extension is missing";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "a feature is missing";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no Vulkan driver is installed (Debian: mesa-vulkan-drivers)";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "the format is not supported";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "the window's surface was lost";
        default:
            return "";
    }
}

bool Context::can(VkFormat format, VkFormatFeatureFlags wanted) const {
    VkFormatProperties has;
    vkGetPhysicalDeviceFormatProperties(physical, format, &has);
    return (has.optimalTilingFeatures & wanted) == wanted;
}

VkResult Context::wait_for(uint64_t submission) const {
    if (submission <= submissions.known_done) return VK_SUCCESS;
    const VkSemaphoreWaitInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                      .semaphoreCount = 1,
                                      .pSemaphores = &submissions.done,
                                      .pValues = &submission};
    const VkResult result = vk.vkWaitSemaphores(device, &info, UINT64_MAX);
    if (result == VK_SUCCESS) submissions.known_done = submission;
    return result;
}

bool Context::is_done(uint64_t submission) const {
    if (submission > submissions.known_done)
        vk.vkGetSemaphoreCounterValue(device, submissions.done, &submissions.known_done);
    return submission <= submissions.known_done;
}

Result<void> check(VkResult result, std::string_view what) {
    if (result >= 0) return {};
    std::string reason(result_text(result));
    if (reason.empty()) reason = "Vulkan error " + std::to_string(int(result));
    return Error{"cannot " + std::string(what) + ": " + reason,
                 result == VK_ERROR_DEVICE_LOST ? ErrorCode::device_lost : ErrorCode::general};
}

void set_object_name(const Context& context, VkObjectType type, uint64_t handle, std::string_view name) {
    if (!context.set_name) return;
    const std::string text(name);
    const VkDebugUtilsObjectNameInfoEXT info = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                                .objectType = type,
                                                .objectHandle = handle,
                                                .pObjectName = text.c_str()};
    context.set_name(context.device, &info);
}

}  // namespace dermis::gpu
