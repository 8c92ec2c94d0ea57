#include "techniques/preintegrated/expressions.h"

#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/edge_expression.h"
#include "dermis/technique/transmission.h"
#include "techniques/preintegrated/normal_blend.h"
#include "techniques/preintegrated/shadow_ramp.h"

namespace dermis::preintegrated {
namespace {

static_assert(size_t(kPolynomialTerms) == kExpressionTerms);

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
    return values;
}

}  // namespace dermis::preintegrated
