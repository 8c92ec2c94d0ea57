// Command buffers to the queue.

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

Result<VkCommandBuffer> allocate_commands(const Context& context, VkCommandPool pool) {
    const VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                              .commandPool = pool,
                                              .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                              .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkAllocateCommandBuffers(context.device, &info, &commands);
    DERMIS_TRY(check(result, "make a command buffer"));
    ++context.created;
    return commands;
}

Result<void> record_once(const Context& context, VkCommandBuffer commands, std::string_view name,
                         const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    VkResult result = context.vk.vkBeginCommandBuffer(commands, &begin);
    DERMIS_TRY(check(result, "record " + std::string(name)));
    record(commands);
    result = context.vk.vkEndCommandBuffer(commands);
    return check(result, "record " + std::string(name));
}

// Returns the submission's number.
Result<uint64_t> submit(const Context& context, VkCommandBuffer commands, std::string_view name,
                        const Semaphores& semaphores) {
    const uint64_t number = context.submissions.submitted + 1;
    const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                        .semaphore = semaphores.wait,
                                        .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
    const VkSemaphoreSubmitInfo signals[] = {{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = context.submissions.done,
                                              .value = number,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT},
                                             {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = semaphores.signal,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}};
    const VkSubmitInfo2 info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                                .waitSemaphoreInfoCount = semaphores.wait ? 1u : 0u,
                                .pWaitSemaphoreInfos = &wait,
                                .commandBufferInfoCount = 1,
                                .pCommandBufferInfos = &buffer,
                                .signalSemaphoreInfoCount = semaphores.signal ? 2u : 1u,
                                .pSignalSemaphoreInfos = signals};
    const VkResult result = context.vk.vkQueueSubmit2(context.queue, 1, &info, VK_NULL_HANDLE);
    DERMIS_TRY(check(result, "run " + std::string(name)));
    return context.submissions.submitted = number;
}

}  // namespace

Result<OwnedSemaphore> make_semaphore(const Context& context, VkSemaphoreType type) {
    const VkSemaphoreTypeCreateInfo kind = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                            .semaphoreType = type};
    const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &kind};
    return make<OwnedSemaphore>(context, context.vk.vkCreateSemaphore, info, "make a semaphore");
}

Result<OwnedCommandPool> make_command_pool(const Context& context, VkCommandPoolCreateFlags flags) {
    const VkCommandPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = flags,
                                          .queueFamilyIndex = context.queue_family};
    return make<OwnedCommandPool>(context, context.vk.vkCreateCommandPool, info, "make a command pool");
}

Result<ReusedCommands> ReusedCommands::create(const Context& context) {
    DERMIS_TRY_ASSIGN(OwnedCommandPool pool,
                      make_command_pool(context, VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT));
    DERMIS_TRY_ASSIGN(VkCommandBuffer commands, allocate_commands(context, pool.get()));
    ReusedCommands made;
    made.pool_ = std::move(pool);
    made.commands_ = commands;
    return made;
}

Result<void> ReusedCommands::wait(const Context& context, std::string_view name) const {
    return check(context.wait_for(submission_), "finish " + std::string(name));
}

Result<void> ReusedCommands::run(Device::State& state, std::string_view name,
                                 const std::function<void(VkCommandBuffer)>& record,
                                 const Semaphores& semaphores) {
    DERMIS_TRY(wait(state.context, name));
    DERMIS_TRY(record_once(state.context, commands_, name, record));
    DERMIS_TRY_ASSIGN(submission_, submit(state.context, commands_, name, semaphores));
    return {};
}

Result<void> run_once(Device::State& state, std::string_view name,
                      const std::function<void(VkCommandBuffer)>& record) {
    const Context& context = state.context;
    OneTimeCommands once{context, state.uploads.get()};
    DERMIS_TRY_ASSIGN(once.commands, allocate_commands(context, once.pool));
    DERMIS_TRY(record_once(context, once.commands, name, record));
    DERMIS_TRY_ASSIGN(const uint64_t number, submit(context, once.commands, name, {}));
    return check(context.wait_for(number), "finish " + std::string(name));
}

}  // namespace dermis::gpu
