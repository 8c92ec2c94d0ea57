#pragma once
// An image in memory: rows top to bottom, pixels left to right, channels interleaved, no padding.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline image {

enum class PixelFormat { u8, u16, f16, f32 };

/// Meaning of the numbers: linear light or data, or sRGB-encoded colour that is decoded before arithmetic.
enum class Encoding { linear, srgb };

[[nodiscard]] size_t bytes_per_channel(PixelFormat format);

/// Largest side of an image that Dermis reads or makes.
inline constexpr int kMaxImageSide = 16384;

/// Most bytes of an image as 32-bit floats: 2 GiB, or the number of MiB in the environment variable
/// DERMIS_MAX_IMAGE_MIB. Error: not a positive number.
[[nodiscard]] Result<uint64_t> max_image_bytes();

/// Value type; copies are deep. Integer formats hold 0..1 as 0..255 or 0..65535. Channels: 1 to 4 (red,
/// green, blue, alpha; alpha is never sRGB-encoded and never premultiplied). Two channels are red and green
/// when linear, grey and alpha when sRGB-encoded.
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
    /// Rounds and clamps as convert() does.
    void set(int x, int y, int channel, float value);

    /// All values of an f32 image, width * height * channels of them.
    [[nodiscard]] std::span<float> floats();
    [[nodiscard]] std::span<const float> floats() const;

    /// All values as stored: T is uint8_t, uint16_t (u16, or the bits of f16, see half.h) or float.
    template <class T>
    [[nodiscard]] std::span<T> values() {
        assert(sizeof(T) == bytes_per_channel(format));
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    template <class T>
    [[nodiscard]] std::span<const T> values() const {
        assert(sizeof(T) == bytes_per_channel(format));
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
};

/// Checks the size of an image from outside. Errors: no texels, a side over kMaxImageSide, more than
/// max_image_bytes(). Image() itself only asserts.
[[nodiscard]] Result<void> check_image_size(uint64_t width, uint64_t height, int channels);

/// Which channel is alpha, or -1: the fourth of four, the second of two sRGB-encoded ones.
[[nodiscard]] int alpha_channel(const Image& image);

/// One channel as stored.
[[nodiscard]] Image single_channel(const Image& image, int channel);

/// Whether red, green and blue differ by at most `tolerance` everywhere; true for one channel.
[[nodiscard]] bool is_grey(const Image& image, float tolerance = 0);

/// f32, linear: integers to 0..1, sRGB decoded (alpha excepted). 2048x2048 RGB u8: 45 ms of one core.
[[nodiscard]] Image to_linear_float(const Image& image);

/// Any format and encoding from a linear f32 image; integers clamp to 0..1 and round to nearest, NaN becomes
/// 0 in them; f16 saturates (half.h).
[[nodiscard]] Image convert(const Image& linear_float, PixelFormat format, Encoding encoding);

}  // namespace dermis::inline image
