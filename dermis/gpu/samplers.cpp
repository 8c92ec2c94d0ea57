// The samplers that shaders name, and those of textures: trilinear, one for each pair of address modes.

#include <algorithm>

#include "dermis/gpu/device_state.h"

namespace dermis::gpu {
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
    VkSampler sampler = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateSampler(context.device, &info, nullptr, &sampler);
    DERMIS_TRY(check(result, "make a sampler"));
    set_object_name(context, VK_OBJECT_TYPE_SAMPLER, sampler, name);
    return OwnedSampler(context, sampler);
}

}  // namespace

Result<void> make_samplers(Device::State& state) {
    const Context& context = state.context;
    for (size_t i = 0; i < kSamplerNames.size(); ++i) {
        const std::string name(kSamplerNames[i]);
        DERMIS_TRY_ASSIGN(OwnedSampler made, make_sampler(context, sampler_info(name, context), name));
        state.samplers[i] = std::move(made);
    }
    for (size_t i = 0; i < state.map_samplers.size(); ++i) {
        VkSamplerCreateInfo info = sampler_info("trilinear", context);
        info.addressModeU = kVulkanModes[i / kAddressModes];
        info.addressModeV = kVulkanModes[i % kAddressModes];
        DERMIS_TRY_ASSIGN(OwnedSampler made, make_sampler(context, info, "map " + std::to_string(i)));
        state.map_samplers[i] = std::move(made);
    }
    return {};
}

}  // namespace dermis::gpu
