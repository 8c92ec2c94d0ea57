#include "dermis/gpu/graphics_state.h"

namespace dermis::gpu {
namespace {

VkPipelineColorBlendAttachmentState blend_state(const ColorTarget& target) {
    VkPipelineColorBlendAttachmentState state = {.blendEnable = target.blend != Blend::none,
                                                 .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                 .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                 .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                 .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                 .colorWriteMask = target.write_mask & 0xF};
    if (target.blend == Blend::alpha) {
        state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    }
    if (target.blend == Blend::multiply) {
        state.srcColorBlendFactor = VK_BLEND_FACTOR_DST_COLOR;
        state.srcAlphaBlendFactor = VK_BLEND_FACTOR_DST_ALPHA;
        state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    }
    return state;
}

VkCompareOp compare_op(Compare compare) {
    constexpr VkCompareOp kOps[] = {VK_COMPARE_OP_LESS, VK_COMPARE_OP_LESS_OR_EQUAL, VK_COMPARE_OP_EQUAL,
                                    VK_COMPARE_OP_ALWAYS};
    return kOps[size_t(compare)];
}

VkCullModeFlags cull_mode(Cull cull) {
    constexpr VkCullModeFlags kModes[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_BIT};
    return kModes[size_t(cull)];
}

}  // namespace

bool has_depth_bias(const Pass& pass) {
    return pass.depth_bias_constant != 0 || pass.depth_bias_slope != 0;
}

GraphicsState::GraphicsState(const Pass& pass, const TargetFormats& formats,
                             const std::vector<StageVariable>& inputs) {
    set_vertex_input(inputs);
    set_raster(pass);
    set_depth(pass);
    set_targets(pass, formats);
    dynamic_states_ = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    if (has_depth_bias(pass)) dynamic_states_.push_back(VK_DYNAMIC_STATE_DEPTH_BIAS);
    dynamic_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                .dynamicStateCount = uint32_t(dynamic_states_.size()),
                .pDynamicStates = dynamic_states_.data()};
    viewport_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                 .viewportCount = 1,
                 .scissorCount = 1};
}

// One buffer per stream, tightly packed floats.
void GraphicsState::set_vertex_input(const std::vector<StageVariable>& inputs) {
    constexpr VkFormat kFormats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                     VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
    for (const StageVariable& input : inputs) {
        const auto binding = uint32_t(bindings_.size());
        bindings_.push_back({binding, uint32_t(input.components) * 4, VK_VERTEX_INPUT_RATE_VERTEX});
        attributes_.push_back({input.location, binding, kFormats[input.components - 1], 0});
    }
    vertex_input_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                     .vertexBindingDescriptionCount = uint32_t(bindings_.size()),
                     .pVertexBindingDescriptions = bindings_.data(),
                     .vertexAttributeDescriptionCount = uint32_t(attributes_.size()),
                     .pVertexAttributeDescriptions = attributes_.data()};
    assembly_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                 .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
}

// Clip space has y down as the framebuffer has, and camera matrices flip y on the way there: what is
// counter-clockwise to a viewer in the right-handed world is counter-clockwise here.
void GraphicsState::set_raster(const Pass& pass) {
    raster_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
               .polygonMode = VK_POLYGON_MODE_FILL,
               .cullMode = cull_mode(pass.cull),
               .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
               .depthBiasEnable = has_depth_bias(pass),
               .lineWidth = 1};
}

void GraphicsState::set_depth(const Pass& pass) {
    depth_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    if (!pass.depth) return;
    depth_.depthTestEnable = VK_TRUE;
    depth_.depthWriteEnable = pass.depth->write;
    depth_.depthCompareOp = compare_op(pass.depth->compare);
}

void GraphicsState::set_targets(const Pass& pass, const TargetFormats& formats) {
    for (const ColorTarget& target : pass.colors) blends_.push_back(blend_state(target));
    color_formats_ = formats.colors;
    blend_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
              .attachmentCount = uint32_t(blends_.size()),
              .pAttachments = blends_.data()};
    multisample_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                    .rasterizationSamples = VkSampleCountFlagBits(formats.samples)};
    rendering_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                  .colorAttachmentCount = uint32_t(color_formats_.size()),
                  .pColorAttachmentFormats = color_formats_.data(),
                  .depthAttachmentFormat = formats.depth};
}

VkGraphicsPipelineCreateInfo GraphicsState::info(std::span<const VkPipelineShaderStageCreateInfo> stages,
                                                 VkPipelineLayout layout, VkPipelineCreateFlags flags) const {
    return {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
            .pNext = &rendering_,
            .flags = flags,
            .stageCount = uint32_t(stages.size()),
            .pStages = stages.data(),
            .pVertexInputState = &vertex_input_,
            .pInputAssemblyState = &assembly_,
            .pViewportState = &viewport_,
            .pRasterizationState = &raster_,
            .pMultisampleState = &multisample_,
            .pDepthStencilState = &depth_,
            .pColorBlendState = &blend_,
            .pDynamicState = &dynamic_,
            .layout = layout};
}

}  // namespace dermis::gpu
