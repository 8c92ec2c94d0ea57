// The samplers, by the names that shaders use for them.

#include <algorithm>

#include "dermis/gpu/device_state.h"

namespace dermis::gpu {
namespace {

VkSamplerCreateInfo sampler_info(std::string_view name, const Context& context) {
    const bool nearest = name.starts_with("nearest"), trilinear = name.starts_with("trilinear");
    const VkFilter filter = nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    VkSamplerAddressMode address =
        name.ends_with("repeat") ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const bool compare = name == "shadow_compare";
    // Outside the shadow map nothing is in shadow: the border has the largest depth.
    if (compare) address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
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

}  // namespace

Result<void> make_samplers(Device::State& state) {
    const Context& context = state.context;
    for (size_t i = 0; i < kSamplerNames.size(); ++i) {
        const VkSamplerCreateInfo info = sampler_info(kSamplerNames[i], context);
        VkSampler sampler = VK_NULL_HANDLE;
        const VkResult result = context.vk.vkCreateSampler(context.device, &info, nullptr, &sampler);
        if (Result<void> ok = check(result, "make a sampler"); !ok) return ok.error();
        state.samplers[i] = OwnedSampler(context, sampler);
        set_object_name(context, VK_OBJECT_TYPE_SAMPLER, sampler, kSamplerNames[i]);
    }
    return {};
}

}  // namespace dermis::gpu
