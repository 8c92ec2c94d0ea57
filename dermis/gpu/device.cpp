#include "dermis/base/parallel.h"
#include "dermis/gpu/device_state.h"

namespace dermis::gpu {
namespace {

template <class Function>
Function instance_function(const Context& context, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(context.instance, name));
}

void load_debug_names(const Instance& instance, Context& context) {
    if (!instance.has_debug_utils()) return;
    context.set_name =
        instance_function<PFN_vkSetDebugUtilsObjectNameEXT>(context, "vkSetDebugUtilsObjectNameEXT");
    context.begin_label =
        instance_function<PFN_vkCmdBeginDebugUtilsLabelEXT>(context, "vkCmdBeginDebugUtilsLabelEXT");
    context.end_label =
        instance_function<PFN_vkCmdEndDebugUtilsLabelEXT>(context, "vkCmdEndDebugUtilsLabelEXT");
}

// Only what is used: a feature that is asked for can cost start-up time.
VkPhysicalDeviceFeatures wanted_features(const VkPhysicalDeviceFeatures& has) {
    return {.independentBlend = has.independentBlend,
            .samplerAnisotropy = has.samplerAnisotropy,
            .occlusionQueryPrecise = has.occlusionQueryPrecise,
            .shaderStorageImageExtendedFormats = has.shaderStorageImageExtendedFormats};
}

Result<void> make_device(Device::State& state, const DeviceOptions& options) {
    Context& context = state.context;
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = context.queue_family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                            .synchronization2 = VK_TRUE,
                                            .dynamicRendering = VK_TRUE,
                                            .maintenance4 = VK_TRUE};  // LocalSizeId, which glslc emits
    VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                            .pNext = &v13,
                                            .scalarBlockLayout = VK_TRUE,
                                            .timelineSemaphore = VK_TRUE};
    std::vector<const char*> extensions;
    if (context.max_push_descriptors) extensions.push_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    if (!options.instance_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
        .pipelineExecutableInfo = VK_TRUE};
    if (options.keep_statistics) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        v13.pNext = &statistics;
    }
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .pNext = &v12,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue,
                                     .enabledExtensionCount = uint32_t(extensions.size()),
                                     .ppEnabledExtensionNames = extensions.data(),
                                     .pEnabledFeatures = &context.features};
    // lavapipe waits for ever for a thread that did not start.
    if (!can_start_threads())
        return Error{
            "the threads of the Vulkan driver cannot be started; raise the limit on processes (ulimit -u)"};
    const VkResult result = vkCreateDevice(context.physical, &info, nullptr, &context.device);
    DERMIS_TRY(check(result, "open " + state.info.name));
    volkLoadDeviceTable(&context.vk, context.device);
    context.vk.vkGetDeviceQueue(context.device, context.queue_family, 0, &context.queue);
    return {};
}

// A device without hardware gets no submission.
Result<void> make_submissions(Device::State& state) {
    DERMIS_TRY_ASSIGN(OwnedCommandPool pool,
                      make_command_pool(state.context, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT));
    state.uploads = std::move(pool);
    if (state.context.keep_statistics) return {};
    Result<OwnedSemaphore> done = make_semaphore(state.context, VK_SEMAPHORE_TYPE_TIMELINE);
    if (!done) return done.error();
    state.submissions_done = std::move(*done);
    state.context.submissions.done = state.submissions_done.get();
    return {};
}

void take_physical_device(Device::State& state, const PhysicalDevice& device, const DeviceOptions& options) {
    state.info = device.info;
    if (options.pooled_descriptors) state.info.push_descriptors = 0;
    Context& context = state.context;
    context.physical = device.handle;
    context.properties = device.properties;
    context.queue_family = device.queue_family;
    context.timestamp_bits = device.timestamp_bits;
    context.max_push_descriptors = uint32_t(state.info.push_descriptors);
    context.sample_counts = device.sample_counts;
    context.features = wanted_features(device.features);
    context.is_cpu = device.info.is_cpu;
    vkGetPhysicalDeviceMemoryProperties(context.physical, &context.memory);
}

}  // namespace

Device::State::~State() {
    if (!context.device) return;
    // RADV without hardware has no wait and crashes; nothing was submitted to it.
    if (!context.keep_statistics) context.vk.vkDeviceWaitIdle(context.device);
    context.submissions.known_done = context.submissions.submitted;
    save_pipeline_cache(*this);
    submissions_done = {};
    pipeline_cache = {};
    uploads = {};
    samplers = {};
    map_samplers = {};
    context.vk.vkDestroyDevice(context.device, nullptr);
}

Result<Device> Device::create(const DeviceOptions& options) {
    Result<Instance> instance = Instance::create(options);
    if (!instance) return instance.error();
    DERMIS_TRY_ASSIGN(std::vector<PhysicalDevice> devices, physical_devices(*instance));
    DERMIS_TRY_ASSIGN(PhysicalDevice device, pick(devices, options.name_contains));

    auto state = std::make_unique<State>();
    state->instance = std::move(*instance);
    state->context.instance = state->instance.get();
    load_debug_names(state->instance, state->context);
    take_physical_device(*state, device, options);
    state->context.keep_statistics = options.keep_statistics;
    DERMIS_TRY(make_device(*state, options));
    DERMIS_TRY(make_submissions(*state));
    DERMIS_TRY(make_samplers(*state));
    if (!options.keep_statistics) DERMIS_TRY(open_pipeline_cache(*state));
    return Device(std::move(state));
}

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const {
    return state_->info;
}

Result<void> Device::finish() {
    const Context& context = state_->context;
    return check(context.wait_for(context.submissions.submitted), "finish what was submitted");
}

uint64_t Device::created_objects() const {
    return state_->context.created;
}

std::vector<std::string> Device::messages() const {
    return state_->instance.log().all();
}

}  // namespace dermis::gpu
