#include "dermis/gpu/plan.h"

#include <fmt/core.h>

#include <algorithm>

#include "dermis/gpu/pipeline.h"

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
            DERMIS_TRY(is_transfer(pass.kind)           ? plan_transfer(context_, planned)
                       : pass.kind == PassKind::compute ? compute(planned)
                                                        : raster(planned));
            plan_.passes.push_back(std::move(planned));
        }
        return std::move(plan_);
    }

  private:
    Result<void> raster(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        DERMIS_TRY(targets(planned));
        if (Result<void> ok = find_pipeline(planned); !ok || !planned.pipeline) return ok;
        DERMIS_TRY(resolver_.push_constants(planned));
        const std::string_view vertex_name = vertex_shader_name(pass);
        return is_geometry(pass.kind) ? geometry(planned, vertex_name) : fullscreen(planned, vertex_name);
    }

    Result<void> find_pipeline(PlannedPass& planned) {
        DERMIS_TRY_ASSIGN(planned.pipeline,
                          pass_pipeline(context_.list, *planned.pass, context_.shaders, context_.pipelines));
        return {};
    }

    Result<void> targets(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        for (const ColorTarget& target : pass.colors) {
            FrameImage* image = context_.images.find(target.image);
            if (is_depth(image->declaration.format))
                return pass_error(pass, "'" + target.image + "' is a depth image, no colour target");
            if (target.mip < 0 || uint32_t(target.mip) >= image->image.info.mips)
                return pass_error(pass, fmt::format("'{}' has no mip level {}", target.image, target.mip));
            const VkFormat format = image->image.info.format;
            if (target.blend != Blend::none &&
                !context_.device.context.can(format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
                return pass_error(pass, fmt::format("{} cannot blend into {}", context_.device.info.name,
                                                    format_name(image->declaration.format)));
            DERMIS_TRY(extent(planned, target.image, image->extent(target.mip)));
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
            return pass_error(
                *planned.pass,
                fmt::format("vertex shader '{}' of a full-screen pass must have no inputs", vertex_name));
        return resolver_.resolve(planned, planned.draws.emplace_back(), nullptr);
    }

    Result<void> geometry(PlannedPass& planned, std::string_view vertex_name) {
        const Pass& pass = *planned.pass;
        for (const Draw& draw : context_.inputs.draws) {
            if (!takes(pass.geometry, draw.draw_class)) continue;
            if (pass.only_profile && draw.profile != pass.profile) continue;
            const Geometry::State& geometry = draw.geometry->state();
            if (draw.index_count == 0) continue;
            if (uint64_t(draw.first_index) + draw.index_count > geometry.index_count)
                return pass_error(pass, "a draw goes beyond the indices of geometry '" + geometry.name + "'");
            for (const StageVariable& input : planned.pipeline->inputs)
                DERMIS_TRY(check_stream(pass, vertex_name, geometry, input));
            PlannedDraw& target =
                planned.draws.emplace_back(PlannedDraw{.indices = resolver_.place(geometry.indices),
                                                       .first_index = draw.first_index,
                                                       .index_count = draw.index_count,
                                                       .scissor = draw.scissor});
            for (const StageVariable& input : planned.pipeline->inputs)
                target.vertices.push_back(resolver_.place(geometry.streams.find(input.name)->second.data));
            DERMIS_TRY(resolver_.resolve(planned, target, &draw));
        }
        return {};
    }

    static Result<void> check_stream(const Pass& pass, std::string_view vertex_name,
                                     const Geometry::State& geometry, const StageVariable& input) {
        const auto stream = geometry.streams.find(input.name);
        const std::string what = fmt::format("vertex shader '{}' wants input '{}'", vertex_name, input.name);
        if (stream == geometry.streams.end())
            return pass_error(pass, what + ", which geometry '" + geometry.name + "' lacks");
        if (stream->second.components != input.components)
            return pass_error(pass, fmt::format("{} with {} components; geometry '{}' has it with {}", what,
                                                input.components, geometry.name, stream->second.components));
        return {};
    }

    Result<void> compute(PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        if (pass.storage.empty() && pass.threads == 0)
            return pass_error(pass, "a compute pass needs a storage image, or buffers and threads");
        DERMIS_TRY(find_pipeline(planned));
        planned.extent = {pass.threads, 1};
        if (!pass.storage.empty())
            planned.extent = context_.images.find(pass.storage.front().image)->extent();
        for (const ImageRead& storage : pass.storage)
            planned.accesses.push_back(
                {.image = context_.images.find(storage.image), .use = ImageUse::storage});
        DERMIS_TRY(resolver_.push_constants(planned));
        return resolver_.resolve(planned, planned.draws.emplace_back(), nullptr);
    }

    const PlanContext& context_;
    Plan plan_;
    BindingResolver resolver_;
};

}  // namespace

bool takes(GeometryFilter filter, DrawClass draw) {
    if (filter == GeometryFilter::all) return true;
    if (filter == GeometryFilter::opaque) return draw != DrawClass::translucent;
    constexpr std::pair<GeometryFilter, DrawClass> kSame[] = {
        {GeometryFilter::skin, DrawClass::skin},
        {GeometryFilter::other, DrawClass::other},
        {GeometryFilter::blended, DrawClass::blended},
        {GeometryFilter::translucent, DrawClass::translucent}};
    return std::ranges::find(kSame, std::pair(filter, draw)) != std::end(kSame);
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

// Passes without shaders: their images, and whether the device can copy them.

namespace {

bool has_extent(const FrameImage& image, VkExtent2D extent) {
    return image.extent().width == extent.width && image.extent().height == extent.height;
}

// A scaling copy reads its source with a filter, which the format must allow.
Result<void> check_blit(const Context& context, const PlannedPass& planned, const FrameImage& source,
                        const FrameImage& target) {
    constexpr VkFormatFeatureFlags kSource =
        VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (context.can(source.image.info.format, kSource) &&
        context.can(target.image.info.format, VK_FORMAT_FEATURE_BLIT_DST_BIT))
        return {};
    return pass_error(*planned.pass, fmt::format("{} cannot scale {} to {}", context.properties.deviceName,
                                                 format_name(source.declaration.format),
                                                 format_name(target.declaration.format)));
}

Result<void> generate_mips(const Context& context, PlannedPass& planned, FrameImage& image) {
    if (is_depth(image.declaration.format) || image.declaration.samples > 1)
        return pass_error(*planned.pass, "only colour images with one sample have mips generated");
    planned.extent = image.extent();
    planned.accesses = {{.image = &image, .use = ImageUse::copy_source}};
    return check_blit(context, planned, image, image);
}

Result<void> resolve(PlannedPass& planned, FrameImage& source, FrameImage& target, uint32_t mip) {
    const ImageInfo &from = source.image.info, &to = target.image.info;
    if (from.samples < 2 || to.samples != 1 || from.format != to.format ||
        !has_extent(source, planned.extent))
        return pass_error(*planned.pass,
                          "resolve needs a multisampled source and a target of the same format and size");
    const ImageUse use =
        is_depth(source.declaration.format) ? ImageUse::depth_target : ImageUse::color_target;
    planned.accesses = {{.image = &source, .use = use},
                        {.image = &target, .first_mip = mip, .use = use, .discard = true}};
    return {};
}

Result<void> copy(const Context& context, PlannedPass& planned, FrameImage& source, FrameImage& target,
                  uint32_t mip) {
    const ImageInfo &from = source.image.info, &to = target.image.info;
    const bool same =
        from.format == to.format && from.samples == to.samples && has_extent(source, planned.extent);
    const bool depth = is_depth(source.declaration.format) || is_depth(target.declaration.format);
    if (!same && (depth || from.samples > 1 || to.samples > 1))
        return pass_error(
            *planned.pass,
            "copy of depth or multisampled images needs the same format, size and sample count");
    planned.accesses = {{.image = &source, .use = ImageUse::copy_source},
                        {.image = &target, .first_mip = mip, .use = ImageUse::copy_target, .discard = true}};
    return same ? Result<void>() : check_blit(context, planned, source, target);
}

}  // namespace

Result<void> plan_transfer(const PlanContext& context, PlannedPass& planned) {
    const Pass& pass = *planned.pass;
    const std::string& source_name = pass.reads.front().image;
    FrameImage* source = context.images.find(source_name);
    if (!source) return pass_error(*planned.pass, "'" + source_name + "' is not an image of the list");
    if (pass.kind == PassKind::generate_mips) return generate_mips(context.device.context, planned, *source);
    const std::string& target_name = pass.colors.empty() ? pass.depth->image : pass.colors.front().image;
    const int mip = pass.colors.empty() ? 0 : pass.colors.front().mip;
    FrameImage* target = context.images.find(target_name);
    if (mip < 0 || uint32_t(mip) >= target->image.info.mips)
        return pass_error(*planned.pass, fmt::format("'{}' has no mip level {}", target_name, mip));
    planned.extent = target->extent(mip);
    return pass.kind == PassKind::resolve
               ? resolve(planned, *source, *target, uint32_t(mip))
               : copy(context.device.context, planned, *source, *target, uint32_t(mip));
}

}  // namespace dermis::gpu
