#pragma once
// An image in memory: rows top to bottom, pixels left to right, channels interleaved, no padding.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/result.h"

namespace dermis {

enum class PixelFormat { u8, u16, f16, f32 };

/// What the numbers mean: light or data as they are, or sRGB-encoded colour that is decoded before any
/// arithmetic.
enum class Encoding { linear, srgb };

[[nodiscard]] size_t bytes_per_channel(PixelFormat format);

/// Largest side of any image dermis reads or makes.
inline constexpr int kMaxImageSide = 16384;

/// Value type; copies are deep. Integer formats hold 0..1 as 0..255 or 0..65535. Channels: 1 to 4 (red,
/// green, blue, alpha; alpha is never sRGB-encoded and never premultiplied).
struct Image {
    int width = 0, height = 0, channels = 0;
    PixelFormat format = PixelFormat::f32;
    Encoding encoding = Encoding::linear;
    std::vector<std::byte> bytes;

    Image() = default;
    /// Zero-filled.
    Image(int width, int height, int channels, PixelFormat format = PixelFormat::f32,
          Encoding encoding = Encoding::linear);

    [[nodiscard]] bool empty() const { return bytes.empty(); }
    [[nodiscard]] size_t pixel_count() const { return size_t(width) * size_t(height); }

    /// One channel of one texel as stored, converted to float but not decoded; any format. For f32 loops use
    /// floats().
    [[nodiscard]] float at(int x, int y, int channel) const;
    void set(int x, int y, int channel, float value);

    /// All values of an f32 image, width * height * channels of them.
    [[nodiscard]] std::span<float> floats();
    [[nodiscard]] std::span<const float> floats() const;
};

/// f32, linear: integers to 0..1, sRGB decoded (alpha excepted).
[[nodiscard]] Image to_linear_float(const Image& image);

/// Any format and encoding from a linear f32 image; integers clamp to 0..1 and round to nearest.
[[nodiscard]] Image convert(const Image& linear_float, PixelFormat format, Encoding encoding);

}  // namespace dermis
