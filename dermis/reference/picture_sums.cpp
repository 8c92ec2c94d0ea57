#include "dermis/reference/picture_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dermis/image/colour.h"
#include "dermis/reference/pixel_sampler.h"

namespace dermis::inline reference {
namespace {

constexpr float kDarkShare = 0.05f;

// Sums the channels of one sample and counts those that had to be cut.
struct ChannelAdder {
    PixelState& pixel;
    size_t cut = 0;

    float fitting(float value) { return within_brightest(value, cut); }
    Vec3 fitting(Vec3 value) { return within_brightest(value, cut); }
    void add(const SumLayout& layout, Vec3 value) {
        pixel.sums[layout.first].add(value.x);
        pixel.sums[layout.first + 1].add(value.y);
        pixel.sums[layout.first + 2].add(value.z);
    }
};

double weighted(const std::array<double, 3>& c) {
    return c[0] * double(kLuminanceWeights.x) + c[1] * double(kLuminanceWeights.y) +
           c[2] * double(kLuminanceWeights.z);
}

// The variance of the mean of n values from their sum and the sum of their squares:
// (n sum(b^2) - sum(b)^2) / (n^2 (n - 1)). The difference is taken in pairs of doubles (Dekker 1971, "A
// floating-point technique for extending the available precision"), so that small noise on bright light is
// not lost in rounding.
double variance_of_mean(double n, double squares, double squares_rest, double sum, double sum_rest) {
    const double left = n * squares, right = sum * sum;
    const double left_rest = std::fma(n, squares, -left) + n * squares_rest;
    const double right_rest = std::fma(sum, sum, -right) + 2 * sum * sum_rest;
    return std::max(0.0, (left - right) + (left_rest - right_rest)) / (n * n * (n - 1));
}

// Sums of the means of whole blocks, a channel each.
std::array<ExactSum, 3> block_sums(const PixelState& pixel) {
    std::array<ExactSum, 3> sums;
    for (size_t c = 0; c < 3; ++c) {
        ExactSum unfinished;
        unfinished.add(pixel.block[c]);
        sums[c] = pixel.sums[kRadianceSum.first + c];
        sums[c] -= unfinished;
    }
    return sums;
}

// The luminance below which an error is measured relative to this one: a part of the brightest percentile of
// surfaces.
float least_luminance(const PictureSums& sums) {
    std::vector<float> values;
    for (const PixelState& pixel : sums.pixels)
        if (!pixel.sums[kCoverageSum.first].is_zero()) values.push_back(luminance(pixel.mean(kRadianceSum)));
    if (values.empty()) return 1;
    const auto at = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.99);
    std::nth_element(values.begin(), at, values.end());
    return std::max(kDarkShare * *at, 1e-12f);
}

void put(Image& image, size_t pixel, Vec3 value) {
    float* at = &image.floats()[pixel * size_t(image.channels)];
    at[0] = value.x;
    at[1] = value.y;
    at[2] = value.z;
}

// One digit, so that the batches of a reference say the same.
std::string percent_text(double percent) {
    char text[32];
    std::snprintf(text, sizeof text, percent >= 10 ? "%.0f %%" : "%.1g %%", percent);
    return text;
}

}  // namespace

float within_brightest(float value, size_t& cut) {
    if (std::abs(value) <= kBrightest) return value;
    ++cut;
    return std::isnan(value) ? 0 : std::copysign(kBrightest, value);
}

Vec3 within_brightest(Vec3 value, size_t& cut) {
    return {within_brightest(value.x, cut), within_brightest(value.y, cut), within_brightest(value.z, cut)};
}

void add_fault_warnings(size_t walks, size_t lost_walks, size_t cut_channels,
                        std::vector<std::string>& warnings) {
    // What fewer take away is far below the noise of any picture.
    constexpr double kLostShare = 1e-5;
    if (double(lost_walks) > kLostShare * double(walks))
        warnings.push_back(
            percent_text(100 * double(lost_walks) / double(walks)) +
            " of the walks were lost: the skin has holes, and the picture is too dark near them");
    if (cut_channels > 0)
        warnings.push_back(
            std::to_string(cut_channels) + " channels of samples were not finite, or above " +
            std::to_string(int(kBrightest)) +
            " and counted as that: lower the lights, or raise the roughness that they reflect in");
}

void EarlySpread::add(Vec3 value) {
    const Vec3 before = value - mean;
    mean += before * (1.0f / float(++count));
    squares += before * (value - mean);
    luminance_squares += luminance(before) * luminance(value - mean);
}

