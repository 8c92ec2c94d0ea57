#include "dermis/image/image.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/half.h"

namespace dermis::inline image {
namespace {

constexpr size_t kGrain = 1 << 15;

// NaN fails the first comparison and becomes 0.
float clamp_unit(float value) {
    return value > 0.0f ? std::min(value, 1.0f) : 0.0f;
}

uint8_t to_u8(float value) {
    return uint8_t(clamp_unit(value) * 255.0f + 0.5f);
}
uint16_t to_u16(float value) {
    return uint16_t(clamp_unit(value) * 65535.0f + 0.5f);
}

template <size_t size>
std::array<float, size> decode_table() {
    std::array<float, size> table;
    for (size_t i = 0; i < size; ++i) table[i] = srgb_decode(float(i) / float(size - 1));
    return table;
}

// The first linear value that encodes to each 8-bit code, so that encoding is a search in 256 numbers instead
// of a power: code = how many thresholds are not above the value, less one.
struct EncodeU8 {
    static constexpr int kCoarse = 1024;
    std::array<float, 257> threshold;
    std::array<uint8_t, kCoarse + 1> guess;

    EncodeU8() {
        threshold[0] = 0;
        for (int code = 1; code < 256; ++code)
            threshold[size_t(code)] = srgb_decode((float(code) - 0.5f) / 255.0f);
        threshold[256] = 2.0f;  // beyond any clamped value
        size_t code = 0;
        for (int i = 0; i <= kCoarse; ++i) {
            while (threshold[code + 1] <= float(i) / kCoarse) ++code;
            guess[size_t(i)] = uint8_t(code);
        }
    }
    uint8_t operator()(float linear) const {
        const float value = clamp_unit(linear);
        size_t code = guess[size_t(value * kCoarse)];
        while (threshold[code + 1] <= value) ++code;
        return uint8_t(code);
    }
};

// Calls body(value index, is alpha) for all values of an image, on all cores.
template <class Body>
void for_each_value(const Image& image, Body body) {
    const size_t channels = size_t(image.channels);
    const int alpha = alpha_channel(image);
    parallel_for(image.pixel_count(), kGrain / channels, [&](size_t begin, size_t end) {
        for (size_t pixel = begin; pixel < end; ++pixel)
            for (size_t c = 0; c < channels; ++c) body(pixel * channels + c, int(c) == alpha);
    });
}

float read_value(const Image& image, size_t index) {
    switch (image.format) {
        case PixelFormat::u8:
            return float(image.values<uint8_t>()[index]) / 255.0f;
        case PixelFormat::u16:
            return float(image.values<uint16_t>()[index]) / 65535.0f;
        case PixelFormat::f16:
            return from_half(image.values<uint16_t>()[index]);
        case PixelFormat::f32:
            break;
    }
    return image.values<float>()[index];
}

void write_value(Image& image, size_t index, float value) {
    switch (image.format) {
        case PixelFormat::u8:
            image.values<uint8_t>()[index] = to_u8(value);
            return;
        case PixelFormat::u16:
            image.values<uint16_t>()[index] = to_u16(value);
            return;
        case PixelFormat::f16:
            image.values<uint16_t>()[index] = to_half(value);
            return;
        case PixelFormat::f32:
            image.values<float>()[index] = value;
            return;
    }
}

template <class T>
void decode_integers(const Image& image, Image& out) {
    constexpr size_t kCodes = size_t{1} << (8 * sizeof(T));
    static const std::array<float, kCodes> table = decode_table<kCodes>();
    const T* from = image.values<T>().data();
    float* to = out.floats().data();
    const bool srgb = image.encoding == Encoding::srgb;
    for_each_value(image, [=](size_t i, bool is_alpha) {
        to[i] = srgb && !is_alpha ? table[from[i]] : float(from[i]) / float(kCodes - 1);
    });
}

}  // namespace

size_t bytes_per_channel(PixelFormat format) {
    switch (format) {
        case PixelFormat::u8:
            return 1;
        case PixelFormat::u16:
        case PixelFormat::f16:
            return 2;
        case PixelFormat::f32:
            break;
    }
    return 4;
}

Image::Image(int width_, int height_, int channels_, PixelFormat format_, Encoding encoding_)
    : width(width_), height(height_), channels(channels_), format(format_), encoding(encoding_) {
    assert(width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide);
    assert(channels >= 1 && channels <= 4);
    bytes.resize(pixel_count() * size_t(channels) * bytes_per_channel(format));
}

float Image::at(int x, int y, int channel) const {
    assert(x >= 0 && x < width && y >= 0 && y < height && channel >= 0 && channel < channels);
    return read_value(*this, (size_t(y) * size_t(width) + size_t(x)) * size_t(channels) + size_t(channel));
}

void Image::set(int x, int y, int channel, float value) {
    assert(x >= 0 && x < width && y >= 0 && y < height && channel >= 0 && channel < channels);
    write_value(*this, (size_t(y) * size_t(width) + size_t(x)) * size_t(channels) + size_t(channel), value);
}

std::span<float> Image::floats() {
    assert(format == PixelFormat::f32);
    return values<float>();
}
std::span<const float> Image::floats() const {
    assert(format == PixelFormat::f32);
    return values<float>();
}

Result<uint64_t> max_image_bytes() {
    constexpr uint64_t kDefaultMiB = 2048;
    const char* stated = std::getenv("DERMIS_MAX_IMAGE_MIB");
    if (!stated) return kDefaultMiB << 20;
    const std::optional<double> mib = parse_number(stated);
    if (!mib || !(*mib >= 1 && *mib <= 1 << 20))
        return Error{"the environment's DERMIS_MAX_IMAGE_MIB is not a number of MiB from 1 to 1048576"};
    return uint64_t(*mib) << 20;
}

Result<void> check_image_size(uint64_t width, uint64_t height, int channels) {
    const std::string size = fmt::format("{} x {} texels", width, height);
    if (width == 0 || height == 0) return Error{"holds " + size};
    if (width > uint64_t(kMaxImageSide) || height > uint64_t(kMaxImageSide))
        return Error{fmt::format("holds {}; the largest side is {}", size, kMaxImageSide)};
    DERMIS_TRY_ASSIGN(const uint64_t limit, max_image_bytes());
    const uint64_t bytes = width * height * uint64_t(channels) * sizeof(float);
    if (bytes <= limit) return {};
    return Error{
        fmt::format("holds {} of {} channels, {} MiB as floats; the limit is {} (DERMIS_MAX_IMAGE_MIB)", size,
                    channels, bytes >> 20, limit >> 20)};
}

int alpha_channel(const Image& image) {
    if (image.channels == 4) return 3;
    return image.channels == 2 && image.encoding == Encoding::srgb ? 1 : -1;
}

Image single_channel(const Image& image, int channel) {
    Image single(image.width, image.height, 1, image.format);
    const size_t size = bytes_per_channel(image.format), stride = size * size_t(image.channels);
    for (size_t i = 0; i < image.pixel_count(); ++i)
        std::memcpy(single.bytes.data() + i * size, image.bytes.data() + i * stride + size_t(channel) * size,
                    size);
    return single;
}

bool is_grey(const Image& image, float tolerance) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 1; c < std::min(image.channels, 3); ++c)
                if (std::abs(image.at(x, y, c) - image.at(x, y, 0)) > tolerance) return false;
    return true;
}

