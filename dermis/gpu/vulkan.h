#pragma once
// Vulkan for this folder only: the loader, owning handles, and results as text.

#include <volk.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::gpu {

/// Counts submissions to the queue: a timeline semaphore has the number of the last submission that is
/// done, and all before it are done too.
struct Submissions {
    VkSemaphore done = VK_NULL_HANDLE;
    uint64_t submitted = 0;
    uint64_t known_done = 0;
};

/// The logical device and what everything made from it needs. Never moves while the device lives.
struct Context {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
    VolkDeviceTable vk = {};
    VkPhysicalDeviceProperties properties = {};
    VkPhysicalDeviceMemoryProperties memory = {};
    VkPhysicalDeviceFeatures features = {};  ///< those enabled
    uint32_t max_push_descriptors = 0;       ///< 0: VK_KHR_push_descriptor is not enabled
    uint32_t timestamp_bits = 0;
    VkSampleCountFlags sample_counts = 0;  ///< of colour and depth targets alike
    bool is_cpu = false;
    bool keep_statistics = false;  ///< of pipelines: VK_KHR_pipeline_executable_properties is enabled
    mutable Submissions submissions;
    mutable uint64_t created = 0;  ///< handles and allocations since the device was opened
    PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;  ///< null without VK_EXT_debug_utils
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;

    /// Whether optimally tiled images of this format have all these features.
    [[nodiscard]] bool can(VkFormat format, VkFormatFeatureFlags features) const;
    [[nodiscard]] VkPipelineCreateFlags pipeline_flags() const {
        return keep_statistics ? VkPipelineCreateFlags{VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR} : 0;
    }

    /// Waits for a submission; 0: for none. Error: the device was lost.
    [[nodiscard]] VkResult wait_for(uint64_t submission) const;
    [[nodiscard]] bool is_done(uint64_t submission) const;
};

/// A device-level handle that destroys itself, after all that was submitted: a frame in flight may use it.
template <class Handle, auto Destroy>
class Owned {
  public:
    Owned() = default;
    Owned(const Context& context, Handle handle) : context_(&context), handle_(handle) { ++context.created; }
    ~Owned() { reset(); }
    Owned(Owned&& other) noexcept
        : context_(other.context_), handle_(std::exchange(other.handle_, Handle{})) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this == &other) return *this;
        reset();
        context_ = other.context_;
        handle_ = std::exchange(other.handle_, Handle{});
        return *this;
    }

    [[nodiscard]] Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != Handle{}; }

  private:
    void reset() {
        if (!handle_) return;
        // After a loss nothing runs any more.
        static_cast<void>(context_->wait_for(context_->submissions.submitted));
        (context_->vk.*Destroy)(context_->device, handle_, nullptr);
        handle_ = {};
    }

    const Context* context_ = nullptr;
    Handle handle_ = {};
};

using OwnedMemory = Owned<VkDeviceMemory, &VolkDeviceTable::vkFreeMemory>;
using OwnedBuffer = Owned<VkBuffer, &VolkDeviceTable::vkDestroyBuffer>;
using OwnedImage = Owned<VkImage, &VolkDeviceTable::vkDestroyImage>;
using OwnedView = Owned<VkImageView, &VolkDeviceTable::vkDestroyImageView>;
using OwnedSampler = Owned<VkSampler, &VolkDeviceTable::vkDestroySampler>;
using OwnedShader = Owned<VkShaderModule, &VolkDeviceTable::vkDestroyShaderModule>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, &VolkDeviceTable::vkDestroyDescriptorSetLayout>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, &VolkDeviceTable::vkDestroyPipelineLayout>;
using OwnedPipeline = Owned<VkPipeline, &VolkDeviceTable::vkDestroyPipeline>;
using OwnedPipelineCache = Owned<VkPipelineCache, &VolkDeviceTable::vkDestroyPipelineCache>;
using OwnedCommandPool = Owned<VkCommandPool, &VolkDeviceTable::vkDestroyCommandPool>;
using OwnedDescriptorPool = Owned<VkDescriptorPool, &VolkDeviceTable::vkDestroyDescriptorPool>;
using OwnedQueryPool = Owned<VkQueryPool, &VolkDeviceTable::vkDestroyQueryPool>;
using OwnedSemaphore = Owned<VkSemaphore, &VolkDeviceTable::vkDestroySemaphore>;

/// "cannot WHAT: out of GPU memory". Other success codes (VK_INCOMPLETE, ...) pass.
[[nodiscard]] Result<void> check(VkResult result, std::string_view what);

/// make<OwnedSampler>(context, context.vk.vkCreateSampler, info, "make a sampler")
template <class Owner, class Info, class Handle>
[[nodiscard]] Result<Owner> make(const Context& context,
                                 VkResult(VKAPI_PTR* create)(VkDevice, const Info*,
                                                             const VkAllocationCallbacks*, Handle*),
                                 const Info& info, std::string_view what) {
    Handle handle = VK_NULL_HANDLE;
    DERMIS_TRY(check(create(context.device, &info, nullptr, &handle), what));
    return Owner(context, handle);
}

/// The list that one of Vulkan's listing functions returns for these arguments.
template <class Item, class List, class... Arguments>
[[nodiscard]] std::vector<Item> list_all(List list, Arguments... arguments) {
    uint32_t count = 0;
    list(arguments..., &count, nullptr);
    std::vector<Item> items(count);
    list(arguments..., &count, items.data());
    return items;
}

/// For RenderDoc and the validation layers; nothing happens without VK_EXT_debug_utils.
void set_object_name(const Context& context, VkObjectType type, uint64_t handle, std::string_view name);
template <class Handle>
void set_object_name(const Context& context, VkObjectType type, Handle handle, std::string_view name) {
    set_object_name(context, type, reinterpret_cast<uint64_t>(handle), name);
}

}  // namespace dermis::gpu