size_t PixelState::add(const PixelSample& sample) {
    ChannelAdder adder{*this};
    const Vec3 radiance = adder.fitting(sample.radiance());
    adder.add(kRadianceSum, radiance);
    adder.add(kDiffuseSum, adder.fitting(sample.diffuse));
    adder.add(kSpecularSum, adder.fitting(sample.specular));
    sums[kCoverageSum.first].add(adder.fitting(sample.coverage));
    sums[kSkinSum.first].add(adder.fitting(sample.skin));
    if (early.count < 2 * kSampleBlock) early.add(radiance);
    block[0] += double(radiance.x);
    block[1] += double(radiance.y);
    block[2] += double(radiance.z);
    if (++count % kSampleBlock == 0) {
        for (double& channel : block) channel /= kSampleBlock;
        for (size_t c = 0; c < 3; ++c) sums[kBlockSquaresSum.first + c].add(block[c] * block[c]);
        sums[kBlockLuminanceSquaresSum.first].add(weighted(block) * weighted(block));
        block = {};
    }
    return adder.cut;
}

void PixelState::add(const PixelState& other) {
    for (size_t i = 0; i < kSumCount; ++i) sums[i] += other.sums[i];
    count += other.count;
}

Vec3 PixelState::mean(const SumLayout& of) const {
    if (count == 0) return {};
    const auto channel = [&](size_t c) { return float(sums[of.first + c].value() / double(count)); };
    return of.channels == 1 ? Vec3{channel(0), 0, 0} : Vec3{channel(0), channel(1), channel(2)};
}

Vec3 PixelState::variance() const {
    const uint32_t blocks = count / kSampleBlock;
    if (blocks < 2) return count < 2 ? Vec3{} : early.squares * (1 / (float(count) * float(count - 1)));
    const std::array<ExactSum, 3> sums_of_blocks = block_sums(*this);
    const auto channel = [&](size_t c) {
        const ExactSum &squares = sums[kBlockSquaresSum.first + c], &sum = sums_of_blocks[c];
        return float(variance_of_mean(blocks, squares.value(), squares.remainder(),
                                      sum.value() / kSampleBlock, sum.remainder() / kSampleBlock));
    };
    return {channel(0), channel(1), channel(2)};
}

float PixelState::luminance_variance() const {
    const uint32_t blocks = count / kSampleBlock;
    if (blocks < 2) return count < 2 ? 0 : early.luminance_squares * (1 / (float(count) * float(count - 1)));
    const std::array<ExactSum, 3> sum = block_sums(*this);
    const ExactSum& squares = sums[kBlockLuminanceSquaresSum.first];
    const double luminance_sum = weighted({sum[0].value(), sum[1].value(), sum[2].value()}) / kSampleBlock;
    return float(variance_of_mean(blocks, squares.value(), squares.remainder(), luminance_sum, 0));
}

void PictureSums::add(const PictureSums& other) {
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i].add(other.pixels[i]);
    walks += other.walks;
    lost_walks += other.lost_walks;
    cut_channels += other.cut_channels;
}

std::vector<float> relative_errors(const PictureSums& sums) {
    const float least = least_luminance(sums);
    std::vector<float> errors;
    errors.reserve(sums.pixels.size());
    for (const PixelState& pixel : sums.pixels) {
        const float deviation = std::sqrt(pixel.luminance_variance());
        const bool shows = !pixel.sums[kCoverageSum.first].is_zero();
        errors.push_back(shows ? deviation / std::max(luminance(pixel.mean(kRadianceSum)), least) : -1.0f);
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

ReferencePicture picture_of(const PictureSums& sums) {
    const int w = sums.width, h = sums.height;
    ReferencePicture picture{.radiance = Image(w, h, 4),
                             .diffuse = Image(w, h, 3),
                             .specular = Image(w, h, 3),
                             .variance = Image(w, h, 3),
                             .samples = Image(w, h, 1),
                             .skin = Image(w, h, 1)};
    uint32_t most = 0;
    for (size_t i = 0; i < sums.pixels.size(); ++i) {
        const PixelState& pixel = sums.pixels[i];
        put(picture.radiance, i, pixel.mean(kRadianceSum));
        picture.radiance.floats()[4 * i + 3] = pixel.mean(kCoverageSum).x;
        put(picture.diffuse, i, pixel.mean(kDiffuseSum));
        put(picture.specular, i, pixel.mean(kSpecularSum));
        put(picture.variance, i, pixel.variance());
        picture.samples.floats()[i] = float(pixel.count);
        picture.skin.floats()[i] = pixel.mean(kSkinSum).x;
        most = std::max(most, pixel.count);
    }
    picture.passes = int(most);
    picture.relative_error = most >= 2 ? root_mean_square(relative_errors(sums)) : 0;
    picture.walks = sums.walks;
    picture.lost_walks = sums.lost_walks;
    add_fault_warnings(sums.walks, sums.lost_walks, sums.cut_channels, picture.warnings);
    return picture;
}

}  // namespace dermis::inline reference
