#pragma once
// The fixed-function state of a raster pass, as Vulkan wants it for a pipeline.

#include "dermis/gpu/pipeline.h"

namespace dermis::gpu {

/// Points into itself: stays where it is made.
class GraphicsState {
  public:
    GraphicsState(const Pass& pass, const TargetFormats& formats, const std::vector<StageVariable>& inputs);
    GraphicsState(const GraphicsState&) = delete;
    GraphicsState& operator=(const GraphicsState&) = delete;

    /// Valid as long as this and the stages.
    [[nodiscard]] VkGraphicsPipelineCreateInfo info(std::span<const VkPipelineShaderStageCreateInfo> stages,
                                                    VkPipelineLayout layout,
                                                    VkPipelineCreateFlags flags) const;

  private:
    void set_vertex_input(const std::vector<StageVariable>& inputs);
    void set_raster(const Pass& pass);
    void set_depth(const Pass& pass);
    void set_targets(const Pass& pass, const TargetFormats& formats);

    std::vector<VkVertexInputBindingDescription> bindings_;
    std::vector<VkVertexInputAttributeDescription> attributes_;
    std::vector<VkPipelineColorBlendAttachmentState> blends_;
    std::vector<VkFormat> color_formats_;
    std::vector<VkDynamicState> dynamic_states_;
    VkPipelineVertexInputStateCreateInfo vertex_input_ = {};
    VkPipelineInputAssemblyStateCreateInfo assembly_ = {};
    VkPipelineViewportStateCreateInfo viewport_ = {};
    VkPipelineRasterizationStateCreateInfo raster_ = {};
    VkPipelineMultisampleStateCreateInfo multisample_ = {};
    VkPipelineDepthStencilStateCreateInfo depth_ = {};
    VkPipelineColorBlendStateCreateInfo blend_ = {};
    VkPipelineDynamicStateCreateInfo dynamic_ = {};
    VkPipelineRenderingCreateInfo rendering_ = {};
};

[[nodiscard]] bool has_depth_bias(const Pass& pass);

}  // namespace dermis::gpu
