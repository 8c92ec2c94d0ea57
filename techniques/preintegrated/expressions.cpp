#include "techniques/preintegrated/expressions.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>

#include "dermis/bake/shadow_ramp.h"
#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/edge_expression.h"
#include "dermis/technique/transmission.h"
#include "techniques/preintegrated/normal_blend.h"

namespace dermis::preintegrated {
namespace {

static_assert(size_t(kPolynomialTerms) == kExpressionTerms && size_t(kEdgeWeights) == kEdgeTerms);

constexpr int kRampSteps = 129;

Vec3 to_vec3(const Rgb& rgb, double scale = 1) {
    return {float(scale * rgb[0]), float(scale * rgb[1]), float(scale * rgb[2])};
}

template <size_t N>
void add_array(std::vector<NamedValue>& values, const std::string& name, const std::array<Rgb, N>& array,
               double scale = 1) {
    for (size_t i = 0; i < N; ++i)
        values.emplace_back(name + "[" + std::to_string(i) + "]", to_vec3(array[i], scale));
}

std::array<Rgb, 2> squares(std::array<Rgb, 2> values) {
    for (Rgb& rgb : values)
        for (double& value : rgb) value *= value;
    return values;
}

void add_expressions(std::vector<NamedValue>& values, const CurvatureExpressions& form,
                     const EdgeExpression& edge) {
    add_array(values, "form_a", form.a, 0.5);
    add_array(values, "form_s", form.s, 0.5);
    add_array(values, "form_k0", form.k0, 0.5);
    add_array(values, "form_k1", form.k1, 0.5);
    add_array(values, "form_q", form.q);
    for (size_t l = 0; l < 3; ++l) add_array(values, "zonal_" + std::to_string(l), form.zonal[l]);
    values.emplace_back("curvature_knee", float(kCurvatureKnee));
    add_array(values, "edge", edge.weight);
    add_array(values, "edge_width2", squares(edge.width));
}

// The two narrowest become one, of their mean variance, until few enough are left: light that comes through
// skin is of the wide ones.
std::vector<GaussianTerm> few_gaussians(std::vector<GaussianTerm> terms) {
    std::ranges::sort(terms, std::greater(), &GaussianTerm::variance_mm2);
    while (terms.size() > size_t(kTransmissionGaussians)) {
        const GaussianTerm narrow = terms.back();
        terms.pop_back();
        GaussianTerm& both = terms.back();
        const double a = std::accumulate(narrow.weight.begin(), narrow.weight.end(), 0.0);
        const double b = std::accumulate(both.weight.begin(), both.weight.end(), 0.0);
        if (a + b > 0) both.variance_mm2 = (a * narrow.variance_mm2 + b * both.variance_mm2) / (a + b);
        for (size_t c = 0; c < 3; ++c) both.weight[c] += narrow.weight[c];
    }
    return terms;
}

void add_transmission_gaussians(std::vector<NamedValue>& values, const GaussianSum& sum) {
    const std::vector<GaussianTerm> terms = few_gaussians(sum.terms);
    Rgb total = {};
    for (const GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    for (size_t i = 0; i < size_t(kTransmissionGaussians); ++i) {
        Vec4 value = {};
        if (i < terms.size()) {
            const double v = terms[i].variance_mm2;
            const auto height = [&](size_t c) {
                return total[c] > 0 ? float(terms[i].weight[c] / total[c] / (2 * std::numbers::pi * v))
                                    : 0.0f;
            };
            value = {height(0), height(1), height(2), float(-0.5 / v * std::numbers::log2e)};
        }
        values.emplace_back("transmission_gaussians[" + std::to_string(i) + "]", value);
    }
}

void add_gaussians(std::vector<NamedValue>& values, const GaussianSum& sum) {
    Rgb total = {};
    for (const GaussianTerm& term : sum.terms)
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    for (size_t i = 0; i < size_t(kMaxGaussians); ++i) {
        Vec4 value = {0, 0, 0, 1};
        if (i < sum.terms.size()) {
            const GaussianTerm& term = sum.terms[i];
            const auto weight = [&](size_t c) {
                return total[c] > 0 ? float(term.weight[c] / total[c]) : 0.0f;
            };
            value = {weight(0), weight(1), weight(2), float(term.variance_mm2)};
        }
        values.emplace_back("gaussians[" + std::to_string(i) + "]", value);
    }
    values.emplace_back("gaussian_count", int32_t(sum.terms.size()));
}

}  // namespace

Result<std::vector<NamedValue>> skin_values(const TableSettings& settings, const SkinContext& skin,
                                            bool fit) {
    if (skin.gaussians.terms.size() > size_t(kMaxGaussians))
        return Error{"profile '" + skin.profile.name + "' has " +
                     std::to_string(skin.gaussians.terms.size()) + " Gaussians; preintegrated takes " +
                     std::to_string(kMaxGaussians) + " at most"};
    CurvatureExpressions form;
    EdgeExpression edge;
    if (fit) {
        const auto fitted =
            fit_curvature_expressions(skin.gaussians, {.construction = settings.construction});
        if (!fitted) return fitted.error();
        const auto ramp = shadow_ramp(skin.profile, settings.shadow_width_mm, kRampSteps);
        if (!ramp) return ramp.error();
        form = *fitted;
        edge = fit_edge_expression(*ramp);
    }
    std::vector<NamedValue> values;
    add_expressions(values, form, edge);
    add_gaussians(values, skin.gaussians);
    values.emplace_back("widest_blend_mm", float(widest_blend_mm(skin.gaussians)));
    values.emplace_back("transmission_reach_mm", float(transmission_reach_mm(skin.profile)));
    values.emplace_back("transmission_nearest", float(kTransmissionNearest));
    add_transmission_gaussians(values, skin.gaussians);
    return values;
}

}  // namespace dermis::preintegrated
