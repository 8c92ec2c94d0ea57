#include "dermis/image/resample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dermis/base/parallel.h"

namespace dermis::inline image {
namespace {

// The source texels that a target texel averages, and how much of each.
struct Taps {
    int first = 0;
    std::vector<float> weights;
};

// Shrinking: target texel i covers the interval [i, i+1) * from/to; a source texel's weight is its overlap
// with it.
Taps area_taps(int i, int from, int to) {
    const double scale = double(from) / double(to), begin = i * scale, end = (i + 1) * scale;
    Taps taps{int(begin), {}};
    for (int s = taps.first; s < from && double(s) < end - 1e-9; ++s)
        taps.weights.push_back(float((std::min(end, s + 1.0) - std::max(begin, double(s))) / scale));
    return taps;
}

// Growing: between the two source centres around the target's centre, constant beyond the outermost.
Taps linear_taps(int i, int from, int to) {
    const double centre = std::clamp((i + 0.5) * from / to - 0.5, 0.0, double(from - 1));
    const int first = std::min(int(centre), std::max(from - 2, 0));
    const float t = float(centre - first);
    return from == 1 ? Taps{0, {1.0f}} : Taps{first, {1.0f - t, t}};
}

std::vector<Taps> axis_taps(int from, int to) {
    std::vector<Taps> taps;
    for (int i = 0; i < to; ++i)
        taps.push_back(to <= from ? area_taps(i, from, to) : linear_taps(i, from, to));
    return taps;
}

Image resize_rows(const Image& from, int width) {
    Image to(width, from.height, from.channels);
    const std::vector<Taps> taps = axis_taps(from.width, width);
    const size_t channels = size_t(from.channels);
    parallel_for(size_t(from.height), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const float* row = from.floats().data() + y * size_t(from.width) * channels;
            float* out = to.floats().data() + y * size_t(width) * channels;
            for (const auto& [first, weights] : taps) {
                for (size_t k = 0; k < weights.size(); ++k)
                    for (size_t c = 0; c < channels; ++c)
                        out[c] += weights[k] * row[(size_t(first) + k) * channels + c];
                out += channels;
            }
        }
    });
    return to;
}

Image resize_columns(const Image& from, int height) {
    Image to(from.width, height, from.channels);
    const std::vector<Taps> taps = axis_taps(from.height, height);
    const size_t row_values = size_t(from.width) * size_t(from.channels);
    parallel_for(size_t(height), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            float* out = to.floats().data() + y * row_values;
            for (size_t k = 0; k < taps[y].weights.size(); ++k) {
                const float* row = from.floats().data() + (size_t(taps[y].first) + k) * row_values;
                for (size_t i = 0; i < row_values; ++i) out[i] += taps[y].weights[k] * row[i];
            }
        }
    });
    return to;
}

// Vectors are stored * scale + offset.
void make_unit(Image& image, float scale, float offset) {
    if (image.channels < 3) return;
    parallel_for(image.pixel_count(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            float* texel = image.floats().data() + i * size_t(image.channels);
            const Vec3 mean = {texel[0] * scale + offset, texel[1] * scale + offset,
                               texel[2] * scale + offset};
            const Vec3 unit = normalize(mean);
            texel[0] = (unit.x - offset) / scale;
            texel[1] = (unit.y - offset) / scale;
            texel[2] = (unit.z - offset) / scale;
        }
    });
}

// Everything in linear f32; `as_stored` says how vectors are encoded.
Image resize_linear(const Image& linear, int width, int height, Texels texels, PixelFormat as_stored) {
    Image out = width == linear.width ? linear : resize_rows(linear, width);
    if (height != out.height) out = resize_columns(out, height);
    if (texels == Texels::unit_vectors) {
        const bool encoded = as_stored == PixelFormat::u8 || as_stored == PixelFormat::u16;
        make_unit(out, encoded ? 2.0f : 1.0f, encoded ? -1.0f : 0.0f);
    }
    return out;
}

}  // namespace

Image resize(const Image& image, int width, int height, Texels texels) {
    assert(!image.empty());
    return convert(resize_linear(to_linear_float(image), width, height, texels, image.format), image.format,
                   image.encoding);
}

std::vector<Image> mip_chain(const Image& image, Texels texels) {
    assert(!image.empty());
    std::vector<Image> levels = {image};
    Image linear = to_linear_float(image);
    while (linear.width > 1 || linear.height > 1) {
        linear = resize_linear(linear, std::max(linear.width / 2, 1), std::max(linear.height / 2, 1), texels,
                               image.format);
        levels.push_back(convert(linear, image.format, image.encoding));
    }
    return levels;
}

Vec4 sample_bilinear(const Image& image, Vec2 uv) {
    // Clamped first, so that the texel's number fits into int.
    const float x = std::clamp(uv.x, -1.0f, 2.0f) * float(image.width) - 0.5f;
    const float y = std::clamp(uv.y, -1.0f, 2.0f) * float(image.height) - 0.5f;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float fx = x - float(x0), fy = y - float(y0);
    const float weights[4] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};

    std::array<float, 4> sum = {};
    for (int k = 0; k < 4; ++k) {
        const int tx = std::clamp(x0 + (k & 1), 0, image.width - 1),
                  ty = std::clamp(y0 + (k >> 1), 0, image.height - 1);
        const float* texel =
            image.floats().data() + (size_t(ty) * size_t(image.width) + size_t(tx)) * size_t(image.channels);
        for (int c = 0; c < image.channels; ++c) sum[size_t(c)] += weights[k] * texel[c];
    }
    if (image.channels == 1) return {sum[0], sum[0], sum[0], 1};
    return {sum[0], sum[1], sum[2], image.channels == 4 ? sum[3] : 1};
}

}  // namespace dermis::inline image
