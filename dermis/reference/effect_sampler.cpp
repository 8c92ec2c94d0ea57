#include "dermis/reference/effect_sampler.h"

#include <thread>

#include "dermis/base/parallel.h"
#include "dermis/rays/random.h"
#include "dermis/reference/picture_sums.h"
#include "dermis/reference/pixel_sampler.h"

namespace dermis::inline reference {
namespace {

struct Faults {
    uint64_t walks = 0, lost_walks = 0;
    size_t cut = 0;
};

// One half of one pixel: samples begin <= i < end.
struct HalfPixel {
    uint32_t seed;
    int x, y;
    uint32_t begin, end;
};

// `mean` holds the mean of the samples before.
void add_samples(const PixelSampler& sampler, const HalfPixel& half, float* mean, Faults& faults) {
    double sum[3] = {};
    for (uint32_t i = half.begin; i < half.end; ++i) {
        const PixelSample sample = sampler.sample(half.seed, half.x, half.y, i);
        const Vec3 value = within_brightest(sample.scattered, faults.cut);
        sum[0] += double(value.x);
        sum[1] += double(value.y);
        sum[2] += double(value.z);
        faults.walks += uint64_t(sample.walks);
        faults.lost_walks += uint64_t(sample.lost_walks);
    }
    for (size_t c = 0; c < 3; ++c)
        mean[c] = float((double(mean[c]) * half.begin + sum[c]) / double(half.end));
}

}  // namespace

EffectSampler::EffectSampler(std::unique_ptr<PixelSampler> sampler, const ReferenceSettings& settings)
    : sampler_(std::move(sampler)), settings_(settings) {}
EffectSampler::~EffectSampler() = default;
EffectSampler::EffectSampler(EffectSampler&&) noexcept = default;

Result<EffectSampler> EffectSampler::create(const Scene& scene, const ReferenceSettings& settings) {
    ReferenceSettings own = settings;
    own.noise = {};
    own.samples = 2 * own.grid * own.grid;
    DERMIS_TRY(check(own));
    DERMIS_TRY_ASSIGN(std::unique_ptr<PixelSampler> sampler,
                      PixelSampler::create(scene, own, Measure::effect));
    return EffectSampler(std::move(sampler), own);
}

Image EffectSampler::skin() const {
    Image skin(settings_.width, settings_.height, 1);
    const auto width = size_t(skin.width);
    const auto cells = uint32_t(settings_.grid * settings_.grid);
    parallel_for(size_t(skin.height), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin * width; i < end * width; ++i) {
            double sum = 0;
            for (uint32_t cell = 0; cell < cells; ++cell)
                sum += double(sampler_->skin(settings_.seed, int(i % width), int(i / width), cell));
            skin.floats()[i] = float(sum / cells);
        }
    });
    return skin;
}

bool EffectSampler::raise(std::span<const uint32_t> counts, EffectSamples& samples,
                          const ReferenceProgress& progress, const std::atomic<bool>* stop) const {
    uint64_t all = 0;
    for (size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > samples.counts[i]) all += counts[i] - samples.counts[i];
    const auto width = size_t(samples.a.width);
    const uint32_t seeds[2] = {hash_u32(settings_.seed, 0), hash_u32(settings_.seed, 1)};
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> complete = true;
    std::atomic<uint64_t> done = 0, walks = 0, lost = 0, cut = 0;
    parallel_for(size_t(samples.a.height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            if (stop && stop->load(std::memory_order_relaxed)) {
                complete = false;
                return;
            }
            Faults faults;
            uint64_t row = 0;
            for (size_t i = y * width; i < (y + 1) * width; ++i) {
                const uint32_t first = samples.counts[i], last = counts[i];
                if (last <= first) continue;
                const int x = int(i - y * width);
                add_samples(*sampler_, {seeds[0], x, int(y), first, last}, &samples.a.floats()[3 * i],
                            faults);
                add_samples(*sampler_, {seeds[1], x, int(y), first, last}, &samples.b.floats()[3 * i],
                            faults);
                samples.counts[i] = last;
                row += last - first;
            }
            walks += faults.walks;
            lost += faults.lost_walks;
            cut += faults.cut;
            done += row;
            if (progress && row > 0 && std::this_thread::get_id() == caller)
                progress(double(done) / double(all));
        }
    });
    samples.walks += walks;
    samples.lost_walks += lost;
    samples.cut_channels += cut;
    return complete;
}

}  // namespace dermis::inline reference
