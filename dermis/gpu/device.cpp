#include <algorithm>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
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
    DERMIS_TRY_ASSIGN(state.uploads, make_command_pool(state.context, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT));
    if (state.context.keep_statistics) return {};
    DERMIS_TRY_ASSIGN(state.submissions_done, make_semaphore(state.context, VK_SEMAPHORE_TYPE_TIMELINE));
    state.context.submissions.done = state.submissions_done.get();
    return {};
}

void take_physical_device(Device::State& state, const PhysicalDevice& device, const DeviceOptions& options) {
    state.info = device.info;
    if (options.pooled_descriptors) state.info.push_descriptors = 0;
    state.info.storage_buffers = std::min(state.info.storage_buffers, options.most_storage_buffers);
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
    pipelines.clear();
    pipeline_cache = {};
    uploads = {};
    samplers = {};
    map_samplers = {};
    context.vk.vkDestroyDevice(context.device, nullptr);
}

Result<Device> Device::create(const DeviceOptions& options) {
    DERMIS_TRY_ASSIGN(Instance instance, Instance::create(options));
    DERMIS_TRY_ASSIGN(std::vector<PhysicalDevice> devices, physical_devices(instance));
    DERMIS_TRY_ASSIGN(PhysicalDevice device, pick(devices, options.name_contains));

    auto state = std::make_unique<State>();
    state->instance = std::move(instance);
    state->context.instance = state->instance.get();
    load_debug_names(state->instance, state->context);
    take_physical_device(*state, device, options);
    state->context.keep_statistics = options.keep_statistics;
    state->most_pipelines = options.most_pipelines;
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

// Compiled pipelines on disk, one file for each device and driver.

namespace {

constexpr std::string_view kCacheKind = "pipelines";
// A larger cache is removed: it holds pipelines of shaders that no longer exist.
constexpr size_t kMaxCacheBytes = size_t{64} << 20;

std::string cache_key(const VkPhysicalDeviceProperties& properties) {
    return Hasher()
        .add(properties.vendorID)
        .add(properties.deviceID)
        .add(properties.driverVersion)
        .add(std::as_bytes(std::span(properties.pipelineCacheUUID)))
        .hex();
}

}  // namespace

Result<void> open_pipeline_cache(Device::State& state) {
    const Context& context = state.context;
    state.pipeline_cache_key = cache_key(context.properties);
    const std::vector<std::byte> bytes =
        cache_load(kCacheKind, state.pipeline_cache_key).value_or(std::vector<std::byte>());
    VkPipelineCacheCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                      .initialDataSize = bytes.size(),
                                      .pInitialData = bytes.data()};
    if (bytes.size() > kMaxCacheBytes) info.initialDataSize = 0;
    DERMIS_TRY_ASSIGN(
        state.pipeline_cache,
        make<OwnedPipelineCache>(context, context.vk.vkCreatePipelineCache, info, "make a pipeline cache"));
    state.pipeline_cache_bytes = info.initialDataSize;
    return {};
}

void save_pipeline_cache(Device::State& state) {
    const Context& context = state.context;
    if (!state.pipeline_cache) return;
    size_t size = 0;
    context.vk.vkGetPipelineCacheData(context.device, state.pipeline_cache.get(), &size, nullptr);
    if (size == state.pipeline_cache_bytes) return;
    std::vector<std::byte> bytes(size);
    const VkResult result =
        context.vk.vkGetPipelineCacheData(context.device, state.pipeline_cache.get(), &size, bytes.data());
    bytes.resize(size);
    // A cache that cannot be stored only costs time at the next start.
    if (result == VK_SUCCESS) cache_store(kCacheKind, state.pipeline_cache_key, bytes);
}

// The samplers that shaders name, and those of textures: trilinear, one for each pair of address modes.

namespace {

constexpr std::array<VkSamplerAddressMode, kAddressModes> kVulkanModes = {
    VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
    VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT};

VkSamplerCreateInfo sampler_info(std::string_view name, const Context& context) {
    const bool nearest = name.starts_with("nearest"), trilinear = name.starts_with("trilinear");
    const VkFilter filter = nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const bool compare = name == "shadow_compare";
    // Outside the shadow map nothing is in shadow: the border has the largest depth.
    const VkSamplerAddressMode address =
        compare ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = trilinear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = address,
        .addressModeV = address,
        .addressModeW = address,
        .compareEnable = compare,
        .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
        .maxLod = VK_LOD_CLAMP_NONE,
        .borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
    // Not on a CPU, where each sample of an anisotropic read costs time.
    if (trilinear && context.features.samplerAnisotropy && !context.is_cpu) {
        info.anisotropyEnable = VK_TRUE;
        info.maxAnisotropy = std::min(8.0f, context.properties.limits.maxSamplerAnisotropy);
    }
    return info;
}

Result<OwnedSampler> make_sampler(const Context& context, const VkSamplerCreateInfo& info,
                                  const std::string& name) {
    DERMIS_TRY_ASSIGN(OwnedSampler sampler,
                      make<OwnedSampler>(context, context.vk.vkCreateSampler, info, "make a sampler"));
    set_object_name(context, VK_OBJECT_TYPE_SAMPLER, sampler.get(), name);
    return sampler;
}

}  // namespace

Result<void> make_samplers(Device::State& state) {
    const Context& context = state.context;
    for (size_t i = 0; i < kSamplerNames.size(); ++i) {
        const std::string name(kSamplerNames[i]);
        DERMIS_TRY_ASSIGN(state.samplers[i], make_sampler(context, sampler_info(name, context), name));
    }
    for (size_t i = 0; i < state.map_samplers.size(); ++i) {
        VkSamplerCreateInfo info = sampler_info("trilinear", context);
        info.addressModeU = kVulkanModes[i / kAddressModes];
        info.addressModeV = kVulkanModes[i % kAddressModes];
        DERMIS_TRY_ASSIGN(state.map_samplers[i], make_sampler(context, info, "map " + std::to_string(i)));
    }
    return {};
}

}  // namespace dermis::gpu
