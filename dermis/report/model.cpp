#include "dermis/report/model.h"

#include <algorithm>
#include <set>

namespace dermis::inline report {
namespace {

// The compiler's inverse throughput is of 64 threads, whatever the size of a subgroup.
constexpr double kThreadsPerUnit = 64;

bool is_transfer(PassKind kind) {
    return kind == PassKind::resolve || kind == PassKind::generate_mips || kind == PassKind::copy;
}

uint64_t texels_of(const FrameWork& work, const ImageDeclaration& image) {
    const TexelSize size = size_in_frame(image.size, work.width, work.height);
    return uint64_t(size.width) * uint64_t(size.height);
}

// Fragments write a texel each, and read it where it is blended or tested. Clears are free: all three chips
// keep them as a flag of a compressed block.
uint64_t attachment_bytes(const FrameWork& work, const Pass& pass, uint64_t fragments, uint64_t threads) {
    uint64_t bytes = 0;
    const auto texel_bytes = [&](const std::string& name) {
        return bytes_per_texel(work.list.find_image(name)->format);
    };
    for (const ColorTarget& target : pass.colors)
        bytes += fragments * texel_bytes(target.image) * (target.blend == Blend::none ? 1 : 2);
    if (pass.depth) bytes += fragments * texel_bytes(pass.depth->image) * (pass.depth->write ? 2 : 1);
    for (const ImageRead& storage : pass.storage) bytes += threads * texel_bytes(storage.image);
    return bytes;
}

// An image with as many texels as the target is read where the pass covers it, others whole; neighbours that
// a filter reads too come from the caches.
uint64_t read_bytes(const FrameWork& work, const Pass& pass, uint64_t fragments, uint64_t threads,
                    std::set<std::string>& names) {
    uint64_t bytes = 0, target_texels = 0;
    if (!pass.colors.empty()) target_texels = texels_of(work, *work.list.find_image(pass.colors[0].image));
    std::set<std::string> images;
    for (const ImageRead& read : pass.reads) {
        const ImageDeclaration* image = work.list.find_image(read.image);
        if (!image) continue;  // an input of the frame, counted by texture_bytes()
        names.insert(read.texture);
        if (!images.insert(read.image).second) continue;
        const uint64_t texels = texels_of(work, *image);
        const bool as_target = threads == 0 && texels == target_texels;
        bytes += (as_target ? std::min(fragments, texels) : texels) * bytes_per_texel(image->format);
    }
    return bytes;
}

// With mips a texture has about as many texels in the picture as the fragments that show it.
uint64_t texture_bytes(const Pass& pass, const PassWork& counts, const gpu::PassStatistics& statistics,
                       const std::set<std::string>& images) {
    uint64_t bytes = 0;
    for (const std::string& name : statistics.textures) {
        if (images.contains(name)) continue;
        const auto read = std::ranges::find(pass.reads, name, &ImageRead::texture);
        const auto found = counts.textures.find(read == pass.reads.end() ? name : read->image);
        if (found == counts.textures.end()) continue;
        const uint64_t threads = std::max(counts.fragments, counts.threads);
        bytes += std::min(found->second.bytes, threads * found->second.bytes_per_texel);
    }
    return bytes;
}

uint64_t transfer_bytes(const FrameWork& work, const Pass& pass) {
    const auto whole = [&](const std::string& name) {
        return bytes_in_frame(*work.list.find_image(name), work.width, work.height);
    };
    uint64_t bytes = 0;
    for (const ImageRead& read : pass.reads) bytes += whole(read.image);
    for (const ColorTarget& target : pass.colors) bytes += whole(target.image);
    return bytes;
}

uint64_t invocations(const PassWork& counts, const std::string& stage) {
    if (stage == "vertex") return counts.vertices;
    return stage == "compute" ? counts.threads : counts.fragments;
}

}  // namespace

uint64_t bytes_moved(const FrameWork& work, size_t index, const gpu::PassStatistics& statistics) {
    const Pass& pass = work.list.passes[index];
    const PassWork& counts = work.passes[index];
    if (is_transfer(pass.kind)) return transfer_bytes(work, pass);
    std::set<std::string> images;
    uint64_t bytes = attachment_bytes(work, pass, counts.fragments, counts.threads);
    bytes += read_bytes(work, pass, counts.fragments, counts.threads, images);
    bytes += texture_bytes(pass, counts, statistics, images);
    return bytes + counts.vertices * statistics.vertex_bytes + counts.indices * sizeof(uint32_t);
}

FrameCost model_frame(const FrameWork& work, const std::vector<gpu::PassStatistics>& statistics,
                      const Card& card) {
    FrameCost frame;
    for (size_t i = 0; i < work.passes.size(); ++i) {
        PassCost cost = {.pass = work.passes[i].pass, .bytes = bytes_moved(work, i, statistics[i])};
        for (const gpu::ShaderStatistics& shader : statistics[i].shaders) {
            const uint64_t count = invocations(work.passes[i], shader.stage);
            const double simd_cycles =
                double(count) / kThreadsPerUnit * double(shader.inverse_throughput_cycles);
            cost.shaders.push_back({shader, count, simd_cycles / card.simd_cycles_per_ms()});
            cost.arithmetic_ms += cost.shaders.back().arithmetic_ms;
        }
        cost.bandwidth_ms = double(cost.bytes) / card.bytes_per_ms();
        frame.passes.push_back(std::move(cost));
    }
    return frame;
}

Result<std::vector<FrameCost>> model_frames(const std::vector<FrameWork>& frames, const Card& card,
                                            const gpu::ShaderSource& shaders) {
    DERMIS_TRY_ASSIGN(gpu::NullDevice device, gpu::NullDevice::open(card.chip, shaders));
    std::vector<FrameCost> costs;
    for (const FrameWork& frame : frames) {
        DERMIS_TRY_ASSIGN(const auto statistics, device.compile(frame.list));
        costs.push_back(model_frame(frame, statistics, card));
    }
    return costs;
}

double FrameCost::model_ms() const {
    double sum = 0;
    for (const PassCost& pass : passes) sum += pass.model_ms();
    return sum;
}

}  // namespace dermis::inline report