Image to_linear_float(const Image& image) {
    if (image.empty()) return {};
    if (image.format == PixelFormat::f32 && image.encoding == Encoding::linear) return image;
    Image out(image.width, image.height, image.channels, PixelFormat::f32, Encoding::linear);
    float* to = out.floats().data();
    const bool srgb = image.encoding == Encoding::srgb;
    if (image.format == PixelFormat::u8) {
        decode_integers<uint8_t>(image, out);
    } else if (image.format == PixelFormat::u16) {
        decode_integers<uint16_t>(image, out);
    } else if (image.format == PixelFormat::f16 && !srgb) {
        const uint16_t* from = image.values<uint16_t>().data();
        for_each_value(image, [=](size_t i, bool) { to[i] = from_half(from[i]); });
    } else {
        for_each_value(image, [&](size_t i, bool is_alpha) {
            const float value = read_value(image, i);
            to[i] = srgb && !is_alpha ? srgb_decode(value) : value;
        });
    }
    return out;
}

Image convert(const Image& linear_float, PixelFormat format, Encoding encoding) {
    if (linear_float.empty()) return {};
    assert(linear_float.format == PixelFormat::f32 && linear_float.encoding == Encoding::linear);
    Image out(linear_float.width, linear_float.height, linear_float.channels, format, encoding);
    const float* from = linear_float.floats().data();
    const bool srgb = encoding == Encoding::srgb;
    if (format == PixelFormat::u8 && srgb) {
        static const EncodeU8 encode;
        uint8_t* to = out.values<uint8_t>().data();
        for_each_value(out,
                       [=](size_t i, bool is_alpha) { to[i] = is_alpha ? to_u8(from[i]) : encode(from[i]); });
    } else if (format == PixelFormat::f16 && !srgb) {
        uint16_t* to = out.values<uint16_t>().data();
        for_each_value(out, [=](size_t i, bool) { to[i] = to_half(from[i]); });
    } else {
        for_each_value(out, [&](size_t i, bool is_alpha) {
            write_value(out, i, srgb && !is_alpha ? srgb_encode(from[i]) : from[i]);
        });
    }
    return out;
}

}  // namespace dermis::inline image
