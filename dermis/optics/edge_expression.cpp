#include "dermis/optics/edge_expression.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dermis::inline optics {
namespace {

using Functions = Eigen::Matrix<double, 1, kEdgeTerms>;

Functions edge_functions(double y, double w0, double w1) {
    Functions f;
    f << y, y * y * y, y * y * y * y * y, y * std::sqrt(std::max(1 - y * y, 0.0)),
        y / std::sqrt(y * y + w0 * w0), y / std::sqrt(y * y + w1 * w1);
    return f;
}

struct EdgeFit {
    Eigen::Matrix<double, kEdgeTerms, 1> weight;
    double error = 0;
};

EdgeFit fit_widths(std::span<const Rgb> light, size_t channel, double w0, double w1) {
    Eigen::Matrix<double, Eigen::Dynamic, kEdgeTerms> basis(Eigen::Index(light.size()),
                                                            Eigen::Index(kEdgeTerms));
    Eigen::VectorXd target(static_cast<Eigen::Index>(light.size()));
    for (size_t i = 0; i < light.size(); ++i) {
        basis.row(Eigen::Index(i)) = edge_functions(2 * double(i) / double(light.size() - 1) - 1, w0, w1);
        target[Eigen::Index(i)] = 2 * light[i][channel] - 1;
    }
    EdgeFit fit;
    fit.weight = basis.colPivHouseholderQr().solve(target);
    fit.error = (basis * fit.weight - target).cwiseAbs().maxCoeff() / 2;
    return fit;
}

}  // namespace

EdgeExpression fit_edge_expression(std::span<const Rgb> light) {
    constexpr double kNarrowest = 0.005, kWidest = 3, kStep = 1.6;
    // Two wide hyperbolas that nearly cancel fit best of all, and lose their digits in 32 bits.
    constexpr double kLargestWeight = 64;
    EdgeExpression edge;
    for (size_t c = 0; c < 3; ++c) {
        EdgeFit best{.weight = {}, .error = 1e9};
        for (double w0 = kNarrowest; w0 < kWidest; w0 *= kStep)
            for (double w1 = w0 * kStep; w1 < kWidest * kStep; w1 *= kStep)
                if (const EdgeFit fit = fit_widths(light, c, w0, w1);
                    fit.error < best.error && fit.weight.cwiseAbs().maxCoeff() < kLargestWeight) {
                    best = fit;
                    edge.width[0][c] = w0, edge.width[1][c] = w1;
                }
        for (size_t k = 0; k < kEdgeTerms; ++k) edge.weight[k][c] = best.weight[Eigen::Index(k)];
        edge.max_error = std::max(edge.max_error, best.error);
    }
    return edge;
}

Rgb evaluate(const EdgeExpression& edge, double visibility) {
    const double y = 2 * std::clamp(visibility, 0.0, 1.0) - 1;
    Rgb light;
    for (size_t c = 0; c < 3; ++c) {
        const Functions f = edge_functions(y, edge.width[0][c], edge.width[1][c]);
        double sum = 0;
        for (size_t k = 0; k < kEdgeTerms; ++k) sum += edge.weight[k][c] * f[Eigen::Index(k)];
        light[c] = 0.5 + 0.5 * sum;
    }
    return light;
}

}  // namespace dermis::inline optics
