#include "dermis/bake/table.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/half.h"
#include "dermis/image/image.h"

namespace dermis::inline bake {
namespace {

double rounded(double stored, TableStorage storage) {
    switch (storage) {
        case TableStorage::u8:
            return std::round(std::clamp(stored, 0.0, 1.0) * 255) / 255;
        case TableStorage::u16:
            return std::round(std::clamp(stored, 0.0, 1.0) * 65535) / 65535;
        case TableStorage::f16:
            return from_half(to_half(float(stored)));
        case TableStorage::automatic:
        case TableStorage::f32:
            break;
    }
    return stored;
}

}  // namespace

Result<void> check_table_size(int width, int height) {
    constexpr int64_t kMaxTexels = 64 << 20;
    for (const auto& [name, side] : {std::pair{"width", width}, std::pair{"height", height}})
        if (side < 1 || side > kMaxImageSide)
            return Error{std::string("table ") + name + " is " + std::to_string(side) + ", must be 1 to " +
                         std::to_string(kMaxImageSide)};
    if (int64_t(width) * height > kMaxTexels)
        return Error{"table is " + std::to_string(width) + " x " + std::to_string(height) +
                     " texels, must be at most " + std::to_string(kMaxTexels)};
    return {};
}

Result<void> check_axis(const TableAxis& axis, double least, double most) {
    for (double bound : {axis.min, axis.max})
        if (!(bound >= least && bound <= most))
            return Error{"axis " + axis.name + " has the bound " + to_text(bound) + ", must be " +
                         to_text(least) + " to " + to_text(most)};
    if (axis.min == axis.max)
        return Error{"axis " + axis.name + " goes from " + to_text(axis.min) +
                     " to itself; its bounds must differ"};
    return {};
}

Table quantised(const Table& table, TableStorage storage) {
    Table result = table;
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x)
            for (int c = 0; c < table.channels; ++c) {
                const double u = table.u_value(x);
                const double stored = encode_value(table.convention, table.at(x, y, c), u);
                result.data[(size_t(y) * size_t(table.width) + size_t(x)) * size_t(table.channels) +
                            size_t(c)] = float(decode_value(table.convention, rounded(stored, storage), u));
            }
    return result;
}

Rgb lookup(const Table& table, double u_value, double v_value) {
    const auto centre_texel = [](TableAxis axis, double value, int count) {
        axis.sampling = TexelSampling::centre;
        const double texel = axis.texel(value, count);
        return texel > 0 ? std::min(texel, double(count - 1)) : 0.0;  // also where it is not a number
    };
    const double x = centre_texel(table.convention.axes[0], u_value, table.width);
    const double y = centre_texel(table.convention.axes[1], v_value, table.height);
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, table.width - 1), y1 = std::min(y0 + 1, table.height - 1);
    const double fx = x - x0, fy = y - y0;
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        const int channel = std::min(c, table.channels - 1);
        const double top = (1 - fx) * table.at(x0, y0, channel) + fx * table.at(x1, y0, channel);
        const double bottom = (1 - fx) * table.at(x0, y1, channel) + fx * table.at(x1, y1, channel);
        value[size_t(c)] = (1 - fy) * top + fy * bottom;
    }
    return value;
}

}  // namespace dermis::inline bake
