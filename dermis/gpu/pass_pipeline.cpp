#include "dermis/gpu/pass_pipeline.h"

#include "dermis/gpu/plan.h"

namespace dermis::gpu {
namespace {

Result<const Pipeline*> raster_pipeline(const PassList& list, const Pass& pass, ShaderLibrary& shaders,
                                        PipelineStore& pipelines) {
    DERMIS_TRY_ASSIGN(const Shader* vertex,
                      shaders.get(vertex_shader_name(pass), VK_SHADER_STAGE_VERTEX_BIT));
    const Shader* fragment = nullptr;
    if (!pass.shader.empty()) {
        DERMIS_TRY_ASSIGN(const Shader* shader, shaders.get(pass.shader, VK_SHADER_STAGE_FRAGMENT_BIT));
        fragment = shader;
    }
    return pipelines.graphics({list, pass}, *vertex, fragment, target_formats(list, pass));
}

Result<const Pipeline*> compute_pipeline(const PassList& list, const Pass& pass, ShaderLibrary& shaders,
                                         PipelineStore& pipelines) {
    DERMIS_TRY_ASSIGN(const Shader* shader, shaders.get(pass.shader, VK_SHADER_STAGE_COMPUTE_BIT));
    return pipelines.compute({list, pass}, *shader);
}

}  // namespace

std::string_view vertex_shader_name(const Pass& pass) {
    if (!pass.vertex_shader.empty()) return pass.vertex_shader;
    switch (pass.kind) {
        case PassKind::geometry_screen:
            return "renderer/mesh_screen.vert";
        case PassKind::geometry_uv_atlas:
            return "renderer/mesh_uv_atlas.vert";
        case PassKind::geometry_light:
            return "renderer/mesh_light.vert";
        default:
            return "renderer/fullscreen.vert";
    }
}

TargetFormats target_formats(const PassList& list, const Pass& pass) {
    TargetFormats formats;
    for (const ColorTarget& target : pass.colors) {
        const ImageDeclaration& image = *list.find_image(target.image);
        formats.colors.push_back(format_info(image.format).format);
        formats.samples = uint32_t(image.samples);
    }
    if (!pass.depth) return formats;
    const ImageDeclaration& image = *list.find_image(pass.depth->image);
    formats.depth = format_info(image.format).format;
    formats.samples = uint32_t(image.samples);
    return formats;
}

Result<const Pipeline*> pass_pipeline(const PassList& list, const Pass& pass, ShaderLibrary& shaders,
                                      PipelineStore& pipelines) {
    if (is_transfer(pass.kind) || (pass.kind == PassKind::fullscreen && pass.shader.empty()))
        return static_cast<const Pipeline*>(nullptr);
    const Result<const Pipeline*> pipeline = pass.kind == PassKind::compute
                                                 ? compute_pipeline(list, pass, shaders, pipelines)
                                                 : raster_pipeline(list, pass, shaders, pipelines);
    if (!pipeline) return pipeline.error().within(pass_label(pass));
    return *pipeline;
}

}  // namespace dermis::gpu
