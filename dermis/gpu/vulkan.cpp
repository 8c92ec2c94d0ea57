#define VOLK_IMPLEMENTATION
#include "dermis/gpu/vulkan.h"

namespace dermis::gpu {
namespace {

std::string result_text(VkResult result) {
    constexpr std::pair<VkResult, const char*> kTexts[] = {
        {VK_ERROR_OUT_OF_HOST_MEMORY, "out of memory"},
        {VK_ERROR_OUT_OF_DEVICE_MEMORY, "out of GPU memory; use a smaller size or fewer samples"},
        {VK_ERROR_OUT_OF_POOL_MEMORY, "the descriptor pool is full"},
        {VK_ERROR_DEVICE_LOST, "the GPU was lost (a crash or a time-out of its driver)"},
        {VK_ERROR_INITIALIZATION_FAILED, "the driver failed to start"},
        {VK_ERROR_LAYER_NOT_PRESENT, "a layer is not installed"},
        {VK_ERROR_EXTENSION_NOT_PRESENT, "an extension is missing"},
        {VK_ERROR_FEATURE_NOT_PRESENT, "a feature is missing"},
        {VK_ERROR_INCOMPATIBLE_DRIVER,
         "no Vulkan driver works; install one (Debian: mesa-vulkan-drivers), or see "
         "with VK_LOADER_DEBUG=error why yours does not"},
        {VK_ERROR_FORMAT_NOT_SUPPORTED, "the format is not supported"},
        {VK_ERROR_SURFACE_LOST_KHR, "the window's surface was lost"}};
    for (const auto& [code, text] : kTexts)
        if (code == result) return text;
    return "Vulkan error " + std::to_string(int(result));
}

}  // namespace

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
    return Error{"cannot " + std::string(what) + ": " + result_text(result),
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
