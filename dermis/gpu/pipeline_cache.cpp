// Compiled pipelines on disk, one file for each device and driver.

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/gpu/device_state.h"

namespace dermis::gpu {
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
    VkPipelineCache cache = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreatePipelineCache(context.device, &info, nullptr, &cache);
    DERMIS_TRY(check(result, "make a pipeline cache"));
    state.pipeline_cache = OwnedPipelineCache(context, cache);
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

}  // namespace dermis::gpu
