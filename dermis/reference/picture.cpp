#include "dermis/reference/picture.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/reference/facets.h"
#include "dermis/reference/picture_sums.h"
#include "dermis/reference/pixel_sampler.h"

namespace dermis::inline reference {
namespace {

constexpr int kPassesBeforeResting = 16;

struct Canvas {
    PictureSums sums;
    std::vector<uint8_t> active;
};

Canvas empty_canvas(const ReferenceSettings& settings) {
    const size_t count = size_t(settings.width) * size_t(settings.height);
    return {{.width = settings.width, .height = settings.height, .pixels = std::vector<PixelState>(count)},
            std::vector<uint8_t>(count, 1)};
}

// Sampling of a pixel stops when its error and its eight neighbours' are small enough: where a pixel's error
// is underestimated by chance, its neighbours' are not.
void let_rest(Canvas& canvas, const std::vector<float>& errors, double wanted) {
    const int width = canvas.sums.width, height = canvas.sums.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float worst = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                    worst = std::max(worst, errors[size_t(v) * size_t(width) + size_t(u)]);
            canvas.active[size_t(y) * size_t(width) + size_t(x)] = worst > wanted;
        }
}

// False when stopped: some rows have one sample more than others then.
bool run_pass(const PixelSampler& sampler, int pass, Canvas& canvas, const std::atomic<bool>* stop) {
    std::atomic<bool> complete = true;
    std::atomic<size_t> all_walks = 0, all_lost = 0, all_cut = 0;
    PictureSums& sums = canvas.sums;
    parallel_for(size_t(sums.height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            if (stop && stop->load(std::memory_order_relaxed)) {
                complete = false;
                return;
            }
            size_t walks = 0, lost = 0, cut = 0;
            for (size_t x = 0; x < size_t(sums.width); ++x) {
                const size_t i = y * size_t(sums.width) + x;
                if (!canvas.active[i]) continue;
                const PixelSample sample = sampler.sample(int(x), int(y), uint32_t(pass));
                cut += sums.pixels[i].add(sample);
                walks += size_t(sample.walks);
                lost += size_t(sample.lost_walks);
            }
            all_walks += walks;
            all_lost += lost;
            all_cut += cut;
        }
    });
    sums.walks += all_walks;
    sums.lost_walks += all_lost;
    sums.cut_channels += all_cut;
    return complete;
}

// The radiance where every `step`-th pixel of each direction has a sample; it fills those after it.
Image radiance_so_far(const Canvas& canvas, size_t step) {
    const PictureSums& sums = canvas.sums;
    Image radiance(sums.width, sums.height, 4);
    const auto width = size_t(sums.width);
    for (size_t i = 0; i < sums.pixels.size(); ++i) {
        const size_t x = i % width, y = i / width;
        const PixelState& from = sums.pixels[(y - y % step) * width + x - x % step];
        const Vec3 mean = from.mean(kRadianceSum);
        const float channels[] = {mean.x, mean.y, mean.z, from.mean(kCoverageSum).x};
        std::ranges::copy(channels, &radiance.floats()[4 * i]);
    }
    return radiance;
}

// The first pass in the order of finer lattices, so that a whole picture is there early.
bool run_first_pass(const PixelSampler& sampler, Canvas& canvas, const std::atomic<bool>* stop,
                    const ReferencePreview& preview) {
    constexpr size_t kCoarsest = 4;
    const auto width = size_t(canvas.sums.width);
    for (size_t step = kCoarsest; step > 0; step /= 2) {
        for (size_t i = 0; i < canvas.active.size(); ++i)
            canvas.active[i] =
                canvas.sums.pixels[i].count == 0 && i % width % step == 0 && i / width % step == 0;
        if (!run_pass(sampler, 0, canvas, stop)) return false;
        preview(radiance_so_far(canvas, step));
    }
    std::ranges::fill(canvas.active, uint8_t(1));
    return true;
}

// The part of the work that is done: by passes, or by the error, which falls as one over the square root of
// the work.
double share_done(const ReferenceSettings& settings, int pass, double error) {
    const double by_passes = double(pass) / settings.samples;
    if (!settings.noise || error <= 0 || pass < 2) return by_passes;
    const double ratio = *settings.noise / error;
    return std::clamp(std::max(by_passes, ratio * ratio), 0.0, 1.0);
}

}  // namespace

int probes_of(const ReferenceSettings& settings) {
    if (settings.integrator != Integrator::surface) return settings.probes != 0 ? settings.probes : 16;
    return std::max(settings.probes + kRuns - 1, kRuns) / kRuns * kRuns;
}

