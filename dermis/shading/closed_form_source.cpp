#include "dermis/shading/closed_form_source.h"

#include <cmath>
#include <numbers>

#include "dermis/bake/shadow_ramp.h"
#include "dermis/base/text.h"
#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/edge_expression.h"
#include "dermis/shading/literals.h"

namespace dermis::shading::export_text {
namespace {

// Steps of visibility that the edge is fitted at.
constexpr int kRampSteps = 129;

// "    vec3 a = 0.5 + polynomial_6(u, vec3(...), ...);", the coefficients halved, as the light is half of
// their sum.
std::string half_polynomial(const std::string& name, double start, const CurvaturePolynomial& polynomial) {
    std::string text = "    vec3 " + name + " = ";
    if (start != 0) text += literal(start) + " + ";
    text += "polynomial_6(u";
    for (const Rgb& term : polynomial)
        text += ", " + vec3_literal({0.5 * term[0], 0.5 * term[1], 0.5 * term[2]});
    return text + ");\n";
}

Rgb squared(Rgb value) {
    for (double& channel : value) channel *= channel;
    return value;
}

}  // namespace

Result<std::string> diffuse_function(const GaussianSum& sum) {
    DERMIS_TRY_ASSIGN(const CurvatureExpressions form, fit_curvature_expressions(sum));
    return "// Diffuse light without a table: radiant exitance over irradiance at normal incidence, about 0 "
           "to 1.\n"
           "// n_dot_l from -1 to 1; curvature_per_mm 0 upwards, from 1 on the same. Within " +
           error_text(form.max_error) +
           " of the integral\n// over the sphere.\n"
           "vec3 skin_diffuse(float n_dot_l, float curvature_per_mm) {\n"
           "    float k = min(curvature_per_mm, 1.0), u = knee_coordinate(k, " +
           literal(kCurvatureKnee) + ");\n" + half_polynomial("a", 0.5, form.a) +
           half_polynomial("s", 0.5, form.s) + half_polynomial("k0", 0, form.k0) +
           half_polynomial("k1", 0, form.k1) + "    vec3 q = k * (" + vec3_literal(form.q[0]) + " + u * " +
           vec3_literal(form.q[1]) +
           ");\n"
           "    return line_and_hyperbola(vec3(n_dot_l), a, s, q, k0, k1);\n"
           "}\n";
}

Result<std::string> shadow_function(const Profile& profile) {
    DERMIS_TRY_ASSIGN(const std::vector<Rgb> ramp, shadow_ramp(profile, kShadowWidthMm, kRampSteps));
    const EdgeExpression edge = fit_edge_expression(ramp);
    std::string arguments;
    for (const Rgb& value : {edge.weight[0], edge.weight[1], edge.weight[2], edge.weight[3], edge.weight[4],
                             squared(edge.width[0]), edge.weight[5], squared(edge.width[1])})
        arguments += ", " + vec3_literal(value);
    return "// Light in a penumbra, 0 to 1, in place of the shadow's visibility, 0 to 1. The shadow's filter "
           "has to be\n"
           "// a disk of " +
           to_text(kShadowWidthMm) + " mm on the skin, at lights steeper than about 45 degrees. Within " +
           error_text(edge.max_error) +
           " of the integral.\n"
           "vec3 skin_shadow_edge(float visibility) {\n    return edge_of_hyperbolas(visibility" +
           arguments + ");\n}\n";
}

std::string transmission_function(const std::vector<ChannelGaussians>& terms) {
    std::string sum, total;
    for (size_t i = 0; i < terms.size(); ++i) {
        Rgb exponent;
        for (size_t c = 0; c < 3; ++c) exponent[c] = -0.5 * std::numbers::log2e / terms[i].variance_mm2[c];
        const std::string weight = "kSkinWeight" + std::to_string(i);
        sum += (i ? " + " : "") + weight + " * gaussian_falloff_rgb(thickness_mm, " + vec3_literal(exponent) +
               ")";
        total += (i ? " + " : "") + weight;
    }
    return "// Light through a slab, as part of the light that enters its far side: 1 at thickness 0. It "
           "ignores the far "
           "boundary\n// (d'Eon, Luebke 2007, section 14.5). thickness_mm is 0 upwards.\n"
           "vec3 skin_transmittance(float thickness_mm) {\n    vec3 total = " +
           total + ";\n    return (" + sum +
           ") / total;\n}\n\n"
           "// Of what a point of a slab sends out, the share that has entered its far side, 0 to 0.5; the "
           "rest has entered\n// here. mix(skin_diffuse(...), vec3(max(-N.L, 0.0)), skin_far_share(t)), each "
           "times the visibility of the light on\n// its side, is exact for a slab and keeps the energy. "
           "thickness_mm is 0 upwards.\n"
           "vec3 skin_far_share(float thickness_mm) {\n    vec3 through = skin_transmittance(thickness_mm);\n"
           "    return through / (1.0 + through);\n}\n";
}

}  // namespace dermis::shading::export_text
