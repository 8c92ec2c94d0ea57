#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>

#include "dermis/bake/shadow_ramp.h"
#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/edge_expression.h"
#include "dermis/technique/transmission.h"
#include "techniques/preintegrated/tables.h"
#include "techniques/preintegrated/weights.h"

namespace dermis::preintegrated {
namespace {

static_assert(size_t(kPolynomialTerms) == kExpressionTerms && size_t(kEdgeWeights) == kEdgeTerms);

constexpr int kRampSteps = 129;

template <size_t N>
void add_array(std::vector<NamedValue>& values, const std::string& name, const std::array<Rgb, N>& array,
               double scale = 1) {
    for (size_t i = 0; i < N; ++i)
        values.emplace_back(name + "[" + std::to_string(i) + "]", to_vec3(array[i]) * float(scale));
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

// Joins the two narrowest Gaussians, at their mean variance, until kTransmissionGaussians are left: the wide
// ones carry the light that comes through skin.
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

// Weights over their sum in each channel; 0 in a channel without light.
std::vector<GaussianTerm> normalised(std::vector<GaussianTerm> terms) {
    Rgb total = {};
    for (const GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    for (GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) term.weight[c] = total[c] > 0 ? term.weight[c] / total[c] : 0;
    return terms;
}

void add_gaussians(std::vector<NamedValue>& values, const GaussianSum& sum) {
    const auto add = [&](const std::string& name, std::vector<Vec4> list, int count, Vec4 unused) {
        list.resize(size_t(count), unused);
        for (size_t i = 0; i < list.size(); ++i)
            values.emplace_back(name + "[" + std::to_string(i) + "]", list[i]);
    };
    std::vector<Vec4> all, transmitted;
    const auto colour = [](const GaussianTerm& term, double divisor, double alpha) {
        return Vec4{float(term.weight[0] / divisor), float(term.weight[1] / divisor),
                    float(term.weight[2] / divisor), float(alpha)};
    };
    for (const GaussianTerm& term : normalised(sum.terms)) all.push_back(colour(term, 1, term.variance_mm2));
    for (const GaussianTerm& term : normalised(few_gaussians(sum.terms)))
        transmitted.push_back(colour(term, 2 * std::numbers::pi * term.variance_mm2,
                                     -0.5 / term.variance_mm2 * std::numbers::log2e));
    add("gaussians", std::move(all), kMaxGaussians, {0, 0, 0, 1});
    add("transmission_gaussians", std::move(transmitted), kTransmissionGaussians, {});
    values.emplace_back("gaussian_count", int32_t(sum.terms.size()));
}

}  // namespace

Result<std::vector<NamedValue>> skin_values(double shadow_width_mm, const SkinContext& skin, bool fit) {
    if (skin.gaussians.terms.size() > size_t(kMaxGaussians))
        return Error{"profile '" + skin.profile.name + "' has " +
                     std::to_string(skin.gaussians.terms.size()) + " Gaussians; preintegrated takes " +
                     std::to_string(kMaxGaussians) + " at most"};
    CurvatureExpressions form;
    EdgeExpression edge;
    if (fit) {
        const auto fitted = fit_curvature_expressions(skin.gaussians);
        if (!fitted) return fitted.error();
        const auto ramp = shadow_ramp(skin.profile, shadow_width_mm, kRampSteps);
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
    return values;
}

}  // namespace dermis::preintegrated
