#include "dermis/report/model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dermis/base/text.h"

namespace dermis::inline report {

// RDNA has two SIMDs a compute unit, GCN four (AMD, "RDNA Architecture" white paper, 2019, page 8).
std::span<const Card> cards() {
    static constexpr Card kCards[] = {
        {.chip = "navi21",
         .name = "Radeon RX 6900 XT",
         .clock_ghz = 2.015,
         .compute_units = 80,
         .simds_per_unit = 2,
         .bandwidth_gb_s = 512,
         .source = "AMD, product page of the Radeon RX 6900 XT, 2020: game clock 2015 MHz, 80 compute units, "
                   "16 Gbit/s over 256 bit"},
        {.chip = "navi31",
         .name = "Radeon RX 7900 XTX",
         .clock_ghz = 2.3,
         .compute_units = 96,
         .simds_per_unit = 2,
         .bandwidth_gb_s = 960,
         .source =
             "AMD, product page of the Radeon RX 7900 XTX, 2022: game clock 2300 MHz, 96 compute units, "
             "20 Gbit/s over 384 bit"},
        {.chip = "vega10",
         .name = "Radeon RX Vega 64",
         .clock_ghz = 1.546,
         .compute_units = 64,
         .simds_per_unit = 4,
         .bandwidth_gb_s = 483.8,
         .source =
             "AMD, product page of the Radeon RX Vega 64, 2017: boost clock 1546 MHz, 64 compute units, "
             "1.89 Gbit/s over 2048 bit"}};
    return kCards;
}

Result<const Card*> find_card(std::string_view chip) {
    const auto found = std::ranges::find(cards(), chip, &Card::chip);
    if (found != cards().end()) return &*found;
    std::vector<std::string> known;
    for (const Card& card : cards()) known.emplace_back(card.chip);
    return Error{unknown_name("chip", chip, known)};
}

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

void add_buffers(const Pass& pass, const gpu::FrameInputs& inputs, PassWork& work) {
    for (const ImageRead& buffer : pass.buffers) {
        const gpu::BufferInput& input = inputs.buffers.at(buffer.image);
        work.buffer_bytes += input.array ? input.array->bytes() : input.geometry->stream_bytes(input.stream);
    }
}

PassWork work_of(const PassList& list, const Pass& pass, const gpu::PassTiming& drawn,
                 const gpu::FrameInputs& inputs, int width, int height) {
    PassWork work = {.pass = pass.name};
    for (const auto& [name, texture] : inputs.textures)
        if (texture) work.textures[name] = {texture->bytes(), texture->bytes_per_texel()};
    if (pass.threads > 0) {
        work.threads = pass.threads;
        add_buffers(pass, inputs, work);
        return work;
    }
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
    return bytes + counts.buffer_bytes + counts.vertices * statistics.vertex_bytes +
           counts.indices * sizeof(uint32_t);
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
