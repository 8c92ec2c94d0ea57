// Lists the devices, and which of them can run dermis.

#include <fmt/core.h>

#include <algorithm>
#include <climits>
#include <cstring>

#include "dermis/base/text.h"
#include "dermis/gpu/instance.h"

namespace dermis::gpu {
namespace {

int rank(const PhysicalDevice& device) {
    if (!device.info.missing.empty()) return 9;
    constexpr VkPhysicalDeviceType kPreferred[] = {
        VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
        VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU};
    return int(std::ranges::find(kPreferred, device.properties.deviceType) - kPreferred);
}

bool has_device_extension(VkPhysicalDevice device, const char* name) {
    constexpr const char* kOfEachLayer = nullptr;
    return std::ranges::any_of(
        list_all<VkExtensionProperties>(vkEnumerateDeviceExtensionProperties, device, kOfEachLayer),
        [&](const auto& one) { return !std::strcmp(one.extensionName, name); });
}

// A graphics queue that also computes; by the specification such a queue can transfer, too.
bool find_queue(PhysicalDevice& device) {
    const auto families =
        list_all<VkQueueFamilyProperties>(vkGetPhysicalDeviceQueueFamilyProperties, device.handle);
    constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < families.size(); ++i) {
        if ((families[i].queueFlags & kWanted) != kWanted) continue;
        device.queue_family = i;
        device.timestamp_bits = families[i].timestampValidBits;
        return true;
    }
    return false;
}

std::string version_text(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::vector<std::string> missing_features(PhysicalDevice& device) {
    if (device.properties.apiVersion < VK_API_VERSION_1_3) return {"Vulkan 1.3"};
    VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                            .pNext = &v13};
    VkPhysicalDeviceFeatures2 features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                          .pNext = &v12};
    vkGetPhysicalDeviceFeatures2(device.handle, &features);
    device.features = features.features;
    std::vector<std::string> missing;
    if (!v13.dynamicRendering) missing.push_back("dynamicRendering");
    if (!v13.synchronization2) missing.push_back("synchronization2");
    if (!v12.scalarBlockLayout) missing.push_back("scalarBlockLayout");
    if (!features.features.independentBlend) missing.push_back("independentBlend");
    if (!find_queue(device)) missing.push_back("a queue for graphics and compute");
    std::ranges::move(missing_formats([&](VkFormat format) {
                          VkFormatProperties has;
                          vkGetPhysicalDeviceFormatProperties(device.handle, format, &has);
                          return has.optimalTilingFeatures;
                      }),
                      std::back_inserter(missing));
    return missing;
}

void describe(PhysicalDevice& device) {
    const bool pushes = has_device_extension(device.handle, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    VkPhysicalDevicePushDescriptorPropertiesKHR push = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR};
    VkPhysicalDeviceDriverProperties driver = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                               .pNext = pushes ? &push : nullptr};
    VkPhysicalDeviceProperties2 all = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                       .pNext = &driver};
    vkGetPhysicalDeviceProperties2(device.handle, &all);
    device.properties = all.properties;
    device.info.push_descriptors = int(push.maxPushDescriptors);
    const VkPhysicalDeviceLimits& limits = all.properties.limits;
    device.sample_counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    device.info.storage_buffers = int(std::min<uint32_t>(
        {limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers, INT_MAX}));
    device.info.name = all.properties.deviceName;
    const std::string detail = driver.driverInfo;
    device.info.driver = std::string(driver.driverName) + " " +
                         (detail.empty() ? version_text(all.properties.driverVersion) : detail);
    device.info.vulkan = version_text(all.properties.apiVersion);
    device.info.is_cpu = all.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    for (int count = 1; count <= 64; count *= 2)
        if (device.sample_counts & uint32_t(count)) device.info.sample_counts.push_back(count);
    device.info.missing = missing_features(device);
}

}  // namespace

// Only formats and uses that Vulkan leaves to the driver. A comparing sampler needs no filter of the format.
std::vector<std::string> missing_formats(const std::function<VkFormatFeatureFlags(VkFormat)>& features_of) {
    constexpr VkFormatFeatureFlags kFiltered =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    struct Need {
        VkFormat format;
        VkFormatFeatureFlags features;
        std::string_view text;
    };
    constexpr Need kNeeds[] = {
        {VK_FORMAT_R16G16B16A16_UNORM,
         kFiltered | VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT,
         "R16G16B16A16_UNORM that is filtered and blitted (normal maps)"},
        {VK_FORMAT_R32_SFLOAT, kFiltered, "R32_SFLOAT that is filtered (tables)"},
        {VK_FORMAT_D32_SFLOAT,
         VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
         "D32_SFLOAT that is drawn to and sampled (shadow maps)"}};
    std::vector<std::string> missing;
    for (const Need& need : kNeeds)
        if ((features_of(need.format) & need.features) != need.features) missing.emplace_back(need.text);
    return missing;
}

Result<std::vector<PhysicalDevice>> physical_devices(const Instance& instance) {
    uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance.get(), &count, nullptr);
    std::vector<VkPhysicalDevice> handles(count);
    if (result >= 0) result = vkEnumeratePhysicalDevices(instance.get(), &count, handles.data());
    if (result != VK_ERROR_INITIALIZATION_FAILED)  // the loader returns it when every driver failed
        DERMIS_TRY(check(result, "list Vulkan devices"));
    if (handles.empty() || result < 0)
        return Error{
            "no Vulkan device; install a driver (without a GPU: apt-get install "
            "mesa-vulkan-drivers)"};
    std::vector<PhysicalDevice> devices;
    for (VkPhysicalDevice handle : handles) {
        devices.push_back({.handle = handle});
        describe(devices.back());
    }
    std::ranges::stable_sort(devices, {}, rank);
    return devices;
}

Result<PhysicalDevice> pick(std::span<const PhysicalDevice> devices, std::string_view name_contains) {
    const std::string wanted = to_lower(name_contains);
    std::string seen;
    for (const PhysicalDevice& device : devices) {
        const bool named = to_lower(device.info.name).find(wanted) != std::string::npos;
        if (named && device.info.missing.empty()) return device;
        seen += (seen.empty() ? "" : "; ") + device.info.name;
        if (!device.info.missing.empty()) seen += " (lacks " + join(device.info.missing, ", ") + ")";
    }
    if (wanted.empty())
        return Error{"no Vulkan device can run dermis: " + seen +
                     ". Update the driver, or install mesa-vulkan-drivers"};
    return Error{"no usable Vulkan device has '" + std::string(name_contains) +
                 "' in its name; there are: " + seen};
}

Result<std::vector<DeviceInfo>> list_devices() {
    DERMIS_TRY_ASSIGN(Instance instance, Instance::create({}));
    DERMIS_TRY_ASSIGN(std::vector<PhysicalDevice> devices, physical_devices(instance));
    std::vector<DeviceInfo> infos;
    for (const PhysicalDevice& device : devices) infos.push_back(device.info);
    return infos;
}

}  // namespace dermis::gpu
