#include "dermis/gpu/pipeline.h"

#include <algorithm>

#include "dermis/base/hash.h"

namespace dermis::gpu {
namespace {

// More than this many pipelines, and those that have been idle for kIdleRuns go.
constexpr size_t kManyPipelines = 256;
constexpr uint64_t kIdleRuns = 64;

// A shader stage ready for creation; the module lives as long as this.
struct Stage {
    OwnedShader module;
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<int32_t> values;
    VkSpecializationInfo specialization = {};
    VkPipelineShaderStageCreateInfo info = {};
};

int32_t constant_value(const Pass& pass, const SpecializationConstant& constant) {
    const auto named =
        std::ranges::find(pass.constants, constant.name, &std::pair<std::string, int32_t>::first);
    return named == pass.constants.end() ? int32_t(constant.default_value) : named->second;
}

Result<void> make_stage(const Context& context, const Pass& pass, const Shader& shader,
                        const Pipeline& pipeline, Stage& stage) {
    const std::vector<uint32_t> words = renumbered(shader, pipeline);
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = words.size() * 4,
                                           .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateShaderModule(context.device, &info, nullptr, &module);
    if (Result<void> ok = check(result, "load shader '" + shader.name + "'"); !ok) return ok;
    stage.module = OwnedShader(context, module);
    set_object_name(context, VK_OBJECT_TYPE_SHADER_MODULE, module, shader.name);
    for (const SpecializationConstant& constant : shader.interface.constants) {
        stage.entries.push_back({constant.id, uint32_t(stage.values.size() * 4), 4});
        stage.values.push_back(constant_value(pass, constant));
    }
    stage.specialization = {uint32_t(stage.entries.size()), stage.entries.data(), stage.values.size() * 4,
                            stage.values.data()};
    stage.info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = shader.interface.stage,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &stage.specialization};
    return {};
}

void add_shader(Hasher& hash, const Pass& pass, const Shader& shader) {
    hash.add(shader.hash);
    for (const SpecializationConstant& constant : shader.interface.constants)
        hash.add(constant.id).add(constant_value(pass, constant));
}

bool has_bias(const Pass& pass) {
    return pass.depth_bias_constant != 0 || pass.depth_bias_slope != 0;
}

std::string graphics_key(const Pass& pass, const Shader& vertex, const Shader* fragment,
                         const TargetFormats& formats) {
    Hasher hash;
    add_shader(hash, pass, vertex);
    if (fragment) add_shader(hash, pass, *fragment);
    for (size_t i = 0; i < formats.colors.size(); ++i)
        hash.add(formats.colors[i]).add(pass.colors[i].blend).add(pass.colors[i].write_mask);
    hash.add("depth").add(formats.depth).add(formats.samples).add(pass.cull).add(has_bias(pass));
    if (pass.depth) hash.add(pass.depth->write).add(pass.depth->compare);
    return hash.hex();
}

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

// One buffer a stream, tightly packed floats.
struct VertexLayout {
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
    explicit VertexLayout(const std::vector<VertexInput>& inputs) {
        constexpr VkFormat kFormats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                         VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
        for (const VertexInput& input : inputs) {
            const auto binding = uint32_t(bindings.size());
            bindings.push_back({binding, uint32_t(input.components) * 4, VK_VERTEX_INPUT_RATE_VERTEX});
            attributes.push_back({input.location, binding, kFormats[input.components - 1], 0});
        }
    }
};

Result<void> build_graphics(Device::State& device, const Pass& pass, std::span<const Stage> stages,
                            const TargetFormats& formats, Pipeline& pipeline) {
    const Context& context = device.context;
    std::vector<VkPipelineShaderStageCreateInfo> stage_infos;
    for (const Stage& stage : stages) stage_infos.push_back(stage.info);
    const VertexLayout vertices(pipeline.inputs);
    const VkPipelineVertexInputStateCreateInfo vertex_input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = uint32_t(vertices.bindings.size()),
        .pVertexBindingDescriptions = vertices.bindings.data(),
        .vertexAttributeDescriptionCount = uint32_t(vertices.attributes.size()),
        .pVertexAttributeDescriptions = vertices.attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    // Clip space has y down as the framebuffer has, and camera matrices flip y on the way there: what is
    // counter-clockwise to a viewer in the right-handed world is counter-clockwise here.
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = cull_mode(pass.cull),
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .depthBiasEnable = has_bias(pass),
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo multisample = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VkSampleCountFlagBits(formats.samples)};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = pass.depth.has_value(),
        .depthWriteEnable = pass.depth && pass.depth->write,
        .depthCompareOp = pass.depth ? compare_op(pass.depth->compare) : VK_COMPARE_OP_ALWAYS};
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (const ColorTarget& target : pass.colors) blends.push_back(blend_state(target));
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = uint32_t(blends.size()),
        .pAttachments = blends.data()};
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                             VK_DYNAMIC_STATE_DEPTH_BIAS};
    const VkPipelineDynamicStateCreateInfo dynamic = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = has_bias(pass) ? 3u : 2u,
        .pDynamicStates = dynamic_states};
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = uint32_t(formats.colors.size()),
        .pColorAttachmentFormats = formats.colors.data(),
        .depthAttachmentFormat = formats.depth};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &rendering,
                                               .stageCount = uint32_t(stage_infos.size()),
                                               .pStages = stage_infos.data(),
                                               .pVertexInputState = &vertex_input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewport,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &multisample,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blend,
                                               .pDynamicState = &dynamic,
                                               .layout = pipeline.layout.get()};
    VkPipeline handle = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateGraphicsPipelines(context.device, device.pipeline_cache.get(),
                                                                 1, &info, nullptr, &handle);
    if (Result<void> ok = check(result, "build its pipeline"); !ok) return ok;
    pipeline.handle = OwnedPipeline(context, handle);
    set_object_name(context, VK_OBJECT_TYPE_PIPELINE, handle, pass.name);
    return {};
}

