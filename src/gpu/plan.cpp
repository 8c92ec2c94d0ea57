#include "dermis/gpu/plan.h"

#include <algorithm>

namespace dermis::gpu {
namespace {

std::string_view default_vertex_shader(PassKind kind) {
    switch (kind) {
        case PassKind::geometry_screen:
            return "shared/mesh_screen.vert";
        case PassKind::geometry_uv_atlas:
            return "shared/mesh_uv_atlas.vert";
        case PassKind::geometry_light:
            return "shared/mesh_light.vert";
        default:
            return "shared/fullscreen.vert";
    }
}

bool takes(GeometryFilter filter, DrawClass draw) {
    switch (filter) {
        case GeometryFilter::skin:
            return draw == DrawClass::skin;
        case GeometryFilter::other:
            return draw == DrawClass::other;
        case GeometryFilter::opaque:
            return draw != DrawClass::translucent;
        case GeometryFilter::translucent:
            return draw == DrawClass::translucent;
        case GeometryFilter::all:
            return true;
    }
    return false;
}

Error pass_error(const Pass& pass, const std::string& what) {
    return Error{pass_label(pass) + ": " + what};
}

// Plans one pass after another into one plan.
class Planner {
  public:
    explicit Planner(const PlanContext& context) : context_(context), resolver_(context, plan_) {}

    Result<Plan> run() {
        for (const Pass& pass : context_.list.passes) {
            PlannedPass planned{.pass = &pass};
            Result<void> ok = is_transfer(pass.kind)           ? transfer(planned)
                              : pass.kind == PassKind::compute ? compute(planned)
                                                               : raster(planned);
            if (!ok) return ok.error();
            plan_.passes.push_back(std::move(planned));
        }
        return std::move(plan_);
    }

  private:
    Result<void> raster(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        TargetFormats formats;
        if (Result<void> ok = targets(planned, formats); !ok) return ok;
        if (pass.kind == PassKind::fullscreen && pass.shader.empty()) return {};  // only clears
        const std::string_view vertex_name =
            pass.vertex_shader.empty() ? default_vertex_shader(pass.kind) : pass.vertex_shader;
        const Result<const Shader*> vertex = context_.shaders.get(vertex_name, VK_SHADER_STAGE_VERTEX_BIT);
        if (!vertex) return pass_error(pass, vertex.error().message);
        const Shader* fragment = nullptr;
        if (!pass.shader.empty()) {
            const Result<const Shader*> shader =
                context_.shaders.get(pass.shader, VK_SHADER_STAGE_FRAGMENT_BIT);
            if (!shader) return pass_error(pass, shader.error().message);
            fragment = *shader;
        }
        const Result<const Pipeline*> pipeline =
            context_.pipelines.graphics(pass, **vertex, fragment, formats);
        if (!pipeline) return pass_error(pass, pipeline.error().message);
        planned.pipeline = *pipeline;
        if (Result<void> ok = resolver_.push_constants(planned); !ok) return ok;
        return is_geometry(pass.kind) ? geometry(planned, vertex_name) : fullscreen(planned, vertex_name);
    }

    Result<void> targets(PlannedPass& planned, TargetFormats& formats) {
        const Pass& pass = *planned.pass;
        for (const ColorTarget& target : pass.colors) {
            FrameImage* image = context_.images.find(target.image);
            if (is_depth(image->declaration.format))
                return pass_error(pass, "'" + target.image + "' is a depth image, no colour target");
            if (target.mip < 0 || uint32_t(target.mip) >= image->image.info.mips)
                return pass_error(pass,
                                  "'" + target.image + "' has no mip level " + std::to_string(target.mip));
            formats.colors.push_back(image->image.info.format);
            formats.samples = image->image.info.samples;
            if (Result<void> ok = extent(planned, target.image, image->extent(target.mip)); !ok) return ok;
            planned.accesses.push_back({.image = image,
                                        .first_mip = uint32_t(target.mip),
                                        .use = ImageUse::color_target,
                                        .discard = target.load != LoadOp::load});
        }
        if (!pass.depth) return {};
        FrameImage* image = context_.images.find(pass.depth->image);
        if (!is_depth(image->declaration.format))
            return pass_error(pass, "depth target '" + pass.depth->image + "' has a colour format");
        formats.depth = image->image.info.format;
        formats.samples = image->image.info.samples;
        planned.accesses.push_back(
            {.image = image, .use = ImageUse::depth_target, .discard = pass.depth->load != LoadOp::load});
        return extent(planned, pass.depth->image, image->extent());
    }

    static Result<void> extent(PlannedPass& planned, const std::string& name, VkExtent2D size) {
        if (planned.extent.width == 0) planned.extent = size;
        if (planned.extent.width == size.width && planned.extent.height == size.height) return {};
        return pass_error(*planned.pass, "target '" + name + "' differs in size from the first target");
    }

    Result<void> fullscreen(PlannedPass& planned, std::string_view vertex_name) {
        if (!planned.pipeline->inputs.empty())
            return pass_error(*planned.pass, "vertex shader '" + std::string(vertex_name) +
                                                 "' of a full-screen pass must have no inputs");
        return resolver_.resolve(planned, planned.draws.emplace_back(), nullptr);
    }

