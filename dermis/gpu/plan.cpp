#include "dermis/gpu/plan.h"

#include <algorithm>

#include "dermis/gpu/pass_pipeline.h"

namespace dermis::gpu {
namespace {

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
            Result<void> ok = is_transfer(pass.kind)           ? plan_transfer(context_, planned)
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
        if (Result<void> ok = targets(planned); !ok) return ok;
        if (Result<void> ok = find_pipeline(planned); !ok || !planned.pipeline) return ok;
        if (Result<void> ok = resolver_.push_constants(planned); !ok) return ok;
        const std::string_view vertex_name = vertex_shader_name(pass);
        return is_geometry(pass.kind) ? geometry(planned, vertex_name) : fullscreen(planned, vertex_name);
    }

    Result<void> find_pipeline(PlannedPass& planned) {
        const Result<const Pipeline*> pipeline =
            pass_pipeline(context_.list, *planned.pass, context_.shaders, context_.pipelines);
        if (!pipeline) return pipeline.error();
        planned.pipeline = *pipeline;
        return {};
    }

    Result<void> targets(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        for (const ColorTarget& target : pass.colors) {
            FrameImage* image = context_.images.find(target.image);
            if (is_depth(image->declaration.format))
                return pass_error(pass, "'" + target.image + "' is a depth image, no colour target");
            if (target.mip < 0 || uint32_t(target.mip) >= image->image.info.mips)
                return pass_error(pass,
                                  "'" + target.image + "' has no mip level " + std::to_string(target.mip));
            const VkFormat format = image->image.info.format;
            if (target.blend != Blend::none &&
                !context_.device.context.can(format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
                return pass_error(pass, context_.device.info.name + " cannot blend into " +
                                            std::string(format_name(image->declaration.format)));
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
        planned.accesses.push_back(
            {.image = image,
             .use = only_tests(*pass.depth) ? ImageUse::depth_test : ImageUse::depth_target,
             .discard = pass.depth->load != LoadOp::load});
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
            for (const StageVariable& input : planned.pipeline->inputs)
                if (Result<void> ok = check_stream(pass, vertex_name, geometry, input); !ok) return ok;
            PlannedDraw& target =
                planned.draws.emplace_back(PlannedDraw{.indices = resolver_.place(geometry.indices),
                                                       .first_index = draw.first_index,
                                                       .index_count = draw.index_count,
                                                       .scissor = draw.scissor});
            for (const StageVariable& input : planned.pipeline->inputs)
                target.vertices.push_back(resolver_.place(geometry.streams.find(input.name)->second.data));
            if (Result<void> ok = resolver_.resolve(planned, target, &draw); !ok) return ok;
        }
        return {};
    }

    static Result<void> check_stream(const Pass& pass, std::string_view vertex_name,
                                     const Geometry::State& geometry, const StageVariable& input) {
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
        if (Result<void> ok = find_pipeline(planned); !ok) return ok;
        planned.extent = context_.images.find(pass.storage.front().image)->extent();
        for (const ImageRead& storage : pass.storage)
            planned.accesses.push_back(
                {.image = context_.images.find(storage.image), .use = ImageUse::storage});
        if (Result<void> ok = resolver_.push_constants(planned); !ok) return ok;
        return resolver_.resolve(planned, planned.draws.emplace_back(), nullptr);
    }

    const PlanContext& context_;
    Plan plan_;
    BindingResolver resolver_;
};

}  // namespace

bool takes(GeometryFilter filter, DrawClass draw) {
    switch (filter) {
        case GeometryFilter::skin:
            return draw == DrawClass::skin;
        case GeometryFilter::other:
            return draw == DrawClass::other;
        case GeometryFilter::blended:
            return draw == DrawClass::blended;
        case GeometryFilter::opaque:
            return draw != DrawClass::translucent;
        case GeometryFilter::translucent:
            return draw == DrawClass::translucent;
        case GeometryFilter::all:
            return true;
    }
    return false;
}

bool is_transfer(PassKind kind) {
    return kind == PassKind::resolve || kind == PassKind::generate_mips || kind == PassKind::copy;
}

bool only_tests(const DepthTarget& depth) {
    return depth.load == LoadOp::load && !depth.write;
}

bool is_geometry(PassKind kind) {
    return kind == PassKind::geometry_screen || kind == PassKind::geometry_uv_atlas ||
           kind == PassKind::geometry_light;
}

Result<Plan> make_plan(const PlanContext& context) {
    return Planner(context).run();
}

}  // namespace dermis::gpu
