// Nearest covered texel by two separable passes, after A. Meijster, J. Roerdink and W. Hesselink, "A General
// Algorithm for Computing Distance Transforms in Linear Time", 2000: along each column the nearest covered
// row, then along each row the column whose nearest one is closest. The second pass is a search outwards that
// ends as soon as the horizontal distance alone exceeds the best; gutters are narrow, so it is short.

#include "dermis/image/dilate.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "dermis/base/parallel.h"

namespace dermis::inline image {
namespace {

constexpr int kNone = -1;

// For each texel the row of the nearest covered texel in its column, or kNone.
std::vector<int> nearest_rows(const std::vector<char>& covered, int width, int height) {
    std::vector<int> rows(covered.size(), kNone);
    parallel_for(size_t(width), 64, [&](size_t begin, size_t end) {
        const auto at = [&](int y, size_t x) { return size_t(y) * size_t(width) + x; };
        for (int y = 0; y < height; ++y)
            for (size_t x = begin; x < end; ++x)
                rows[at(y, x)] = covered[at(y, x)] ? y : y > 0 ? rows[at(y - 1, x)] : kNone;
        for (int y = height - 2; y >= 0; --y)
            for (size_t x = begin; x < end; ++x) {
                const int below = rows[at(y + 1, x)], above = rows[at(y, x)];
                if (below != kNone && (above == kNone || below - y < y - above)) rows[at(y, x)] = below;
            }
    });
    return rows;
}

struct Nearest {
    int x = kNone, y = kNone;
    int64_t square = 0;
};

Nearest nearest_in_row(const int* rows, int width, int x, int y, int texels) {
    Nearest best{kNone, kNone, int64_t(texels) * texels + 1};
    const auto consider = [&](int column, int64_t dx) {
        if (column < 0 || column >= width || rows[column] == kNone) return;
        const int64_t dy = rows[column] - y, square = dx * dx + dy * dy;
        const bool tie_won = square == best.square && best.x != kNone && rows[column] < best.y;
        if (square < best.square || tie_won) best = {column, rows[column], square};
    };
    for (int64_t dx = 0; dx <= texels && dx * dx <= best.square; ++dx) {
        consider(int(x - dx), dx);
        if (dx > 0) consider(int(x + dx), dx);
    }
    return best;
}

}  // namespace

void dilate(Image& image, const Image& mask, int texels) {
    assert(mask.width == image.width && mask.height == image.height && mask.channels == 1 && texels >= 0);
    std::vector<char> covered(image.pixel_count());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            covered[size_t(y) * size_t(image.width) + size_t(x)] = mask.at(x, y, 0) > 0.0f;

    const std::vector<int> rows = nearest_rows(covered, image.width, image.height);
    const size_t texel_bytes = size_t(image.channels) * bytes_per_channel(image.format);
    const size_t width = size_t(image.width);
    parallel_for(size_t(image.height), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < width; ++x) {
                if (covered[y * width + x]) continue;
                const Nearest n =
                    nearest_in_row(rows.data() + y * width, image.width, int(x), int(y), texels);
                if (n.x == kNone) continue;
                std::memcpy(image.bytes.data() + (y * width + x) * texel_bytes,
                            image.bytes.data() + (size_t(n.y) * width + size_t(n.x)) * texel_bytes,
                            texel_bytes);
            }
    });
}

}  // namespace dermis::inline image
