// Reasons to refuse a picture. A flat or grey picture agrees with some model over a small range of the
// model's axes, so agreement alone proves nothing.

#include <algorithm>
#include <cmath>
#include <limits>

#include "dermis/bake/lint_model.h"

namespace dermis::inline bake {

std::string lint::refusal_of_picture(const Image& image) {
    constexpr float kNegative = -0.01f;  // filters that ring leave less
    constexpr float kFlat = 0.05f, kGrey = 0.02f;
    float least = std::numeric_limits<float>::infinity(), most = -least, widest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto [low, high] = std::minmax({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
            least = std::min(least, low);
            most = std::max(most, high);
            widest = std::max(widest, high - low);
        }
    if (least < kNegative) return "it has negative numbers, down to " + rounded(least) + "; light has none";
    if (most - least < kFlat)
        return "it is flat: all its numbers lie from " + rounded(least) + " to " + rounded(most);
    if (widest < kGrey)
        return "it is grey: red, green and blue differ by " + rounded(widest) +
               " at most; in skin red scatters farthest";
    return {};
}

lint::Scattering lint::scattering_of(const Sample& sample, const LintHypothesis& hypothesis) {
    const std::vector<float> light = decoded(sample, hypothesis);
    const size_t columns = sample.u.size(), rows = sample.v.size();
    const auto at = [&](size_t column, size_t row, size_t channel) {
        return double(light[3 * (row * columns + column) + channel]);
    };
    Scattering found;
    double squares = 0;
    for (size_t x = 0; x < columns; ++x) {
        double sum = 0, sum_of_squares = 0;
        for (size_t c = 0; c < 3; ++c) {
            double least = at(x, 0, c), most = least;
            for (size_t y = 0; y < rows; ++y) {
                const double value = at(x, y, c);
                sum += value, sum_of_squares += value * value;
                least = std::min(least, value), most = std::max(most, value);
            }
            found.rows = std::max(found.rows, most - least);
        }
        squares += std::max(0.0, sum_of_squares - sum * sum / double(3 * rows));
    }
    found.rms = std::sqrt(squares / double(light.size()));
    for (size_t y = 0; y < rows; ++y)
        for (size_t c = 0; c < 3; ++c) {
            double brightest = -std::numeric_limits<double>::infinity();
            for (size_t i = 0; i < columns; ++i) {
                const double value = at(hypothesis.n_dot_l_mirrored ? columns - 1 - i : i, y, c);
                brightest = std::max(brightest, value);
                found.fall = std::max(found.fall, brightest - value);
            }
        }
    return found;
}

std::string lint::refusal_of_light(const Scattering& light, double rms) {
    constexpr double kAlike = 0.02, kFall = 0.1;
    constexpr double kLeastShare = 0.9;
    if (light.fall > kFall)
        return "its light does not rise with N.L: it falls by " + rounded(light.fall) +
               " towards the lit side";
    if (light.rows < kAlike)
        return "its rows are alike, within " + rounded(light.rows) + "; light on skin depends on curvature";
    if (rms * rms > (1 - kLeastShare) * light.rms * light.rms)
        return "its rows and colours differ by rms " + rounded(light.rms) +
               ", of which the nearest table leaves " + rounded(rms) + " unexplained";
    return {};
}

bool lint::is_as_good(double rms, double best) {
    constexpr double kAsGood = 1.5, kRounding = 0.001;
    return rms < kAsGood * best + kRounding;
}

}  // namespace dermis::inline bake
