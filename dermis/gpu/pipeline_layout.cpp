// One descriptor set for all stages of a pipeline; binding numbers are assigned by name.

#include <fmt/core.h>

#include <algorithm>

#include "dermis/gpu/pipeline.h"

namespace dermis::gpu {
namespace {

VkDescriptorType descriptor_type(BindingKind kind) {
    constexpr VkDescriptorType kTypes[] = {
        VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,  VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,  VK_DESCRIPTOR_TYPE_SAMPLER,
        VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    return kTypes[size_t(kind)];
}

Result<void> add_binding(const Shader& shader, const Binding& binding, Pipeline& pipeline) {
    const auto same = std::ranges::find(pipeline.bindings, binding.name, &Binding::name);
    if (same == pipeline.bindings.end()) {
        pipeline.bindings.push_back(binding);
        return {};
    }
    if (same->kind == binding.kind && same->shape == binding.shape && same->block == binding.block) return {};
    return Error{"shader '" + shader.name + "' declares '" + binding.name +
                 "' otherwise than the other stage does"};
}

}  // namespace

Result<void> check_stage_borders(const Pass& pass, const Shader& vertex, const Shader* fragment) {
    const auto has = [](const std::vector<StageVariable>& variables, size_t location) {
        return std::ranges::count(variables, location, &StageVariable::location) > 0;
    };
    for (size_t i = 0; i < pass.colors.size(); ++i)
        if (pass.colors[i].write_mask && (!fragment || !has(fragment->interface.outputs, i)))
            return Error{fmt::format("target '{}' needs an output at location {}, which the shader lacks",
                                     pass.colors[i].image, i)};
    if (!fragment) return {};
    for (const StageVariable& input : fragment->interface.inputs)
        if (!has(vertex.interface.outputs, input.location))
            return Error{fmt::format("input '{}' at location {} is not written by vertex shader '{}'",
                                     input.name, input.location, vertex.name)};
    return {};
}

Result<void> merge_interface(std::span<const Shader* const> stages, Pipeline& pipeline) {
    for (const Shader* shader : stages) {
        for (const Binding& binding : shader->interface.bindings)
            DERMIS_TRY(add_binding(*shader, binding, pipeline));
        const BlockLayout& push = shader->interface.push_constants;
        if (push.members.empty()) continue;
        if (pipeline.push_stages && !(push == pipeline.push_constants))
            return Error{"shader '" + shader->name +
                         "' has other push constants than the other stage; declare the same block in both"};
        pipeline.push_constants = push;
        pipeline.push_stages |= shader->interface.stage;
    }
    return {};
}

std::vector<uint32_t> renumbered(const Shader& shader, const Pipeline& pipeline) {
    std::vector<uint32_t> words = shader.words;
    for (const Binding& binding : shader.interface.bindings) {
        const auto merged = std::ranges::find(pipeline.bindings, binding.name, &Binding::name);
        words[binding.binding_word] = uint32_t(merged - pipeline.bindings.begin());
        words[binding.set_word] = 0;
    }
    return words;
}

Result<void> make_layout(Device::State& device, Pipeline& pipeline) {
    const Context& context = device.context;
    if (pipeline.push_constants.size > context.properties.limits.maxPushConstantsSize)
        return Error{fmt::format("wants {} bytes of push constants; {} has {}", pipeline.push_constants.size,
                                 device.info.name, context.properties.limits.maxPushConstantsSize)};
    const auto storage_buffers =
        std::ranges::count(pipeline.bindings, BindingKind::storage_buffer, &Binding::kind);
    if (storage_buffers > device.info.storage_buffers)
        return Error{fmt::format("binds {} storage buffers; {} binds {} at most", storage_buffers,
                                 device.info.name, device.info.storage_buffers)};
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Binding& binding : pipeline.bindings) {
        bindings.push_back({.binding = uint32_t(bindings.size()),
                            .descriptorType = descriptor_type(binding.kind),
                            .descriptorCount = 1,
                            .stageFlags = VK_SHADER_STAGE_ALL});
    }
    pipeline.pushes_descriptors =
        context.max_push_descriptors && bindings.size() <= context.max_push_descriptors;
    VkDescriptorSetLayoutCreateInfo set_info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                .bindingCount = uint32_t(bindings.size()),
                                                .pBindings = bindings.data()};
    if (pipeline.pushes_descriptors) set_info.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    DERMIS_TRY_ASSIGN(pipeline.set_layout,
                      make<OwnedSetLayout>(context, context.vk.vkCreateDescriptorSetLayout, set_info,
                                           "make a descriptor layout"));
    const VkDescriptorSetLayout set = pipeline.set_layout.get();
    const VkPushConstantRange range = {pipeline.push_stages, 0, (pipeline.push_constants.size + 3) & ~3u};
    const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = 1,
                                             .pSetLayouts = &set,
                                             .pushConstantRangeCount = pipeline.push_stages ? 1u : 0u,
                                             .pPushConstantRanges = &range};
    DERMIS_TRY_ASSIGN(pipeline.layout, make<OwnedPipelineLayout>(context, context.vk.vkCreatePipelineLayout,
                                                                 info, "make a pipeline layout"));
    return {};
}

}  // namespace dermis::gpu
