#include "dermis/gpu/device_state.h"

namespace dermis::gpu {
namespace {

struct OneTimeCommands {
    const Context& context;
    VkCommandPool pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    ~OneTimeCommands() {
        if (commands) context.vk.vkFreeCommandBuffers(context.device, pool, 1, &commands);
    }
};

Result<void> submit_and_wait(const Context& context, VkCommandBuffer commands, std::string_view name,
                             const Semaphores& semaphores) {
    const VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence handle = VK_NULL_HANDLE;
    VkResult result = context.vk.vkCreateFence(context.device, &fence_info, nullptr, &handle);
    if (Result<void> ok = check(result, "make a fence"); !ok) return ok.error();
    const OwnedFence fence(context, handle);
    const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                        .semaphore = semaphores.wait,
                                        .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
    const VkSemaphoreSubmitInfo signal = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                          .semaphore = semaphores.signal,
                                          .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                                  .waitSemaphoreInfoCount = semaphores.wait ? 1u : 0u,
                                  .pWaitSemaphoreInfos = &wait,
                                  .commandBufferInfoCount = 1,
                                  .pCommandBufferInfos = &buffer,
                                  .signalSemaphoreInfoCount = semaphores.signal ? 1u : 0u,
                                  .pSignalSemaphoreInfos = &signal};
    result = context.vk.vkQueueSubmit2(context.queue, 1, &submit, handle);
    if (Result<void> ok = check(result, "run " + std::string(name)); !ok) return ok.error();
    result = context.vk.vkWaitForFences(context.device, 1, &handle, VK_TRUE, UINT64_MAX);
    return check(result, "finish " + std::string(name));
}

}  // namespace

Result<void> run_once(Device::State& state, std::string_view name,
                      const std::function<void(VkCommandBuffer)>& record, const Semaphores& semaphores) {
    const Context& context = state.context;
    OneTimeCommands once{context, state.uploads.get()};
    const VkCommandBufferAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = once.pool,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  .commandBufferCount = 1};
    VkResult result = context.vk.vkAllocateCommandBuffers(context.device, &allocate, &once.commands);
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    if (result == VK_SUCCESS) result = context.vk.vkBeginCommandBuffer(once.commands, &begin);
    if (Result<void> ok = check(result, "record " + std::string(name)); !ok) return ok.error();
    record(once.commands);
    result = context.vk.vkEndCommandBuffer(once.commands);
    if (Result<void> ok = check(result, "record " + std::string(name)); !ok) return ok.error();
    return submit_and_wait(context, once.commands, name, semaphores);
}

}  // namespace dermis::gpu
