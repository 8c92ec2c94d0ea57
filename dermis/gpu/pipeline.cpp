#include "dermis/gpu/pipeline.h"

#include <algorithm>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"
#include "dermis/gpu/graphics_state.h"
#include "dermis/gpu/plan.h"

namespace dermis::gpu {
namespace {

// Pipelines that some executor used in the last runs are kept whatever their number: executors take turns.
constexpr uint64_t kIdlePipelineRuns = 8;

// A shader stage ready for creation; the module lives as long as this. Points into itself.
struct Stage {
    OwnedShader module;
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<int32_t> values;
    VkSpecializationInfo specialization = {};
    VkPipelineShaderStageCreateInfo info = {};
};

int32_t constant_value(const Context& context, const ListedPass& listed,
                       const SpecializationConstant& constant) {
    for (const auto& [name, value] : listed.pass.constants)
        if (name == constant.name) return value;
    for (const auto& [name, value] : listed.list.constants)
        if (name == constant.name) return value;
    if (constant.name == "on_cpu") return context.is_cpu;
    return int32_t(constant.default_value);
}

// A misspelt constant would silently leave the shader's default in place.
Result<void> check_constants(const Pass& pass, std::span<const Shader* const> shaders) {
    std::vector<std::string> declared;
    for (const Shader* shader : shaders)
        for (const SpecializationConstant& constant : shader->interface.constants)
            declared.push_back(constant.name);
    for (const auto& [name, value] : pass.constants)
        if (std::ranges::find(declared, name) == declared.end())
            return Error{unknown_name("specialisation constant", name, declared)};
    return {};
}

Result<void> make_stage(const Context& context, const ListedPass& pass, const Shader& shader,
                        const Pipeline& pipeline, Stage& stage) {
    const std::vector<uint32_t> words = renumbered(shader, pipeline);
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = words.size() * 4,
                                           .pCode = words.data()};
    DERMIS_TRY_ASSIGN(stage.module, make<OwnedShader>(context, context.vk.vkCreateShaderModule, info,
                                                      "load shader '" + shader.name + "'"));
    const VkShaderModule module = stage.module.get();
    set_object_name(context, VK_OBJECT_TYPE_SHADER_MODULE, module, shader.name);
    for (const SpecializationConstant& constant : shader.interface.constants) {
        stage.entries.push_back({constant.id, uint32_t(stage.values.size() * 4), 4});
        stage.values.push_back(constant_value(context, pass, constant));
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

void add_shader(Hasher& hash, const Context& context, const ListedPass& pass, const Shader& shader) {
    hash.add(shader.hash);
    for (const SpecializationConstant& constant : shader.interface.constants)
        hash.add(constant.id).add(constant_value(context, pass, constant));
}

std::string graphics_key(const Context& context, const ListedPass& listed, const Shader& vertex,
                         const Shader* fragment, const TargetFormats& formats) {
    const Pass& pass = listed.pass;
    Hasher hash;
    add_shader(hash, context, listed, vertex);
    if (fragment) add_shader(hash, context, listed, *fragment);
    for (size_t i = 0; i < formats.colors.size(); ++i)
        hash.add(formats.colors[i]).add(pass.colors[i].blend).add(pass.colors[i].write_mask);
    hash.add("depth").add(formats.depth).add(formats.samples).add(pass.cull).add(has_depth_bias(pass));
    if (pass.depth) hash.add(pass.depth->write).add(pass.depth->compare);
    return hash.hex();
}

std::string compute_key(const Context& context, const ListedPass& pass, const Shader& shader) {
    Hasher hash;
    hash.add("compute");
    add_shader(hash, context, pass, shader);
    return hash.hex();
}

// Layout first: the modules carry its binding numbers.
Result<std::vector<Stage>> make_stages(Device::State& device, const ListedPass& pass,
                                       std::span<const Shader* const> shaders, Pipeline& pipeline) {
    DERMIS_TRY(check_constants(pass.pass, shaders));
    DERMIS_TRY(merge_interface(shaders, pipeline));
    DERMIS_TRY(make_layout(device, pipeline));
    std::vector<Stage> stages(shaders.size());
    for (size_t i = 0; i < shaders.size(); ++i)
        DERMIS_TRY(make_stage(device.context, pass, *shaders[i], pipeline, stages[i]));
    return stages;
}

Result<Pipeline> build_graphics(Device::State& device, const ListedPass& listed, const Shader& vertex,
                                const Shader* fragment, const TargetFormats& formats) {
    const Pass& pass = listed.pass;
    DERMIS_TRY(check_stage_borders(pass, vertex, fragment));
    const Context& context = device.context;
    Pipeline pipeline;
    pipeline.inputs = vertex.interface.inputs;
    std::vector<const Shader*> shaders = {&vertex};
    if (fragment) shaders.push_back(fragment);
    DERMIS_TRY_ASSIGN(const std::vector<Stage> stages, make_stages(device, listed, shaders, pipeline));
    std::vector<VkPipelineShaderStageCreateInfo> stage_infos;
    for (const Stage& stage : stages) stage_infos.push_back(stage.info);
    const GraphicsState state(pass, formats, pipeline.inputs);
    const VkGraphicsPipelineCreateInfo info =
        state.info(stage_infos, pipeline.layout.get(), context.pipeline_flags());
    VkPipeline handle = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateGraphicsPipelines(context.device, device.pipeline_cache.get(),
                                                                 1, &info, nullptr, &handle);
    DERMIS_TRY(check(result, "build its pipeline"));
    pipeline.handle = OwnedPipeline(context, handle);
    return pipeline;
}

Result<Pipeline> build_compute(Device::State& device, const ListedPass& pass, const Shader& shader) {
    const Context& context = device.context;
    Pipeline pipeline;
    pipeline.bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
    pipeline.local_size = shader.interface.local_size;
    const Shader* const shaders[] = {&shader};
    DERMIS_TRY_ASSIGN(const std::vector<Stage> stages, make_stages(device, pass, shaders, pipeline));
    const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                              .flags = context.pipeline_flags(),
                                              .stage = stages.front().info,
                                              .layout = pipeline.layout.get()};
    VkPipeline handle = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateComputePipelines(context.device, device.pipeline_cache.get(),
                                                                1, &info, nullptr, &handle);
    DERMIS_TRY(check(result, "build its pipeline"));
    pipeline.handle = OwnedPipeline(context, handle);
    return pipeline;
}

}  // namespace

Result<const Pipeline*> PipelineStore::find_or_build(const std::string& key, const Pass& pass,
                                                     const std::function<Result<Pipeline>()>& build) {
    auto found = device_->pipelines.find(key);
    if (found == device_->pipelines.end()) {
        DERMIS_TRY_ASSIGN(Pipeline pipeline, build());
        set_object_name(device_->context, VK_OBJECT_TYPE_PIPELINE, pipeline.handle.get(), pass.name);
        auto kept = std::make_shared<const Pipeline>(std::move(pipeline));
        found = device_->pipelines.emplace(key, KeptPipeline{std::move(kept)}).first;
    }
    found->second.last_run = device_->runs;
    return found->second.pipeline.get();
}

Result<const Pipeline*> PipelineStore::graphics(const ListedPass& pass, const Shader& vertex,
                                                const Shader* fragment, const TargetFormats& formats) {
    return find_or_build(graphics_key(device_->context, pass, vertex, fragment, formats), pass.pass,
                         [&] { return build_graphics(*device_, pass, vertex, fragment, formats); });
}

Result<const Pipeline*> PipelineStore::compute(const ListedPass& pass, const Shader& shader) {
    return find_or_build(compute_key(device_->context, pass, shader), pass.pass,
                         [&] { return build_compute(*device_, pass, shader); });
}

void PipelineStore::begin_run() {
    ++device_->runs;
    auto& pipelines = device_->pipelines;
    while (pipelines.size() > device_->most_pipelines) {
        const auto oldest =
            std::ranges::min_element(pipelines, {}, [](const auto& entry) { return entry.second.last_run; });
        if (oldest->second.last_run + kIdlePipelineRuns >= device_->runs) break;
        pipelines.erase(oldest);
    }
}

std::string_view vertex_shader_name(const Pass& pass) {
    if (!pass.vertex_shader.empty()) return pass.vertex_shader;
    if (pass.kind == PassKind::geometry_screen) return "renderer/mesh_screen.vert";
    if (pass.kind == PassKind::geometry_uv_atlas) return "renderer/mesh_uv_atlas.vert";
    return pass.kind == PassKind::geometry_light ? "renderer/mesh_light.vert" : "renderer/fullscreen.vert";
}

namespace {

TargetFormats target_formats(const PassList& list, const Pass& pass) {
    TargetFormats formats;
    const auto declared = [&](const std::string& name) {
        const ImageDeclaration& image = *list.find_image(name);
        formats.samples = uint32_t(image.samples);
        return format_info(image.format).format;
    };
    for (const ColorTarget& target : pass.colors) formats.colors.push_back(declared(target.image));
    if (pass.depth) formats.depth = declared(pass.depth->image);
    return formats;
}

Result<const Pipeline*> find_pipeline(const PassList& list, const Pass& pass, ShaderLibrary& shaders,
                                      PipelineStore& pipelines) {
    if (pass.kind == PassKind::compute) {
        DERMIS_TRY_ASSIGN(const Shader* shader, shaders.get(pass.shader, VK_SHADER_STAGE_COMPUTE_BIT));
        return pipelines.compute({list, pass}, *shader);
    }
    DERMIS_TRY_ASSIGN(const Shader* vertex,
                      shaders.get(vertex_shader_name(pass), VK_SHADER_STAGE_VERTEX_BIT));
    const Shader* fragment = nullptr;
    if (!pass.shader.empty()) {
        DERMIS_TRY_ASSIGN(fragment, shaders.get(pass.shader, VK_SHADER_STAGE_FRAGMENT_BIT));
    }
    return pipelines.graphics({list, pass}, *vertex, fragment, target_formats(list, pass));
}

}  // namespace

Result<const Pipeline*> pass_pipeline(const PassList& list, const Pass& pass, ShaderLibrary& shaders,
                                      PipelineStore& pipelines) {
    if (is_transfer(pass.kind) || (pass.kind == PassKind::fullscreen && pass.shader.empty()))
        return static_cast<const Pipeline*>(nullptr);
    const Result<const Pipeline*> pipeline = find_pipeline(list, pass, shaders, pipelines);
    return pipeline ? pipeline : pipeline.error().within(pass_label(pass));
}

}  // namespace dermis::gpu
