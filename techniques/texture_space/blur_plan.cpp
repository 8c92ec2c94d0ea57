// From the parameters to the passes of the blur.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "techniques/texture_space/params.h"

namespace dermis::texture_space {
namespace {

constexpr int kMaxPasses = 16;

// Gosselin, Sander, Mitchell 2004: radius = texel * (3 kernel size + 2) on a light map of 512.
constexpr int kSourceSize = 512;
constexpr float kSourceScale = 3, kSourceBias = 2;

// The taps of a filter without its centre, and their share of the published filter, which includes the
// centre.
struct Taps {
    std::vector<TapRing> rings;
    float share = 1;
};

// The disk of twelve points as three rings of an even disk of the same variance, 0.3442 along one axis.
std::vector<TapRing> poisson_rings() {
    constexpr int kRings = 3;
    const double radius = std::sqrt(4 * 0.3442);
    std::vector<TapRing> rings;
    for (int i = 0; i < kRings; ++i)
        rings.push_back({.distance = radius * std::sqrt((i + 0.5) / kRings), .weight = 1.0 / kRings});
    return rings;
}

Taps taps_of(Filter filter) {
    switch (filter) {
        case Filter::poisson:
            return {poisson_rings(), 12.0f / 13};
        case Filter::gaussian:
            return {{{1, 2.0 / 3}, {std::numbers::sqrt2, 1.0 / 3}}, 12.0f / 16};
        case Filter::box:
            return {{{1, 0.5}, {std::numbers::sqrt2, 0.5}}, 8.0f / 9};
        case Filter::kawase:
            break;
    }
    return {};
}

// Pass i reads i + 1/2 texels off along both axes; each read is the mean of four texels, which adds 1/4.
double kawase_variance_texels(int pass) {
    return (pass + 0.5) * (pass + 0.5) + 0.25;
}

std::vector<BlurPass> equal_passes(int count, float share) {
    return std::vector<BlurPass>(size_t(std::max(count, 0)), {.radius = 1, .share = Vec3{1, 1, 1} * share});
}

std::vector<BlurPass> passes_of_profile(const Params& params, const FrameContext& frame,
                                        const BlurPlan& plan) {
    const double texel = typical_texel_mm(plan.size, frame);
    if (params.filter == Filter::kawase) {
        std::vector<double> variances;
        for (int i = 0; i < std::min(params.blur_passes, kMaxPasses); ++i)
            variances.push_back(kawase_variance_texels(i));
        return equal_passes(nearest_pass_count(frame.skin_gaussians, variances, texel), 1);
    }
    std::vector<BlurPass> passes = fit_blur(frame.skin_gaussians, {.passes = params.blur_passes,
                                                                   .rings = taps_of(params.filter).rings,
                                                                   .texel_mm = texel,
                                                                   .read_blurs = !plan.keeps_lit});
    if (!plan.in_mm)
        for (BlurPass& pass : passes) pass.radius /= float(texel);
    return passes;
}

}  // namespace

BlurPlan blur_plan(const Params& params, const FrameContext& frame) {
    BlurPlan plan = {
        .size = params.blur == Blur::source ? kSourceSize : params.atlas.light_map_size,
        .filter = params.blur == Blur::source ? Filter::poisson : params.filter,
        .in_mm = params.space == Space::mm && params.blur != Blur::source && params.filter != Filter::kawase};
    plan.keeps_lit = params.atlas.detail == AtlasDetail::pixel && params.blur != Blur::source;
    switch (params.blur) {
        case Blur::profile:
            plan.kernel_scale = params.atlas.kernel_growth;
            plan.passes = passes_of_profile(params, frame, plan);
            if (!plan.in_mm) return plan;
            plan.fitted_texel_mm = float(typical_texel_mm(plan.size, frame));
            plan.tap_variance = float(tap_variance(taps_of(plan.filter).rings));
            return plan;
        case Blur::source:
            plan.kernel_scale = kSourceScale;
            plan.kernel_bias = kSourceBias;
            break;
        case Blur::set:
            plan.kernel_scale = params.blur_scale;
            plan.kernel_bias = params.blur_bias;
            break;
    }
    plan.passes = equal_passes(params.blur_passes, taps_of(plan.filter).share);
    return plan;
}

GaussianSum set_blur(const Params& params) {
    double variance = 0;
    for (int i = 0; i < params.blur_passes; ++i)
        variance += params.filter == Filter::kawase
                        ? kawase_variance_texels(i)
                        : double(taps_of(params.filter).share) * tap_variance(taps_of(params.filter).rings) *
                              double(params.blur_bias * params.blur_bias);
    return {.terms = {{.variance_mm2 = variance}}};
}

float widest_tap(Filter filter, size_t pass) {
    return filter == Filter::kawase ? 0.5f + float(pass) : 1.0f;
}

// Variances of blurs add, so that n passes of radius r are as wide as m of radius r sqrt(n / m). A fit to
// the profile finds its own radii for the fewer passes; Kawase's radii follow from the number of the pass and
// are kept.
Params coarse_params(Params params, float scale) {
    if (params.blur == Blur::source) return params;  // its light map is small already
    const int32_t size = params.atlas.light_map_size;
    params.atlas = coarse_light_map(params.atlas, scale);
    if (params.filter == Filter::kawase) return params;
    // Half of the passes of a fit to the profile are rings of taps that show.
    const int32_t passes =
        params.blur == Blur::profile ? (3 * params.blur_passes + 3) / 4 : (params.blur_passes + 1) / 2;
    float wider = passes > 0 ? std::sqrt(float(params.blur_passes) / float(passes)) : 1.0f;
    if (params.space == Space::texels) wider *= float(params.atlas.light_map_size) / float(size);
    params.blur_passes = passes;
    params.blur_scale = std::min(params.blur_scale * wider, kMaxBlurRadius);
    params.blur_bias = std::min(params.blur_bias * wider, kMaxBlurRadius);
    return params;
}

}  // namespace dermis::texture_space
