#include "dermis/gpu/memory.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
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

// All device memory is allocated here.
Result<OwnedMemory> allocate(const Context& context, const VkMemoryRequirements& needs, MemoryUse use,
                             std::string_view name) {
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needs.size,
        .memoryTypeIndex = choose_memory_type(context, needs.memoryTypeBits, use)};
    const VkDeviceSize megabytes = (needs.size + (1 << 20) - 1) >> 20;
    const std::string what = fmt::format("allocate {} MB for '{}'", megabytes, name);
    DERMIS_TRY_ASSIGN(OwnedMemory memory,
                      make<OwnedMemory>(context, context.vk.vkAllocateMemory, info, what));
    set_object_name(context, VK_OBJECT_TYPE_DEVICE_MEMORY, memory.get(), name);
    return memory;
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
    return make<OwnedView>(context, context.vk.vkCreateImageView, info, "make an image view");
}

}  // namespace

Result<Buffer> make_buffer(const Context& context, std::string_view name, VkDeviceSize size,
                           VkBufferUsageFlags usage, MemoryUse use) {
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = std::max<VkDeviceSize>(size, 4),
                                     .usage = usage};
    Buffer buffer{.size = info.size};
    DERMIS_TRY_ASSIGN(buffer.handle, make<OwnedBuffer>(context, context.vk.vkCreateBuffer, info,
                                                       "make buffer '" + std::string(name) + "'"));
    const VkBuffer handle = buffer.handle.get();
    set_object_name(context, VK_OBJECT_TYPE_BUFFER, handle, name);

    VkMemoryRequirements needs;
    context.vk.vkGetBufferMemoryRequirements(context.device, handle, &needs);
    DERMIS_TRY_ASSIGN(buffer.memory, allocate(context, needs, use, name));
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
        return Error{
            fmt::format("image '{}': {} has no image of this format, size ({}x{}), use and {} samples", name,
                        context.properties.deviceName, info.extent.width, info.extent.height, info.samples)};
    DeviceImage image{.info = info};
    DERMIS_TRY_ASSIGN(image.handle, make<OwnedImage>(context, context.vk.vkCreateImage, create,
                                                     "make image '" + std::string(name) + "'"));
    const VkImage handle = image.handle.get();
    set_object_name(context, VK_OBJECT_TYPE_IMAGE, handle, name);

    VkMemoryRequirements needs;
    context.vk.vkGetImageMemoryRequirements(context.device, handle, &needs);
    DERMIS_TRY_ASSIGN(image.memory, allocate(context, needs, MemoryUse::device, name));
    const VkResult bound = context.vk.vkBindImageMemory(context.device, handle, image.memory.get(), 0);
    DERMIS_TRY(check(bound, "bind image '" + std::string(name) + "'"));
    const VkImageViewType type = info.cube         ? VK_IMAGE_VIEW_TYPE_CUBE
                                 : info.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                   : VK_IMAGE_VIEW_TYPE_2D;
    DERMIS_TRY_ASSIGN(image.view, make_view(context, image, 0, info.mips, type));
    set_object_name(context, VK_OBJECT_TYPE_IMAGE_VIEW, image.view.get(), name);
    return image;
}

Result<OwnedView> make_mip_view(const Context& context, const DeviceImage& image, uint32_t mip) {
    return make_view(context, image, mip, 1, VK_IMAGE_VIEW_TYPE_2D);
}

FormatInfo format_info(ImageFormat format) {
    constexpr VkImageAspectFlags kColor = VK_IMAGE_ASPECT_COLOR_BIT;
    constexpr std::pair<ImageFormat, FormatInfo> kInfos[] = {
        {ImageFormat::r8, {VK_FORMAT_R8_UNORM, kColor, 1, PixelFormat::u8}},
        {ImageFormat::rg8, {VK_FORMAT_R8G8_UNORM, kColor, 2, PixelFormat::u8}},
        // Four bytes; pictures are not read in it.
        {ImageFormat::rgb10a2, {VK_FORMAT_A2B10G10R10_UNORM_PACK32, kColor, 4, PixelFormat::u8}},
        {ImageFormat::rgba8, {VK_FORMAT_R8G8B8A8_UNORM, kColor, 4, PixelFormat::u8}},
        {ImageFormat::rgba16, {VK_FORMAT_R16G16B16A16_UNORM, kColor, 4, PixelFormat::u16}},
        {ImageFormat::r16f, {VK_FORMAT_R16_SFLOAT, kColor, 1, PixelFormat::f16}},
        {ImageFormat::rg16f, {VK_FORMAT_R16G16_SFLOAT, kColor, 2, PixelFormat::f16}},
        {ImageFormat::rgba16f, {VK_FORMAT_R16G16B16A16_SFLOAT, kColor, 4, PixelFormat::f16}},
        {ImageFormat::r32f, {VK_FORMAT_R32_SFLOAT, kColor, 1, PixelFormat::f32}},
        {ImageFormat::rgba32f, {VK_FORMAT_R32G32B32A32_SFLOAT, kColor, 4, PixelFormat::f32}},
        {ImageFormat::depth32f, {VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT, 1, PixelFormat::f32}}};
    return std::ranges::find(kInfos, format, &std::pair<ImageFormat, FormatInfo>::first)->second;
}

int full_mip_count(int width, int height) {
    return std::bit_width(unsigned(std::max({width, height, 1})));
}

VkExtent2D mip_extent(VkExtent2D base, int mip) {
    return {std::max(1u, base.width >> mip), std::max(1u, base.height >> mip)};
}

}  // namespace dermis::gpu