    Result<void> geometry(PlannedPass& planned, std::string_view vertex_name) {
        const Pass& pass = *planned.pass;
        for (const Draw& draw : context_.inputs.draws) {
            if (!takes(pass.geometry, draw.draw_class)) continue;
            const Geometry::State& geometry = draw.geometry->state();
            if (draw.index_count == 0) continue;
            if (uint64_t(draw.first_index) + draw.index_count > geometry.index_count)
                return pass_error(pass, "a draw goes beyond the indices of geometry '" + geometry.name + "'");
            for (const VertexInput& input : planned.pipeline->inputs)
                if (Result<void> ok = check_stream(pass, vertex_name, geometry, input); !ok) return ok;
            PlannedDraw& target =
                planned.draws.emplace_back(PlannedDraw{&geometry, draw.first_index, draw.index_count, {}});
            if (Result<void> ok = resolver_.resolve(planned, target, &draw); !ok) return ok;
        }
        return {};
    }

    static Result<void> check_stream(const Pass& pass, std::string_view vertex_name,
                                     const Geometry::State& geometry, const VertexInput& input) {
        const auto stream = geometry.streams.find(input.name);
        const std::string what =
            "vertex shader '" + std::string(vertex_name) + "' wants input '" + input.name + "'";
        if (stream == geometry.streams.end())
            return pass_error(pass, what + ", which geometry '" + geometry.name + "' lacks");
        if (stream->second.components != input.components)
            return pass_error(pass, what + " with " + std::to_string(input.components) +
                                        " components; geometry '" + geometry.name + "' has it with " +
                                        std::to_string(stream->second.components));
        return {};
    }

    Result<void> compute(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        if (pass.storage.empty()) return pass_error(pass, "a compute pass needs a storage image");
        const Result<const Shader*> shader = context_.shaders.get(pass.shader, VK_SHADER_STAGE_COMPUTE_BIT);
        if (!shader) return pass_error(pass, shader.error().message);
        const Result<const Pipeline*> pipeline = context_.pipelines.compute(pass, **shader);
        if (!pipeline) return pass_error(pass, pipeline.error().message);
        planned.pipeline = *pipeline;
        planned.extent = context_.images.find(pass.storage.front().image)->extent();
        for (const ImageRead& storage : pass.storage)
            planned.accesses.push_back(
                {.image = context_.images.find(storage.image), .use = ImageUse::storage});
        if (Result<void> ok = resolver_.push_constants(planned); !ok) return ok;
        return resolver_.resolve(planned, planned.draws.emplace_back(), nullptr);
    }

    // A transfer works on images of the list alone; the recorder knows how.
    Result<void> transfer(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        FrameImage* source = context_.images.find(pass.reads.front().image);
        if (!source) return pass_error(pass, "'" + pass.reads.front().image + "' is no image of the list");
        if (pass.kind == PassKind::generate_mips) return generate_mips(planned, source);
        const std::string& target_name = pass.colors.empty() ? pass.depth->image : pass.colors.front().image;
        const int mip = pass.colors.empty() ? 0 : pass.colors.front().mip;
        FrameImage* target = context_.images.find(target_name);
        if (mip < 0 || uint32_t(mip) >= target->image.info.mips)
            return pass_error(pass, "'" + target_name + "' has no mip level " + std::to_string(mip));
        planned.extent = target->extent(mip);
        return pass.kind == PassKind::resolve ? resolve(planned, source, target, mip)
                                              : copy(planned, source, target, mip);
    }

    Result<void> generate_mips(PlannedPass& planned, FrameImage* image) {
        if (is_depth(image->declaration.format) || image->declaration.samples > 1)
            return pass_error(*planned.pass, "only colour images with one sample have mips generated");
        planned.extent = image->extent();
        planned.accesses.push_back({.image = image, .use = ImageUse::copy_source});
        return {};
    }

    Result<void> resolve(PlannedPass& planned, FrameImage* source, FrameImage* target, int mip) {
        const ImageInfo &from = source->image.info, &to = target->image.info;
        const bool same_size =
            from.extent.width == planned.extent.width && from.extent.height == planned.extent.height;
        if (from.samples < 2 || to.samples != 1 || from.format != to.format || !same_size)
            return pass_error(*planned.pass,
                              "resolve needs a multisampled source and a target of the same format and size");
        const ImageUse use =
            is_depth(source->declaration.format) ? ImageUse::depth_target : ImageUse::color_target;
        planned.accesses = {{.image = source, .use = use},
                            {.image = target, .first_mip = uint32_t(mip), .use = use, .discard = true}};
        return {};
    }

    Result<void> copy(PlannedPass& planned, FrameImage* source, FrameImage* target, int mip) {
        const ImageInfo &from = source->image.info, &to = target->image.info;
        const bool same = from.format == to.format && from.extent.width == planned.extent.width &&
                          from.extent.height == planned.extent.height && from.samples == to.samples;
        const bool depth = is_depth(source->declaration.format) || is_depth(target->declaration.format);
        if (!same && (depth || from.samples > 1 || to.samples > 1))
            return pass_error(*planned.pass,
                              "copy of depth or multisampled images needs the same format, "
                              "size and sample count");
        planned.accesses = {
            {.image = source, .use = ImageUse::copy_source},
            {.image = target, .first_mip = uint32_t(mip), .use = ImageUse::copy_target, .discard = true}};
        return {};
    }

    const PlanContext& context_;
    Plan plan_;
    BindingResolver resolver_;
};

}  // namespace

bool is_transfer(PassKind kind) {
    return kind == PassKind::resolve || kind == PassKind::generate_mips || kind == PassKind::copy;
}

bool is_geometry(PassKind kind) {
    return kind == PassKind::geometry_screen || kind == PassKind::geometry_uv_atlas ||
           kind == PassKind::geometry_light;
}

Result<Plan> make_plan(const PlanContext& context) {
    return Planner(context).run();
}

}  // namespace dermis::gpu
