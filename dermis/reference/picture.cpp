#include "dermis/reference/picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/reference/pixel_sampler.h"

namespace dermis {
namespace {

constexpr int kPassesBeforeResting = 16;
constexpr float kDarkShare = 0.05f;

// The places of samples within a pixel form blocks of kBlock that lie evenly (a net of the Owen sequence), so
// block means vary less than single samples suggest.
constexpr uint32_t kBlock = 4;

// Sums of squared differences from the mean, updated as in Welford 1962, so that small noise on bright light
// is not lost in rounding.
struct Spread {
    Vec3 mean, squares;
    float luminance_squares = 0;
    uint32_t count = 0;

    void add(Vec3 value) {
        const Vec3 before = value - mean;
        mean += before * (1.0f / float(++count));
        squares += before * (value - mean);
        luminance_squares += luminance(before) * luminance(value - mean);
    }
    // Turns a sum of squares into the variance of the mean.
    [[nodiscard]] float per_mean() const { return count < 2 ? 0 : 1 / (float(count) * float(count - 1)); }
};

// The samples of one pixel so far.
struct PixelState {
    Spread samples, blocks;
    Vec3 block_sum, diffuse, specular;
    float coverage = 0, skin = 0;

    [[nodiscard]] const Spread& spread() const { return blocks.count >= 2 ? blocks : samples; }
    [[nodiscard]] Vec3 variance() const { return spread().squares * spread().per_mean(); }
    [[nodiscard]] float luminance_variance() const {
        return spread().luminance_squares * spread().per_mean();
    }
    void add(const PixelSample& sample) {
        samples.add(sample.radiance());
        block_sum += sample.radiance();
        if (samples.count % kBlock == 0) {
            blocks.add(block_sum * (1.0f / kBlock));
            block_sum = {};
        }
        const float share = 1.0f / float(samples.count);
        diffuse += (sample.diffuse - diffuse) * share;
        specular += (sample.specular - specular) * share;
        coverage += (sample.coverage - coverage) * share;
        skin += (sample.skin - skin) * share;
    }
};

struct Canvas {
    int width, height;
    std::vector<PixelState> pixels;
    std::vector<uint8_t> active;
};

// The luminance below which an error is measured relative to this one: a part of the brightest percentile of
// surfaces.
float least_luminance(const Canvas& canvas) {
    std::vector<float> values;
    for (const PixelState& pixel : canvas.pixels)
        if (pixel.coverage > 0) values.push_back(luminance(pixel.samples.mean));
    if (values.empty()) return 1;
    const auto at = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.99);
    std::nth_element(values.begin(), at, values.end());
    return std::max(kDarkShare * *at, 1e-12f);
}

std::vector<float> relative_errors(const Canvas& canvas) {
    const float least = least_luminance(canvas);
    std::vector<float> errors;
    for (const PixelState& pixel : canvas.pixels) {
        const float deviation = std::sqrt(pixel.luminance_variance());
        errors.push_back(pixel.coverage > 0 ? deviation / std::max(luminance(pixel.samples.mean), least)
                                            : -1.0f);
    }
    return errors;
}

double root_mean_square(const std::vector<float>& errors) {
    double sum = 0;
    size_t count = 0;
    for (const float e : errors)
        if (e >= 0) {
            sum += double(e) * e;
            ++count;
        }
    return count > 0 ? std::sqrt(sum / double(count)) : 0;
}

// Sampling of a pixel stops when its error and its eight neighbours' are small enough: where a pixel's error
// is underestimated by chance, its neighbours' are not.
void let_rest(Canvas& canvas, const std::vector<float>& errors, double wanted) {
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            float worst = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, canvas.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, canvas.width - 1); ++u)
                    worst = std::max(worst, errors[size_t(v) * size_t(canvas.width) + size_t(u)]);
            canvas.active[size_t(y) * size_t(canvas.width) + size_t(x)] = worst > wanted;
        }
}

struct WalkCounts {
    std::atomic<size_t> walks = 0, lost = 0;
};

// False when stopped: some rows have one sample more than others then.
bool run_pass(const PixelSampler& sampler, int pass, Canvas& canvas, WalkCounts& counts,
              const std::atomic<bool>* stop) {
    std::atomic<bool> complete = true;
    parallel_for(size_t(canvas.height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            if (stop && stop->load(std::memory_order_relaxed)) {
                complete = false;
                return;
            }
            size_t walks = 0, lost = 0;
            for (size_t x = 0; x < size_t(canvas.width); ++x) {
                const size_t i = y * size_t(canvas.width) + x;
                if (!canvas.active[i]) continue;
                const PixelSample sample = sampler.sample(int(x), int(y), uint32_t(pass));
                canvas.pixels[i].add(sample);
                walks += size_t(sample.walks);
                lost += size_t(sample.lost_walks);
            }
            counts.walks += walks;
            counts.lost += lost;
        }
    });
    return complete;
}

