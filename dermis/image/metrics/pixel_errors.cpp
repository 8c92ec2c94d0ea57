// The metrics of single texels.

#include <algorithm>
#include <cmath>
#include <limits>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/image/metrics/metric_input.h"

namespace dermis::inline image {
namespace {

using metrics::compared_channels;

struct Sum {
    double total = 0, largest = 0;
    size_t count = 0;
};

bool counts(const Image& mask, int x, int y) {
    return mask.empty() || mask.at(x, y, 0) > 0.0f;
}

// Adds body(x, y) -> Sum over all texels of the mask: rows in parallel, their sums in order, so that the
// result does not depend on the threads.
template <class Body>
Sum sum_over(int width, int height, const Image& mask, Body body) {
    std::vector<Sum> rows(static_cast<size_t>(height));
    parallel_for(size_t(height), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < width; ++x) {
                if (!counts(mask, x, int(y))) continue;
                const Sum s = body(x, int(y));
                rows[y].total += s.total;
                rows[y].largest = std::max(rows[y].largest, s.largest);
                rows[y].count += s.count;
            }
    });
    Sum sum;
    for (const Sum& row : rows) {
        sum.total += row.total;
        sum.largest = std::max(sum.largest, row.largest);
        sum.count += row.count;
    }
    return sum;
}

// Sums error(a, b) over the compared channels of every texel in the mask.
template <class ErrorOf>
Result<Sum> sum_errors(const Image& image, const Image& reference, const Image& mask, ErrorOf error_of) {
    DERMIS_TRY_ASSIGN(const metrics::Pair pair, metrics::checked_pair(image, reference));
    DERMIS_TRY(metrics::check_mask(mask, image.width, image.height));
    const int compared = compared_channels(image);
    return sum_over(image.width, image.height, mask, [&](int x, int y) {
        Sum sum;
        for (int c = 0; c < compared; ++c) {
            const double error = error_of(pair.image.at(x, y, c), pair.reference.at(x, y, c));
            sum.total += error;
            sum.largest = std::max(sum.largest, error);
            ++sum.count;
        }
        return sum;
    });
}

double square(double x) {
    return x * x;
}

double mean(const Sum& sum) {
    return sum.total / double(sum.count);
}

}  // namespace

Result<double> max_abs_error(const Image& image, const Image& reference, const Image& mask) {
    DERMIS_TRY_ASSIGN(const Sum sum,
                      sum_errors(image, reference, mask, [](double a, double b) { return std::abs(a - b); }));
    return sum.largest;
}

Result<double> rmse(const Image& image, const Image& reference, const Image& mask) {
    DERMIS_TRY_ASSIGN(const Sum sum,
                      sum_errors(image, reference, mask, [](double a, double b) { return square(a - b); }));
    return std::sqrt(mean(sum));
}

Result<double> rel_mse(const Image& image, const Image& reference, const Image& mask) {
    constexpr double kEpsilon = 0.01;
    DERMIS_TRY_ASSIGN(const Sum sum, sum_errors(image, reference, mask, [](double a, double b) {
                          return square(a - b) / (square(b) + kEpsilon);
                      }));
    return mean(sum);
}

Result<double> psnr_db(const Image& image, const Image& reference, const Image& mask) {
    const auto shown = [](double v) { return double(srgb_encode(float(std::clamp(v, 0.0, 1.0)))); };
    DERMIS_TRY_ASSIGN(const Sum sum, sum_errors(image, reference, mask, [&](double a, double b) {
                          return square(shown(a) - shown(b));
                      }));
    if (sum.total == 0) return std::numeric_limits<double>::infinity();
    return -10.0 * std::log10(mean(sum));
}

Result<Image> abs_difference_map(const Image& image, const Image& reference) {
    DERMIS_TRY_ASSIGN(const metrics::Pair pair, metrics::checked_pair(image, reference));
    Image map(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            float largest = 0;
            for (int c = 0; c < compared_channels(image); ++c)
                largest = std::max(largest, std::abs(pair.image.at(x, y, c) - pair.reference.at(x, y, c)));
            map.set(x, y, 0, largest);
        }
    return map;
}

Result<double> mean_of(const Image& map, const Image& mask) {
    if (map.empty() || map.channels != 1) return Error{"a map of errors has one channel"};
    DERMIS_TRY(metrics::check_mask(mask, map.width, map.height));
    const Image linear = to_linear_float(map);
    return mean(sum_over(map.width, map.height, mask, [&](int x, int y) {
        return Sum{linear.at(x, y, 0), 0, 1};
    }));
}

}  // namespace dermis::inline image
