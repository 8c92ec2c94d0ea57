#pragma once
// A baked table in memory: decoded values with the convention that says what they are.

#include <span>
#include <vector>

#include "dermis/bake/convention.h"

namespace dermis::inline bake {

/// Rows in the order of v (row 0 is the least v, whatever the file's v_origin), texels in the order of u,
/// channels interleaved: 3 (linear red, green, blue) or 1. Values are decoded: `encoding` is what the file
/// will hold.
struct Table {
    int width = 0, height = 0, channels = 3;
    std::vector<float> data;
    Convention convention;

    [[nodiscard]] float at(int x, int y, int channel) const {
        return data[(size_t(y) * size_t(width) + size_t(x)) * size_t(channels) + size_t(channel)];
    }
    [[nodiscard]] double u_value(double x) const { return convention.axes[0].value(x, width); }
    [[nodiscard]] double v_value(double y) const { return convention.axes[1].value(y, height); }
};

/// Bytes of one stored value. `automatic` is what suits the file's extension (bake/table_io.h).
enum class TableStorage { automatic, u8, u16, f16, f32 };

/// Why a table of this size cannot be made, naming the side and its range (1 to 16384, 64 million texels).
[[nodiscard]] Result<void> check_table_size(int width, int height);
/// Errors: a bound that is not finite, min equal to max, a bound outside [least, most].
[[nodiscard]] Result<void> check_axis(const TableAxis& axis, double least, double most);

/// The table after encoding, rounding to this storage and decoding: what a reader of the file gets.
[[nodiscard]] Table quantised(const Table& table, TableStorage storage);

/// Bilinear lookup at axis values, clamped at the borders as a GPU's clamp-to-edge sampler does (which takes
/// texels to be at their centres, whatever the convention evaluated). NaN reads the first texel.
[[nodiscard]] Rgb lookup(const Table& table, double u_value, double v_value);

}  // namespace dermis::inline bake