void put(Image& image, size_t pixel, Vec3 value) {
    float* at = &image.floats()[pixel * size_t(image.channels)];
    at[0] = value.x;
    at[1] = value.y;
    at[2] = value.z;
}

ReferencePicture develop(const Canvas& canvas) {
    const int w = canvas.width, h = canvas.height;
    ReferencePicture picture{.radiance = Image(w, h, 4),
                             .diffuse = Image(w, h, 3),
                             .specular = Image(w, h, 3),
                             .variance = Image(w, h, 3),
                             .samples = Image(w, h, 1),
                             .skin = Image(w, h, 1)};
    for (size_t i = 0; i < canvas.pixels.size(); ++i) {
        const PixelState& pixel = canvas.pixels[i];
        put(picture.radiance, i, pixel.samples.mean);
        picture.radiance.floats()[4 * i + 3] = pixel.coverage;
        put(picture.diffuse, i, pixel.diffuse);
        put(picture.specular, i, pixel.specular);
        put(picture.variance, i, pixel.variance());
        picture.samples.floats()[i] = float(pixel.samples.count);
        picture.skin.floats()[i] = pixel.skin;
    }
    return picture;
}

Result<void> check_settings(const ReferenceSettings& s) {
    const auto out_of_range = [](std::string_view what, auto value, std::string_view range) {
        return Error{std::string(what) + " is " + std::to_string(value) + ", not within " +
                     std::string(range)};
    };
    if (Result<void> good =
            check_image_size(uint64_t(std::max(s.width, 0)), uint64_t(std::max(s.height, 0)), 4);
        !good)
        return good.error();
    if (s.samples < 2 || s.samples > 65536) return out_of_range("samples a pixel", s.samples, "2..65536");
    if (s.probes < 2 || s.probes > 65536 || s.probes % 2)
        return out_of_range("probes", s.probes, "2..65536, even");
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

// The part of the work that is done: by passes, or by the error, which falls as one over the square root of
// the work.
double share_done(const ReferenceSettings& settings, int pass, double error) {
    const double by_passes = double(pass) / settings.samples;
    if (!settings.noise || error <= 0 || pass < 2) return by_passes;
    const double ratio = *settings.noise / error;
    return std::clamp(std::max(by_passes, ratio * ratio), 0.0, 1.0);
}

}  // namespace

Result<ScatteringMedium> medium_of_scene(const Scene& scene) {
    Result<Profile> profile = find_profile(scene.skin.profile);
    if (!profile) return profile.error();
    return walk_medium_of(*profile);
}

Result<ReferencePicture> render_reference(const Scene& scene, const ReferenceSettings& settings,
                                          const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    if (Result<void> good = check_settings(settings); !good) return good.error();
    const auto start = std::chrono::steady_clock::now();
    Result<std::unique_ptr<PixelSampler>> sampler = PixelSampler::create(scene, settings);
    if (!sampler) return sampler.error();
    const size_t count = size_t(settings.width) * size_t(settings.height);
    Canvas canvas{settings.width, settings.height, std::vector<PixelState>(count),
                  std::vector<uint8_t>(count, 1)};
    WalkCounts counts;
    double error = 0;
    int pass = 0;
    while (pass < settings.samples) {
        if (!run_pass(**sampler, pass, canvas, counts, stop)) break;
        ++pass;
        if (pass >= 2) {
            const std::vector<float> errors = relative_errors(canvas);
            error = root_mean_square(errors);
            if (settings.noise && pass >= kPassesBeforeResting && pass % int(kBlock) == 0) {
                if (error <= *settings.noise) break;
                let_rest(canvas, errors, *settings.noise);
            }
        }
        if (progress) progress(share_done(settings, pass, error));
    }
    if (pass == 0) return Error{"stopped before the first pass was complete: there is no picture yet"};
    ReferencePicture picture = develop(canvas);
    picture.relative_error = error;
    picture.reached_noise = !settings.noise || error <= *settings.noise;
    picture.passes = pass;
    picture.walks = counts.walks;
    picture.lost_walks = counts.lost;
    if (picture.lost_walks > 0)
        picture.warnings.push_back(
            std::to_string(picture.lost_walks) + " of " + std::to_string(picture.walks) +
            " walks were lost: the skin has holes, and the picture is too dark near them");
    picture.time_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

}  // namespace dermis
