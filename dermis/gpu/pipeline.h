#pragma once
// Pipelines by content: the same shaders with the same constants and state are built once for a device.

#include <map>

#include "dermis/gpu/device_state.h"
#include "dermis/gpu/reflection.h"

namespace dermis::gpu {

struct Pipeline {
    OwnedSetLayout set_layout;
    OwnedPipelineLayout layout;
    OwnedPipeline handle;
    VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
    std::vector<Binding> bindings;    ///< of all stages; the index is the binding number
    bool pushes_descriptors = false;  ///< otherwise each draw has a set of a pool (frame_descriptors.h)
    BlockLayout push_constants;
    VkShaderStageFlags push_stages = 0;
    std::vector<StageVariable> inputs;  ///< the index is the vertex buffer binding
    std::array<uint32_t, 3> local_size = {1, 1, 1};
};

/// A pass and what its list has for all of them.
struct ListedPass {
    const PassList& list;
    const Pass& pass;
};

/// The targets a graphics pipeline is built for.
struct TargetFormats {
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    uint32_t samples = 1;
};

/// The device's pipelines, for one executor.
class PipelineStore {
  public:
    explicit PipelineStore(Device::State& device) : device_(&device) {}

    /// `fragment` is null for depth-only passes. Errors: stages that disagree about a name, an output that is
    /// missing.
    [[nodiscard]] Result<const Pipeline*> graphics(const ListedPass& pass, const Shader& vertex,
                                                   const Shader* fragment, const TargetFormats& formats);
    [[nodiscard]] Result<const Pipeline*> compute(const ListedPass& pass, const Shader& shader);

    /// Once a run; destroys what was idle longest when there is much of it (DeviceOptions::most_pipelines).
    void begin_run();
    [[nodiscard]] size_t size() const { return device_->pipelines.size(); }

  private:
    [[nodiscard]] Result<const Pipeline*> find_or_build(const std::string& key, const Pass& pass,
                                                        const std::function<Result<Pipeline>()>& build);

    Device::State* device_;
};

/// Every target has an output, every input of the fragment shader an output of the vertex shader.
[[nodiscard]] Result<void> check_stage_borders(const Pass& pass, const Shader& vertex,
                                               const Shader* fragment);

/// One interface for all stages: bindings united by name, numbered in order.
[[nodiscard]] Result<void> merge_interface(std::span<const Shader* const> stages, Pipeline& pipeline);

/// The shader's words with the merged binding numbers, set 0.
[[nodiscard]] std::vector<uint32_t> renumbered(const Shader& shader, const Pipeline& pipeline);

/// Descriptor set layout and pipeline layout; decides whether the descriptors are pushed.
[[nodiscard]] Result<void> make_layout(Device::State& device, Pipeline& pipeline);

/// The vertex shader that a pass names, or the shared one of its kind.
[[nodiscard]] std::string_view vertex_shader_name(const Pass& pass);

/// The executor draws with it; statistics.h compiles the same one for another chip. `list` has no problems()
/// (pass_list.h). Null: a transfer, or a pass that only clears. Errors name the pass.
[[nodiscard]] Result<const Pipeline*> pass_pipeline(const PassList& list, const Pass& pass,
                                                    ShaderLibrary& shaders, PipelineStore& pipelines);

}  // namespace dermis::gpu
