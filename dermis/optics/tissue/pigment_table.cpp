#include "dermis/optics/tissue/pigment_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dermis/base/parallel.h"

namespace dermis::inline optics {
namespace {

constexpr int kPigmentNodes = 33;
constexpr double kDarkestAlbedo = 1.0 / 8192;
constexpr Rgb kLogWeights = {1, 1, 0.5};

Rgb log_difference(const Rgb& log, const Rgb& wanted) {
    return {log[0] - wanted[0], log[1] - wanted[1], log[2] - wanted[2]};
}
double weighted_square(const Rgb& logs) {
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) sum += kLogWeights[c] * logs[c] * logs[c];
    return sum;
}

// Four nodes along one axis and their weights: Catmull and Rom 1974.
struct Taps {
    std::array<size_t, 4> node;
    std::array<double, 4> weight;
};
Taps taps_at(double at) {
    const double x = std::clamp(at, 0.0, 1.0) * (kPigmentNodes - 1);
    const int first = std::min(int(x), kPigmentNodes - 2);
    const double t = x - first;
    return {{size_t(std::max(first - 1, 0)), size_t(first), size_t(first + 1),
             size_t(std::min(first + 2, kPigmentNodes - 1))},
            {((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2,
             (t - 1) * t * t / 2}};
}

}  // namespace

// Melanin is in the epidermis only and blood in the dermis only, so each layer has a node per row or column.
PigmentTable::PigmentTable(const SkinModel& model) : logs_(size_t(kPigmentNodes * kPigmentNodes)) {
    std::vector<SkinSpectrum> spectra(logs_.size());
    parallel_for(tissue::kWavelengths, 1, [&](size_t begin, size_t end) {
        for (size_t wave = begin; wave < end; ++wave) {
            std::array<tissue::TissueLayer, kPigmentNodes> epidermis, dermis;
            for (int i = 0; i < kPigmentNodes; ++i) {
                const double root = double(i) / (kPigmentNodes - 1);
                SkinModel node = model;
                node.melanin = kMostMelanin * root * root, node.blood = kMostBlood * root * root;
                const SkinLayers layers = skin_layers(node, int(wave));
                epidermis[size_t(i)] = layers.epidermis, dermis[size_t(i)] = layers.dermis;
            }
            const std::vector<double> albedos =
                tissue::layered_albedos(epidermis, model.epidermis_mm, dermis, model.g, model.eta);
            for (size_t i = 0; i < albedos.size(); ++i) spectra[i][wave] = albedos[i];
        }
    });
    for (size_t i = 0; i < logs_.size(); ++i) {
        const Rgb albedo = linear_of_spectrum(spectra[i]);
        for (size_t c = 0; c < 3; ++c) logs_[i][c] = std::log(std::max(albedo[c], kDarkestAlbedo));
    }
}

Rgb PigmentTable::log_albedo(double u, double v) const {
    const Taps across = taps_at(u), down = taps_at(v);
    Rgb sum = {};
    for (size_t j = 0; j < 4; ++j) {
        const Rgb* const row = &logs_[down.node[j] * kPigmentNodes];
        Rgb of_row = {};
        for (size_t i = 0; i < 4; ++i)
            for (size_t c = 0; c < 3; ++c) of_row[c] += across.weight[i] * row[across.node[i]][c];
        for (size_t c = 0; c < 3; ++c) sum[c] += down.weight[j] * of_row[c];
    }
    return sum;
}

Rgb PigmentTable::albedo_of_texels(double melanin, double blood) const {
    const Rgb log = log_albedo(melanin, blood);
    return {std::exp(log[0]), std::exp(log[1]), std::exp(log[2])};
}

Rgb PigmentTable::albedo(const Pigments& pigments) const {
    return albedo_of_texels(pigment_texel(pigments.melanin, kMostMelanin),
                            pigment_texel(pigments.blood, kMostBlood));
}

// The best of nine nodes, at strides of four, two and one.
PigmentTable::Root PigmentTable::nearest_node(const Rgb& wanted) const {
    const auto at_node = [&](int x, int y) {
        return weighted_square(log_difference(logs_[size_t(y * kPigmentNodes + x)], wanted));
    };
    int x = kPigmentNodes / 4, y = kPigmentNodes / 4;
    double best = at_node(x, y);
    for (int stride = 4; stride > 0;) {
        const int from_x = x, from_y = y;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int nx = std::clamp(from_x + i * stride, 0, kPigmentNodes - 1);
                const int ny = std::clamp(from_y + j * stride, 0, kPigmentNodes - 1);
                if (const double error = at_node(nx, ny); error < best) best = error, x = nx, y = ny;
            }
        if (x == from_x && y == from_y) stride /= 2;
    }
    // At 0 the square root leaves no slope to follow.
    return {std::max(double(x), 0.5) / (kPigmentNodes - 1), std::max(double(y), 0.5) / (kPigmentNodes - 1)};
}

// One step of Gauss and Newton in the roots, taken in the fractions, in which the logarithms are straighter.
PigmentTable::Root PigmentTable::step_from(const Root& root, const Rgb& wanted) const {
    constexpr double kStep = 1e-4;
    const double step_u = root.u > 0.5 ? -kStep : kStep, step_v = root.v > 0.5 ? -kStep : kStep;
    const Rgb here = log_albedo(root.u, root.v);
    const Rgb right = log_albedo(root.u + step_u, root.v), below = log_albedo(root.u, root.v + step_v);
    double uu = 1e-9, uv = 0, vv = 1e-9, ru = 0, rv = 0;
    for (size_t c = 0; c < 3; ++c) {
        const double du = (right[c] - here[c]) / step_u, dv = (below[c] - here[c]) / step_v;
        const double weight = kLogWeights[c], miss = here[c] - wanted[c];
        uu += weight * du * du, uv += weight * du * dv, vv += weight * dv * dv;
        ru += weight * du * miss, rv += weight * dv * miss;
    }
    const double determinant = uu * vv - uv * uv;
    return {-2 * root.u * (vv * ru - uv * rv) / determinant, -2 * root.v * (uu * rv - uv * ru) / determinant};
}

Pigments PigmentTable::nearest(const Rgb& albedo_linear) const {
    Rgb wanted;
    for (size_t c = 0; c < 3; ++c) wanted[c] = std::log(std::max(albedo_linear[c], kDarkestAlbedo));
    Root root = nearest_node(wanted);
    double error = weighted_square(log_difference(log_albedo(root.u, root.v), wanted));
    constexpr int kSteps = 10;
    constexpr double kLeastFraction = 1e-6, kLeastScale = 0.05, kEnough = 1e-10;
    for (int step = 0; step < kSteps && error > kEnough; ++step) {
        const Root change = step_from(root, wanted);
        double scale = 1;
        for (; scale > kLeastScale; scale /= 2) {
            const Root next = {
                std::sqrt(std::clamp(root.u * root.u + scale * change.u, kLeastFraction, 1.0)),
                std::sqrt(std::clamp(root.v * root.v + scale * change.v, kLeastFraction, 1.0))};
            const double left = weighted_square(log_difference(log_albedo(next.u, next.v), wanted));
            if (left >= error) continue;
            root = next, error = left;
            break;
        }
        if (scale <= kLeastScale) break;
    }
    return {pigment_fraction(root.u, kMostMelanin), pigment_fraction(root.v, kMostBlood)};
}

}  // namespace dermis::inline optics
