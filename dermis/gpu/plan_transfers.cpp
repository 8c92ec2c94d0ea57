// Passes without shaders: their images, and whether the device can copy them.

#include "dermis/gpu/plan.h"

namespace dermis::gpu {
namespace {

Error transfer_error(const PlannedPass& planned, const std::string& what) {
    return Error{pass_label(*planned.pass) + ": " + what};
}

bool has_extent(const FrameImage& image, VkExtent2D extent) {
    return image.extent().width == extent.width && image.extent().height == extent.height;
}

// A scaling copy reads its source with a filter, which the format must allow.
Result<void> check_blit(const Context& context, const PlannedPass& planned, const FrameImage& source,
                        const FrameImage& target) {
    constexpr VkFormatFeatureFlags kSource =
        VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (context.can(source.image.info.format, kSource) &&
        context.can(target.image.info.format, VK_FORMAT_FEATURE_BLIT_DST_BIT))
        return {};
    return transfer_error(planned, std::string(context.properties.deviceName) + " cannot scale " +
                                       std::string(format_name(source.declaration.format)) + " to " +
                                       std::string(format_name(target.declaration.format)));
}

Result<void> generate_mips(const Context& context, PlannedPass& planned, FrameImage& image) {
    if (is_depth(image.declaration.format) || image.declaration.samples > 1)
        return transfer_error(planned, "only colour images with one sample have mips generated");
    planned.extent = image.extent();
    planned.accesses = {{.image = &image, .use = ImageUse::copy_source}};
    return check_blit(context, planned, image, image);
}

Result<void> resolve(PlannedPass& planned, FrameImage& source, FrameImage& target, uint32_t mip) {
    const ImageInfo &from = source.image.info, &to = target.image.info;
    if (from.samples < 2 || to.samples != 1 || from.format != to.format ||
        !has_extent(source, planned.extent))
        return transfer_error(planned,
                              "resolve needs a multisampled source and a target of the same format and size");
    const ImageUse use =
        is_depth(source.declaration.format) ? ImageUse::depth_target : ImageUse::color_target;
    planned.accesses = {{.image = &source, .use = use},
                        {.image = &target, .first_mip = mip, .use = use, .discard = true}};
    return {};
}

Result<void> copy(const Context& context, PlannedPass& planned, FrameImage& source, FrameImage& target,
                  uint32_t mip) {
    const ImageInfo &from = source.image.info, &to = target.image.info;
    const bool same =
        from.format == to.format && from.samples == to.samples && has_extent(source, planned.extent);
    const bool depth = is_depth(source.declaration.format) || is_depth(target.declaration.format);
    if (!same && (depth || from.samples > 1 || to.samples > 1))
        return transfer_error(
            planned, "copy of depth or multisampled images needs the same format, size and sample count");
    planned.accesses = {{.image = &source, .use = ImageUse::copy_source},
                        {.image = &target, .first_mip = mip, .use = ImageUse::copy_target, .discard = true}};
    return same ? Result<void>() : check_blit(context, planned, source, target);
}

}  // namespace

Result<void> plan_transfer(const PlanContext& context, PlannedPass& planned) {
    const Pass& pass = *planned.pass;
    const std::string& source_name = pass.reads.front().image;
    FrameImage* source = context.images.find(source_name);
    if (!source) return transfer_error(planned, "'" + source_name + "' is no image of the list");
    if (pass.kind == PassKind::generate_mips) return generate_mips(context.device.context, planned, *source);
    const std::string& target_name = pass.colors.empty() ? pass.depth->image : pass.colors.front().image;
    const int mip = pass.colors.empty() ? 0 : pass.colors.front().mip;
    FrameImage* target = context.images.find(target_name);
    if (mip < 0 || uint32_t(mip) >= target->image.info.mips)
        return transfer_error(planned, "'" + target_name + "' has no mip level " + std::to_string(mip));
    planned.extent = target->extent(mip);
    return pass.kind == PassKind::resolve
               ? resolve(planned, *source, *target, uint32_t(mip))
               : copy(context.device.context, planned, *source, *target, uint32_t(mip));
}

}  // namespace dermis::gpu