Result<void> check(const ReferenceSettings& s) {
    const auto out_of_range = [](std::string_view what, auto value, std::string_view range) {
        return Error{std::string(what) + " is " + std::to_string(value) + ", not within " +
                     std::string(range)};
    };
    if (Result<void> good =
            check_image_size(uint64_t(std::max(s.width, 0)), uint64_t(std::max(s.height, 0)), 4);
        !good)
        return good.error();
    if (s.samples < 2 || s.samples > kMostSamples)
        return out_of_range("samples a pixel", s.samples, "2..65536");
    const int probes = probes_of(s);
    if (s.probes < 0 || probes > 65536) return out_of_range("probes", s.probes, "1..65536");
    if (!(s.width_scale >= 0 && s.width_scale <= 1000))
        return out_of_range("width scale", s.width_scale, "0..1000");
    if (s.noise && !(*s.noise > 0 && *s.noise < 1))
        return out_of_range("noise", *s.noise, "0..1, both excluded");
    if (s.filter == PixelFilter::grid) {
        if (s.grid < 1 || s.grid > 16) return out_of_range("grid", s.grid, "1..16");
        if (s.samples % (s.grid * s.grid) != 0 || s.noise)
            return Error{"a grid of " + std::to_string(s.grid) + "x" + std::to_string(s.grid) +
                         " cells needs every cell equally often: a multiple of " +
                         std::to_string(s.grid * s.grid) + " samples, and no noise to stop at"};
    }
    if (!(s.lighting.penumbra_mm >= 0 && s.lighting.penumbra_mm <= 1000))
        return out_of_range("penumbra_mm", s.lighting.penumbra_mm, "0..1000");
    return {};
}

Result<std::vector<std::string>> walk_notes(const Scene& scene, const ReferenceSettings& settings) {
    std::vector<std::string> notes;
    if (settings.integrator != Integrator::walk || settings.medium) return notes;
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    for (std::string note : {walk_volume_note(profile), facets_note(scene)})
        if (!note.empty()) notes.push_back(std::move(note));
    return notes;
}

Result<ScatteringMedium> medium_of_scene(const Scene& scene) {
    DERMIS_TRY_ASSIGN(Profile profile, find_profile(scene.skin.profile));
    return walk_medium_of(profile);
}

Error stopped_without_a_picture() {
    return Error{"stopped while some pixels had no sample: there is no picture yet"};
}

Result<ReferencePicture> render_reference(const Scene& scene, const ReferenceSettings& settings,
                                          const ReferenceProgress& progress, const std::atomic<bool>* stop,
                                          const ReferencePreview& preview) {
    DERMIS_TRY(check(settings));
    const auto start = std::chrono::steady_clock::now();
    DERMIS_TRY_ASSIGN(std::unique_ptr<PixelSampler> sampler, PixelSampler::create(scene, settings));
    Canvas canvas = empty_canvas(settings);
    double error = 0;
    int pass = 0;
    while (pass < settings.samples) {
        if (!(pass == 0 && preview ? run_first_pass(*sampler, canvas, stop, preview)
                                   : run_pass(*sampler, pass, canvas, stop)))
            break;
        ++pass;
        if (preview && pass > 1 && std::has_single_bit(unsigned(pass))) preview(radiance_so_far(canvas, 1));
        if (settings.noise && pass >= 2) {
            const std::vector<float> errors = relative_errors(canvas.sums);
            error = root_mean_square(errors);
            if (pass >= kPassesBeforeResting && pass % kSampleBlock == 0) {
                if (error <= *settings.noise) break;
                let_rest(canvas, errors, *settings.noise);
            }
        }
        if (progress) progress(share_done(settings, pass, error));
    }
    if (pass == 0) return stopped_without_a_picture();
    ReferencePicture picture = picture_of(canvas.sums);
    DERMIS_TRY_ASSIGN(const std::vector<std::string> notes, walk_notes(scene, settings));
    picture.warnings.insert(picture.warnings.end(), notes.begin(), notes.end());
    picture.passes = pass;
    picture.reached_noise = !settings.noise || picture.relative_error <= *settings.noise;
    picture.time_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

Result<void> check_range(const ReferenceSettings& settings, SampleRange range) {
    const auto text = [](SampleRange r) { return std::to_string(r.begin) + ":" + std::to_string(r.end); };
    if (settings.noise)
        return Error{"a range needs a fixed number of samples: leave out --noise, set --samples"};
    if (settings.samples % kSampleBlock != 0 || settings.samples < 2 * kSampleBlock)
        return Error{
            "a picture made of parts has whole blocks of four samples a pixel, two at least; "
            "--samples is " +
            std::to_string(settings.samples)};
    if (range.begin >= 0 && range.begin < range.end && range.end <= settings.samples &&
        range.begin % kSampleBlock == 0 && range.end % kSampleBlock == 0)
        return {};
    return Error{"samples " + text(range) +
                 ": begin and end are multiples of four within 0:" + std::to_string(settings.samples) +
                 " (--samples), such as " + text({0, std::min(settings.samples, 16)})};
}

Result<PictureSums> sum_samples(const Scene& scene, const ReferenceSettings& settings, SampleRange range,
                                const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    DERMIS_TRY(check(settings));
    DERMIS_TRY(check_range(settings, range));
    DERMIS_TRY_ASSIGN(std::unique_ptr<PixelSampler> sampler, PixelSampler::create(scene, settings));
    Canvas canvas = empty_canvas(settings);
    for (int pass = range.begin; pass < range.end; ++pass) {
        if (!run_pass(*sampler, pass, canvas, stop))
            return Error{"stopped after " + std::to_string(pass - range.begin) + " of " +
                         std::to_string(range.end - range.begin) +
                         " samples a pixel: nothing is written; run the same command again"};
        if (progress) progress(double(pass + 1 - range.begin) / double(range.end - range.begin));
    }
    return std::move(canvas.sums);
}

}  // namespace dermis::inline reference
