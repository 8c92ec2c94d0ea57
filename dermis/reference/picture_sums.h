#pragma once
// The sums over a picture's samples: what a range of samples leaves behind, and what pictures are made of.
// Sums of ranges add up to the sums of all samples, bit by bit, in any order and grouping.

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/reference/exact_sum.h"
#include "dermis/reference/picture.h"

namespace dermis::inline reference {

struct PixelSample;

/// The places of samples within a pixel form blocks of four that lie evenly (a net of the Owen sequence), so
/// block means vary less than single samples suggest. Sums of squares are of blocks, and a range of samples
/// has whole blocks.
inline constexpr int kSampleBlock = 4;
inline constexpr int kMostSamples = 65536;  ///< a pixel

/// A quantity that each pixel sums, and its place in PixelState::sums: `channels` sums from `first` on.
struct SumLayout {
    std::string_view name;
    size_t first, channels;
};
inline constexpr SumLayout kRadianceSum = {"radiance", 0, 3}, kDiffuseSum = {"diffuse", 3, 3},
                           kSpecularSum = {"specular", 6, 3}, kCoverageSum = {"coverage", 9, 1},
                           kSkinSum = {"skin", 10, 1}, kBlockSquaresSum = {"block_squares", 11, 3},
                           kBlockLuminanceSquaresSum = {"block_luminance_squares", 14, 1};
inline constexpr SumLayout kSumLayouts[] = {kRadianceSum,
                                            kDiffuseSum,
                                            kSpecularSum,
                                            kCoverageSum,
                                            kSkinSum,
                                            kBlockSquaresSum,
                                            kBlockLuminanceSquaresSum};
inline constexpr size_t kSumCount = 15;

/// A sample's channels count up to this; brighter ones as this. 65,536 of them, and the squares of as many
/// blocks, stay within ExactSum::kMost.
inline constexpr float kBrightest = 0x1p22f;
/// 0 for NaN. Counts in `cut` what is changed.
[[nodiscard]] float within_brightest(float value, size_t& cut);
[[nodiscard]] Vec3 within_brightest(Vec3 value, size_t& cut);

/// Sums of squared differences from the mean of single samples, updated as in Welford 1962. Used for the
/// error of pictures of less than two blocks alone, which no range of samples is.
struct EarlySpread {
    Vec3 mean, squares;
    float luminance_squares = 0;
    uint32_t count = 0;
    void add(Vec3 value);
};

/// The samples of one pixel so far.
struct PixelState {
    std::array<ExactSum, kSumCount> sums;
    std::array<double, 3> block{};  ///< sum of the samples after the last whole block
    uint32_t count = 0;
    EarlySpread early;

    /// The number of channels that were not finite or above kBrightest, and were cut.
    size_t add(const PixelSample& sample);
    /// Both states hold whole blocks.
    void add(const PixelState& other);

    [[nodiscard]] Vec3 mean(const SumLayout& of) const;
    /// Variance of the mean radiance.
    [[nodiscard]] Vec3 variance() const;
    [[nodiscard]] float luminance_variance() const;
};

/// A line each for walks that found no way out and channels that were cut.
void add_fault_warnings(size_t walks, size_t lost_walks, size_t cut_channels,
                        std::vector<std::string>& warnings);

struct PictureSums {
    int width = 0, height = 0;
    std::vector<PixelState> pixels;
    size_t walks = 0, lost_walks = 0, cut_channels = 0;

    void add(const PictureSums& other);
};

/// Samples begin <= i < end of every pixel.
struct SampleRange {
    int begin = 0, end = 0;
    friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

/// Whether a picture of settings.samples can be made from parts, and `range` be one of them: whole blocks,
/// two at least, no --noise.
[[nodiscard]] Result<void> check_range(const ReferenceSettings& settings, SampleRange range);

/// These samples alone; sample i of a pixel is the same in every range. Errors: as render_reference and
/// check_range; stopped.
[[nodiscard]] Result<PictureSums> sum_samples(const Scene& scene, const ReferenceSettings& settings,
                                              SampleRange range, const ReferenceProgress& progress = {},
                                              const std::atomic<bool>* stop = nullptr);

/// The picture of these sums: for the sums of all samples the same bits as render_reference's, but for the
/// time.
[[nodiscard]] ReferencePicture picture_of(const PictureSums& sums);

/// The error of each pixel as ReferencePicture defines it, -1 for those that show nothing, and their root
/// mean square.
[[nodiscard]] std::vector<float> relative_errors(const PictureSums& sums);
[[nodiscard]] double root_mean_square(const std::vector<float>& errors);

}  // namespace dermis::inline reference
