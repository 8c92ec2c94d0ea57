#include "dermis/gpu/swapchain.h"

#include <algorithm>

#include "dermis/gpu/executor_state.h"

namespace dermis::gpu {
namespace {

using OwnedSwapchain = Owned<VkSwapchainKHR, &VolkDeviceTable::vkDestroySwapchainKHR>;

// Eight bits without conversion: the pictures are sRGB-encoded already.
Result<VkSurfaceFormatKHR> choose_format(const Context& context, VkSurfaceKHR surface) {
    for (const VkSurfaceFormatKHR& format :
         list_all<VkSurfaceFormatKHR>(vkGetPhysicalDeviceSurfaceFormatsKHR, context.physical, surface))
        if ((format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM) &&
            format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
            return format;
    return Error{"the window has no 8-bit sRGB format"};
}

VkPresentModeKHR choose_mode(const Context& context, VkSurfaceKHR surface, Pacing pacing) {
    const auto modes =
        list_all<VkPresentModeKHR>(vkGetPhysicalDeviceSurfacePresentModesKHR, context.physical, surface);
    const bool immediate = std::ranges::count(modes, VK_PRESENT_MODE_IMMEDIATE_KHR) > 0;
    return pacing == Pacing::immediate && immediate ? VK_PRESENT_MODE_IMMEDIATE_KHR
                                                    : VK_PRESENT_MODE_FIFO_KHR;
}

void barrier(const Context& context, VkCommandBuffer commands, VkImage image, VkImageLayout from,
             VkImageLayout to) {
    const bool before_copy = to == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const VkImageMemoryBarrier2 one = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .srcAccessMask = before_copy ? VkAccessFlags2{0} : VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .dstAccessMask = before_copy ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VkAccessFlags2{0},
        .oldLayout = from,
        .newLayout = to,
        .image = image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .imageMemoryBarrierCount = 1,
                                         .pImageMemoryBarriers = &one};
    context.vk.vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

struct Swapchain::State {
    Device::State& device;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    Pacing pacing = Pacing::vsync;
    VkExtent2D extent = {};
    OwnedSwapchain handle;
    std::vector<VkImage> images;
    struct Slot {
        OwnedSemaphore acquired;
        ReusedCommands commands;
    };
    std::vector<Slot> slots;  ///< of frames in flight, used in turn
    size_t next_slot = 0;
    std::vector<OwnedSemaphore> drawn;  ///< one per image: presentation may still wait for another's

    explicit State(Device::State& device_state) : device(device_state) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        device.context.vk.vkDeviceWaitIdle(device.context.device);
        handle = {};
        if (surface) vkDestroySurfaceKHR(device.context.instance, surface, nullptr);
    }

    Result<void> build(VkExtent2D wanted);
    Result<void> build_images();
    void blit(VkCommandBuffer commands, FrameImage& source, VkImage target) const;
};

Result<void> Swapchain::State::build(VkExtent2D wanted) {
    const Context& context = device.context;
    context.vk.vkDeviceWaitIdle(context.device);
    VkSurfaceCapabilitiesKHR can = {};
    const VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context.physical, surface, &can);
    DERMIS_TRY(check(result, "ask the window for its size"));
    if (!(can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
        return Error{"the window's pictures cannot be copied to"};
    DERMIS_TRY_ASSIGN(const VkSurfaceFormatKHR format, choose_format(context, surface));
    extent = can.currentExtent.width != UINT32_MAX ? can.currentExtent : wanted;
    extent.width = std::clamp(extent.width, can.minImageExtent.width, can.maxImageExtent.width);
    extent.height = std::clamp(extent.height, can.minImageExtent.height, can.maxImageExtent.height);
    const OwnedSwapchain old = std::move(handle);
    if (extent.width == 0 || extent.height == 0) return {};  // minimised: nothing to show until it is back
    const uint32_t most = can.maxImageCount ? can.maxImageCount : UINT32_MAX;
    const VkSwapchainCreateInfoKHR info = {.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                           .surface = surface,
                                           .minImageCount = std::min(can.minImageCount + 1, most),
                                           .imageFormat = format.format,
                                           .imageColorSpace = format.colorSpace,
                                           .imageExtent = extent,
                                           .imageArrayLayers = 1,
                                           .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                           .preTransform = can.currentTransform,
                                           .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
                                           .presentMode = choose_mode(context, surface, pacing),
                                           .clipped = VK_TRUE,
                                           .oldSwapchain = old.get()};
    DERMIS_TRY_ASSIGN(handle, make<OwnedSwapchain>(context, context.vk.vkCreateSwapchainKHR, info,
                                                   "make the window's pictures"));
    return build_images();
}

Result<void> Swapchain::State::build_images() {
    const Context& context = device.context;
    images = list_all<VkImage>(context.vk.vkGetSwapchainImagesKHR, context.device, handle.get());
    if (images.empty()) return Error{"cannot get the window's pictures"};
    drawn = std::vector<OwnedSemaphore>(images.size());
    slots.clear();
    for (OwnedSemaphore& semaphore : drawn) {
        DERMIS_TRY_ASSIGN(semaphore, make_semaphore(context, VK_SEMAPHORE_TYPE_BINARY));
    }
    for (size_t i = 0; i < kFramesInFlight; ++i) {
        DERMIS_TRY_ASSIGN(OwnedSemaphore acquired, make_semaphore(context, VK_SEMAPHORE_TYPE_BINARY));
        DERMIS_TRY_ASSIGN(ReusedCommands commands, ReusedCommands::create(context));
        slots.push_back({std::move(acquired), std::move(commands)});
    }
    return {};
}

void Swapchain::State::blit(VkCommandBuffer commands, FrameImage& source, VkImage target) const {
    const Context& context = device.context;
    BarrierBatch barriers;
    barriers.add(source, 0, 1, ImageUse::copy_source, false);
    barriers.record(context, commands);
    barrier(context, commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkExtent2D from = source.extent();
    const VkImageSubresourceLayers level = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit region = {.srcSubresource = level,
                                .srcOffsets = {{}, {int32_t(from.width), int32_t(from.height), 1}},
                                .dstSubresource = level,
                                .dstOffsets = {{}, {int32_t(extent.width), int32_t(extent.height), 1}}};
    const bool same_size = from.width == extent.width && from.height == extent.height;
    context.vk.vkCmdBlitImage(commands, source.image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                              target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                              same_size ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    barrier(context, commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

// Wayland gives a hidden window no picture, and an X server can lose the event that frees one.
constexpr uint64_t kAcquireLimit_ns = 3'000'000'000;

Result<Swapchain> Swapchain::create(Device& device, const SurfaceMaker& make_surface,
                                    const SwapchainOptions& options) {
    const Context& context = device.state().context;
    if (!context.vk.vkCreateSwapchainKHR)
        return Error{"this device was made without a window; give DeviceOptions the window's extensions"};
    auto state = std::make_unique<State>(device.state());
    state->pacing = options.pacing;
    state->surface = reinterpret_cast<VkSurfaceKHR>(make_surface(context.instance));
    if (!state->surface) return Error{"the window has no Vulkan surface"};
    VkBool32 supported = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(context.physical, context.queue_family, state->surface, &supported);
    if (!supported) return Error{device.info().name + " cannot show pictures in this window"};
    DERMIS_TRY(state->build({uint32_t(options.width), uint32_t(options.height)}));
    return Swapchain(std::move(state));
}

Result<void> Swapchain::resize(int width, int height) {
    return state_->build({uint32_t(std::max(width, 1)), uint32_t(std::max(height, 1))});
}

Result<Presented> Swapchain::present(Executor& executor, std::string_view name) {
    State& state = *state_;
    const Context& context = state.device.context;
    FrameImage* source = executor.state().images.find(name);
    if (!source || source->declaration.samples > 1 || is_depth(source->declaration.format))
        return Error{"no colour image '" + std::string(name) + "' with one sample to show"};
    if (!state.handle) return Presented::resize;
    State::Slot& slot = state.slots[state.next_slot];
    DERMIS_TRY(slot.commands.wait(context, "the copy to the window"));
    uint32_t index = 0;
    VkResult result = context.vk.vkAcquireNextImageKHR(context.device, state.handle.get(), kAcquireLimit_ns,
                                                       slot.acquired.get(), VK_NULL_HANDLE, &index);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_TIMEOUT) return Presented::resize;
    DERMIS_TRY(check(result, "get a picture of the window"));
    const VkSemaphore drawn = state.drawn[index].get();
    DERMIS_TRY(slot.commands.run(
        state.device, "the copy to the window",
        [&](VkCommandBuffer commands) { state.blit(commands, *source, state.images[index]); },
        {.wait = slot.acquired.get(), .signal = drawn}));
    state.next_slot = (state.next_slot + 1) % state.slots.size();
    const VkSwapchainKHR swapchain = state.handle.get();
    const VkPresentInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &drawn,
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain,
                                   .pImageIndices = &index};
    result = context.vk.vkQueuePresentKHR(context.queue, &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return Presented::resize;
    DERMIS_TRY(check(result, "show a picture"));
    return Presented::shown;
}

Swapchain::Swapchain(std::unique_ptr<State> state) : state_(std::move(state)) {}
Swapchain::~Swapchain() = default;
Swapchain::Swapchain(Swapchain&&) noexcept = default;
Swapchain& Swapchain::operator=(Swapchain&&) noexcept = default;

}  // namespace dermis::gpu