Result<void> check_outputs(const Pass& pass, const Shader* fragment) {
    for (size_t i = 0; i < pass.colors.size(); ++i)
        if (pass.colors[i].write_mask && (!fragment || !std::ranges::count(fragment->interface.outputs, i)))
            return Error{"target '" + pass.colors[i].image + "' needs an output at location " +
                         std::to_string(i) + ", which the shader lacks"};
    return {};
}

}  // namespace

Result<const Pipeline*> PipelineStore::graphics(const Pass& pass, const Shader& vertex,
                                                const Shader* fragment, const TargetFormats& formats) {
    const std::string key = graphics_key(pass, vertex, fragment, formats);
    if (const auto found = pipelines_.find(key); found != pipelines_.end()) {
        found->second.last_run = run_;
        return &found->second;
    }
    if (Result<void> ok = check_outputs(pass, fragment); !ok) return ok.error();
    Pipeline pipeline;
    pipeline.inputs = vertex.interface.inputs;
    pipeline.last_run = run_;
    std::vector<const Shader*> shaders = {&vertex};
    if (fragment) shaders.push_back(fragment);
    if (Result<void> ok = merge_interface(shaders, pipeline); !ok) return ok.error();
    if (Result<void> ok = make_layout(*device_, pipeline); !ok) return ok.error();
    std::vector<Stage> stages(shaders.size());
    for (size_t i = 0; i < shaders.size(); ++i)
        if (Result<void> ok = make_stage(device_->context, pass, *shaders[i], pipeline, stages[i]); !ok)
            return ok.error();
    if (Result<void> ok = build_graphics(*device_, pass, stages, formats, pipeline); !ok) return ok.error();
    return &pipelines_.emplace(key, std::move(pipeline)).first->second;
}

Result<const Pipeline*> PipelineStore::compute(const Pass& pass, const Shader& shader) {
    Hasher hash;
    hash.add("compute");
    add_shader(hash, pass, shader);
    const std::string key = hash.hex();
    if (const auto found = pipelines_.find(key); found != pipelines_.end()) {
        found->second.last_run = run_;
        return &found->second;
    }
    const Context& context = device_->context;
    Pipeline pipeline;
    pipeline.bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
    pipeline.local_size = shader.interface.local_size;
    pipeline.last_run = run_;
    const Shader* const stages[] = {&shader};
    if (Result<void> ok = merge_interface(stages, pipeline); !ok) return ok.error();
    if (Result<void> ok = make_layout(*device_, pipeline); !ok) return ok.error();
    Stage stage;
    if (Result<void> ok = make_stage(context, pass, shader, pipeline, stage); !ok) return ok.error();
    const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                              .stage = stage.info,
                                              .layout = pipeline.layout.get()};
    VkPipeline handle = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateComputePipelines(context.device, device_->pipeline_cache.get(),
                                                                1, &info, nullptr, &handle);
    if (Result<void> ok = check(result, "build its pipeline"); !ok) return ok.error();
    pipeline.handle = OwnedPipeline(context, handle);
    set_object_name(context, VK_OBJECT_TYPE_PIPELINE, handle, pass.name);
    return &pipelines_.emplace(key, std::move(pipeline)).first->second;
}

void PipelineStore::begin_run() {
    ++run_;
    if (pipelines_.size() <= kManyPipelines) return;
    std::erase_if(pipelines_, [&](const auto& entry) { return entry.second.last_run + kIdleRuns < run_; });
}

}  // namespace dermis::gpu
