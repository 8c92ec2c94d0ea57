#include "dermis/gpu/frame_images.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::gpu {
namespace {

// Images that no list used for so many runs are freed: lists that alternate keep theirs, and resizing a
// window does not fill the memory.
constexpr uint64_t kIdleImageRuns = 8;

bool is_storage(const PassList& list, std::string_view name) {
    return std::ranges::any_of(list.passes, [&](const Pass& pass) {
        return std::ranges::any_of(pass.storage, [&](const ImageRead& image) { return image.image == name; });
    });
}

std::string image_key(const ImageDeclaration& declaration, VkExtent2D extent, bool storage) {
    std::string key = declaration.name;
    for (const int part : {int(declaration.format), int(extent.width), int(extent.height),
                           declaration.samples, declaration.mips, int(declaration.persistent), int(storage)})
        key += "|" + std::to_string(part);
    return key;
}

}  // namespace

Result<void> FrameImages::prepare(const PassList& list, int width, int height) {
    ++run_;
    current_.clear();
    for (const ImageDeclaration& declaration : list.images) {
        const TexelSize size = size_in_frame(declaration.size, width, height);
        const VkExtent2D extent = {uint32_t(size.width), uint32_t(size.height)};
        const bool storage = is_storage(list, declaration.name);
        const std::string key = image_key(declaration, extent, storage);
        auto found = images_.find(key);
        if (found == images_.end()) {
            DERMIS_TRY_ASSIGN(FrameImage image, make(declaration, extent, storage));
            found = images_.emplace(key, std::move(image)).first;
            if (declaration.persistent)
                if (Result<void> ok = clear(found->second); !ok) return ok;
        }
        found->second.last_run = run_;
        current_[declaration.name] = &found->second;
    }
    std::erase_if(images_, [&](const auto& entry) { return entry.second.last_run + kIdleImageRuns < run_; });
    return {};
}

FrameImage* FrameImages::find(std::string_view name) const {
    const auto found = current_.find(name);
    return found == current_.end() ? nullptr : found->second;
}

std::vector<std::string> FrameImages::names() const {
    std::vector<std::string> names;
    for (const auto& [name, image] : current_) names.push_back(name);
    return names;
}

uint64_t FrameImages::bytes() const {
    uint64_t bytes = 0;
    for (const auto& [key, image] : images_)
        for (uint32_t mip = 0; mip < image.image.info.mips; ++mip) {
            const VkExtent2D extent = image.extent(int(mip));
            bytes += uint64_t(extent.width) * extent.height * image.image.info.samples *
                     bytes_per_texel(image.declaration.format);
        }
    return bytes;
}

Result<FrameImage> FrameImages::make(const ImageDeclaration& declaration, VkExtent2D extent, bool storage) {
    const Context& context = device_->context;
    if (!(context.sample_counts & uint32_t(declaration.samples)))
        return Error{"image '" + declaration.name + "': " + device_->info.name + " has no " +
                     std::to_string(declaration.samples) + " samples"};
    const FormatInfo format = format_info(declaration.format);
    const int chain = full_mip_count(int(extent.width), int(extent.height));
    if (declaration.mips < 0 || declaration.mips > chain)
        return Error{"image '" + declaration.name + "' has " + std::to_string(declaration.mips) +
                     " mip levels; at most " + std::to_string(chain) + ", 0 for all"};
    if (declaration.samples > 1 && (declaration.mips != 1 || storage))
        return Error{"image '" + declaration.name +
                     "' is multisampled; such images have neither mips nor storage writes"};
    VkImageUsageFlags usage =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    usage |= is_depth(declaration.format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                          : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (storage) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    Result<DeviceImage> image = make_image(context, declaration.name,
                                           {.format = format.format,
                                            .aspect = format.aspect,
                                            .extent = extent,
                                            .mips = uint32_t(declaration.mips ? declaration.mips : chain),
                                            .samples = uint32_t(declaration.samples),
                                            .usage = usage});
    if (!image) return image.error();
    FrameImage result{.declaration = declaration, .image = std::move(*image)};
    for (uint32_t mip = 0; mip < result.image.info.mips; ++mip) {
        DERMIS_TRY_ASSIGN(OwnedView view, make_mip_view(context, result.image, mip));
        result.mip_views.push_back(std::move(view));
        set_object_name(context, VK_OBJECT_TYPE_IMAGE_VIEW, result.mip_views.back().get(),
                        declaration.name + " mip " + std::to_string(mip));
        result.last_use.push_back(ImageUse::none);
    }
    return result;
}

Result<void> FrameImages::clear(FrameImage& image) {
    const Context& context = device_->context;
    return run_once(*device_, "the first clear of " + image.declaration.name, [&](VkCommandBuffer commands) {
        BarrierBatch barriers;
        barriers.add(image, 0, image.image.info.mips, ImageUse::copy_target, true);
        barriers.record(context, commands);
        const VkImageSubresourceRange range = {image.image.info.aspect, 0, image.image.info.mips, 0, 1};
        const VkClearColorValue zero = {};
        const VkClearDepthStencilValue far = {.depth = 1};
        constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        if (is_depth(image.declaration.format))
            context.vk.vkCmdClearDepthStencilImage(commands, image.image.handle.get(), kLayout, &far, 1,
                                                   &range);
        else
            context.vk.vkCmdClearColorImage(commands, image.image.handle.get(), kLayout, &zero, 1, &range);
    });
}

}  // namespace dermis::gpu
