#include "dermis/report/work.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dermis::inline report {
namespace {

constexpr int kSmaller = 4;

bool rasterises(const Pass& pass) {
    return pass.kind == PassKind::fullscreen || pass.kind == PassKind::geometry_screen ||
           pass.kind == PassKind::geometry_uv_atlas || pass.kind == PassKind::geometry_light;
}

// Texels of the level that the pass draws into.
uint64_t target_texels(const PassList& list, const Pass& pass, int width, int height) {
    const ColorTarget* color = pass.colors.empty() ? nullptr : &pass.colors.front();
    const std::string& name = color                  ? color->image
                              : pass.depth           ? pass.depth->image
                              : pass.storage.empty() ? pass.reads.front().image
                                                     : pass.storage.front().image;
    const TexelSize size = size_in_frame(list.find_image(name)->size, width, height);
    const int mip = color ? color->mip : 0;
    return uint64_t(std::max(size.width >> mip, 1)) * uint64_t(std::max(size.height >> mip, 1));
}

void add_draws(const Pass& pass, const gpu::FrameInputs& inputs, PassWork& work) {
    std::set<const gpu::Texture*> seen;
    for (const gpu::Draw& draw : inputs.draws) {
        if (!gpu::takes(pass.geometry, draw.draw_class)) continue;
        work.vertices += std::min(draw.geometry->vertex_count(), draw.index_count);
        work.indices += draw.index_count;
        for (const auto& [name, texture] : draw.textures) {
            if (!seen.insert(texture).second) continue;
            TextureBytes& sum = work.textures[name];
            sum.bytes += texture->bytes();
            sum.bytes_per_texel = std::max(sum.bytes_per_texel, texture->bytes_per_texel());
        }
    }
}

PassWork work_of(const PassList& list, const Pass& pass, const gpu::PassTiming& drawn,
                 const gpu::FrameInputs& inputs, int width, int height) {
    PassWork work = {.pass = pass.name};
    for (const auto& [name, texture] : inputs.textures)
        if (texture) work.textures[name] = {texture->bytes(), texture->bytes_per_texel()};
    const uint64_t texels = target_texels(list, pass, width, height);
    if (pass.kind == PassKind::compute) work.threads = texels;
    if (!rasterises(pass)) return work;
    const double scale = drawn.target_texels ? double(texels) / double(drawn.target_texels) : 0;
    work.fragments = uint64_t(std::llround(double(drawn.samples_passed) * scale));
    if (pass.kind == PassKind::fullscreen)
        work.vertices = 3;
    else
        add_draws(pass, inputs, work);
    return work;
}

}  // namespace

Result<FrameWork> count_work(Renderer& renderer, const Contestant& contestant, int width, int height) {
    const DrawSettings settings = {.width = std::max(width / kSmaller, 1),
                                   .height = std::max(height / kSmaller, 1)};
    Result<gpu::FrameResult> drawn = gpu::FrameResult{};
    for (int frame = 0; frame < 2; ++frame) {
        drawn = renderer.draw(*contestant.technique, contestant.values, settings);
        if (!drawn) return Error{contestant.name() + ": " + drawn.error().message};
    }
    FrameWork work = {.width = width, .height = height, .list = renderer.list()};
    const gpu::FrameInputs inputs = renderer.inputs(contestant.values, settings);
    for (size_t i = 0; i < work.list.passes.size(); ++i)
        work.passes.push_back(
            work_of(work.list, work.list.passes[i], drawn->passes[i], inputs, width, height));
    return work;
}

}  // namespace dermis::inline report
