#pragma once
// Differences between two pictures.
//
// Both images have the same size and number of channels, in any format; they are decoded to linear light.
// Alpha is ignored. max_abs_error, rmse and rel_mse compare linear numbers and suit HDR and data. The others
// compare linear sRGB clamped to 0..1: tone-map HDR pictures first. One channel counts as grey.
//
// A mask has one channel and the images' size; texels above 0 count. An empty Image: no mask.
//
// Errors: sizes or channels that differ, an empty image, NaN or infinity in either image (with the first
// place), a mask that covers nothing. Results do not depend on the number of threads. Equal images give 0
// everywhere, 1 for SSIM and infinity for PSNR.

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline image {

/// Largest difference of any channel of any texel.
[[nodiscard]] Result<double> max_abs_error(const Image& image, const Image& reference,
                                           const Image& mask = {});

/// Root of the mean square over texels and channels.
[[nodiscard]] Result<double> rmse(const Image& image, const Image& reference, const Image& mask = {});

/// Mean of (image - reference)^2 / (reference^2 + 0.01): Rousselle, Knaus and Zwicker 2011, "Adaptive
/// Sampling and Reconstruction using Greedy Error Minimization", section 5, with their epsilon.
[[nodiscard]] Result<double> rel_mse(const Image& image, const Image& reference, const Image& mask = {});

/// 10 log10(1 / mean square) in dB over sRGB-encoded values in 0..1.
[[nodiscard]] Result<double> psnr_db(const Image& image, const Image& reference, const Image& mask = {});

/// Mean structural similarity, 1 for equal, below 0 for opposite: Wang, Bovik, Sheikh and Simoncelli 2004,
/// "Image Quality Assessment: From Error Visibility to Structural Similarity", equation 13, with their 11x11
/// Gaussian window of standard deviation 1.5, K1 = 0.01, K2 = 0.03, on the luma (BT.601 weights) of
/// sRGB-encoded values in 0..1. The mean is over texels whose window lies in the image, or over all (the
/// border repeated) when a side is below 11. No downsampling.
[[nodiscard]] Result<double> ssim(const Image& image, const Image& reference, const Image& mask = {});

/// Mean CIEDE2000 colour difference; about 1 is just noticeable, 100 is black to white.
[[nodiscard]] Result<double> mean_ciede2000(const Image& image, const Image& reference,
                                            const Image& mask = {});

/// Two colours: Sharma, Wu and Dalal 2005, "The CIEDE2000 Color-Difference Formula: Implementation Notes,
/// Supplementary Test Data, and Mathematical Observations", equations 2 to 22, all weights 1. Agrees with
/// their 34 test pairs to the four decimals they give.
[[nodiscard]] double ciede2000(Vec3 lab_a, Vec3 lab_b);

/// 0.7 m from a 0.7 m wide screen of 3840 texels.
inline constexpr double kFlipPixelsPerDegree = 67.02;

/// Mean LDR FLIP, 0 (equal) to 1: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild 2020,
/// "FLIP: A Difference Evaluator for Alternating Images". `pixels_per_degree` is of the observer's visual
/// angle, above 0. 1024x1024 takes 0.6 s of one core, spread over all.
[[nodiscard]] Result<double> mean_flip(const Image& image, const Image& reference, const Image& mask = {},
                                       double pixels_per_degree = kFlipPixelsPerDegree);

/// The same per texel, as f32 images of one channel. abs_difference_map is the largest over the channels, of
/// linear values; ssim_map repeats the border.
[[nodiscard]] Result<Image> abs_difference_map(const Image& image, const Image& reference);
[[nodiscard]] Result<Image> ssim_map(const Image& image, const Image& reference);
[[nodiscard]] Result<Image> ciede2000_map(const Image& image, const Image& reference);
[[nodiscard]] Result<Image> flip_map(const Image& image, const Image& reference,
                                     double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of a one-channel map over the mask.
[[nodiscard]] Result<double> mean_of(const Image& map, const Image& mask = {});

}  // namespace dermis::inline image
