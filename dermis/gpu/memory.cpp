#include "dermis/gpu/memory.h"

#include <algorithm>
#include <optional>

namespace dermis::gpu {
namespace {

std::optional<uint32_t> find_memory_type(const Context& context, uint32_t allowed,
                                         VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < context.memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1) && (context.memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return std::nullopt;
}

uint32_t choose_memory_type(const Context& context, uint32_t allowed, MemoryUse use) {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::optional<uint32_t> type;
    if (use == MemoryUse::device)
        type = find_memory_type(context, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (use == MemoryUse::readback)
        type = find_memory_type(context, allowed, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    if (!type && use != MemoryUse::device) type = find_memory_type(context, allowed, kMapped);
    // The specification guarantees a coherent mapped type for buffers and any type at all for images.
    return type ? *type : *find_memory_type(context, allowed, 0);
}

std::string megabytes(VkDeviceSize bytes) {
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MB";
}

// All device memory is allocated here.
Result<OwnedMemory> allocate(const Context& context, const VkMemoryRequirements& needs, MemoryUse use,
                             std::string_view name) {
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needs.size,
        .memoryTypeIndex = choose_memory_type(context, needs.memoryTypeBits, use)};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkAllocateMemory(context.device, &info, nullptr, &memory);
    const std::string what = "allocate " + megabytes(needs.size) + " for '" + std::string(name) + "'";
    DERMIS_TRY(check(result, what));
    set_object_name(context, VK_OBJECT_TYPE_DEVICE_MEMORY, memory, name);
    return OwnedMemory(context, memory);
}

Result<OwnedView> make_view(const Context& context, const DeviceImage& image, uint32_t first_mip,
                            uint32_t mips, VkImageViewType type) {
    const VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = image.handle.get(),
                                        .viewType = type,
                                        .format = image.info.format,
                                        .subresourceRange = {.aspectMask = image.info.aspect,
                                                             .baseMipLevel = first_mip,
                                                             .levelCount = mips,
                                                             .layerCount = image.info.layers}};
    VkImageView view = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateImageView(context.device, &info, nullptr, &view);
    DERMIS_TRY(check(result, "make an image view"));
    return OwnedView(context, view);
}

}  // namespace

Result<Buffer> make_buffer(const Context& context, std::string_view name, VkDeviceSize size,
                           VkBufferUsageFlags usage, MemoryUse use) {
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = std::max<VkDeviceSize>(size, 4),
                                     .usage = usage};
    VkBuffer handle = VK_NULL_HANDLE;
    const VkResult created = context.vk.vkCreateBuffer(context.device, &info, nullptr, &handle);
    DERMIS_TRY(check(created, "make buffer '" + std::string(name) + "'"));
    Buffer buffer;
    buffer.handle = OwnedBuffer(context, handle);
    buffer.size = info.size;
    set_object_name(context, VK_OBJECT_TYPE_BUFFER, handle, name);

    VkMemoryRequirements needs;
    context.vk.vkGetBufferMemoryRequirements(context.device, handle, &needs);
    Result<OwnedMemory> memory = allocate(context, needs, use, name);
    if (!memory) return memory.error();
    buffer.memory = std::move(*memory);
    VkResult result = context.vk.vkBindBufferMemory(context.device, handle, buffer.memory.get(), 0);
    if (result == VK_SUCCESS && use != MemoryUse::device) {
        void* mapped = nullptr;
        result = context.vk.vkMapMemory(context.device, buffer.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped);
        buffer.mapped = static_cast<std::byte*>(mapped);
    }
    DERMIS_TRY(check(result, "map buffer '" + std::string(name) + "'"));
    return buffer;
}

Result<DeviceImage> make_image(const Context& context, std::string_view name, const ImageInfo& info) {
    const VkImageCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = info.cube ? VkImageCreateFlags{VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT} : VkImageCreateFlags{},
        .imageType = VK_IMAGE_TYPE_2D,
        .format = info.format,
        .extent = {info.extent.width, info.extent.height, 1},
        .mipLevels = info.mips,
        .arrayLayers = info.layers,
        .samples = VkSampleCountFlagBits(info.samples),
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = info.usage};
    VkImageFormatProperties limits = {};
    const VkResult supported = vkGetPhysicalDeviceImageFormatProperties(
        context.physical, info.format, create.imageType, create.tiling, create.usage, create.flags, &limits);
    const bool fits = info.extent.width <= limits.maxExtent.width &&
                      info.extent.height <= limits.maxExtent.height && (limits.sampleCounts & info.samples);
    if (supported != VK_SUCCESS || !fits)
        return Error{"image '" + std::string(name) + "': " + context.properties.deviceName +
                     " has no image of this format, size (" + std::to_string(info.extent.width) + "x" +
                     std::to_string(info.extent.height) + "), use and " + std::to_string(info.samples) +
                     " samples"};
    VkImage handle = VK_NULL_HANDLE;
    VkResult result = context.vk.vkCreateImage(context.device, &create, nullptr, &handle);
    DERMIS_TRY(check(result, "make image '" + std::string(name) + "'"));
    DeviceImage image;
    image.handle = OwnedImage(context, handle);
    image.info = info;
    set_object_name(context, VK_OBJECT_TYPE_IMAGE, handle, name);

    VkMemoryRequirements needs;
    context.vk.vkGetImageMemoryRequirements(context.device, handle, &needs);
    Result<OwnedMemory> memory = allocate(context, needs, MemoryUse::device, name);
    if (!memory) return memory.error();
    image.memory = std::move(*memory);
    result = context.vk.vkBindImageMemory(context.device, handle, image.memory.get(), 0);
    DERMIS_TRY(check(result, "bind image '" + std::string(name) + "'"));
    const VkImageViewType type = info.cube         ? VK_IMAGE_VIEW_TYPE_CUBE
                                 : info.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                   : VK_IMAGE_VIEW_TYPE_2D;
    Result<OwnedView> view = make_view(context, image, 0, info.mips, type);
    if (!view) return view.error();
    image.view = std::move(*view);
    set_object_name(context, VK_OBJECT_TYPE_IMAGE_VIEW, image.view.get(), name);
    return image;
}

Result<OwnedView> make_mip_view(const Context& context, const DeviceImage& image, uint32_t mip) {
    return make_view(context, image, mip, 1, VK_IMAGE_VIEW_TYPE_2D);
}

}  // namespace dermis::gpu
