// A Gaussian along one of the two steps of the metric, which are as long as the kernel size: sigma in mm.
#ifndef DERMIS_TEXTURE_SPACE_GAUSSIAN_GLSL
#define DERMIS_TEXTURE_SPACE_GAUSSIAN_GLSL

#extension GL_EXT_control_flow_attributes : require
#include "shaders/atlas/walk_mm.glsl"

layout(constant_id = 0) const int along_second = 0;
layout(constant_id = 1) const int half_taps = 3;
layout(constant_id = 2) const int pieces = 1;  // of the way from tap to tap

// Taps one sigma apart out to `half_taps` sigma have this variance in squares of their distance; at 3 it is 0.996.
float spacing() {
    float sum = 1.0, second_moment = 0.0;
    for (int k = 1; k <= half_taps; ++k) {
        float w = 2.0 * exp(-0.5 * float(k * k) * 9.0 / float(half_taps * half_taps));
        sum += w;
        second_moment += w * float(k * k);
    }
    return inversesqrt(second_moment / sum);
}

// Sigma of the taps, in texels, for a Gaussian of this variance in texels^2, reads between texels included: these add 1/6
// along each axis that they lie off, so 1/4 for both passes as a mean over the directions of the steps. Offsets under
// half a texel have a variance of their own length instead of its square.
float tap_sigma_texels(float variance) { return variance < 0.5 ? variance : sqrt(variance - 0.25); }

vec4 gaussian(float sigma_mm) {
    BlurCentre centre = blur_centre(ivec2(gl_FragCoord.xy));
    if (!centre.is_skin) return vec4(0.0);
    float texels_per_mm = sqrt(max(abs(centre.steps.x * centre.steps.w - centre.steps.y * centre.steps.z), 1e-12));
    float variance = sigma_mm * texels_per_mm;
    float step_mm = tap_sigma_texels(variance * variance) / texels_per_mm * spacing();
    vec4 sum = light_at(centre.at);
    [[unroll]] for (int side = -1; side <= 1; side += 2) {
        Walk walk = walk_from(centre, float(side) * vec2(1 - along_second, along_second));
        [[unroll]] for (int k = 1; k <= half_taps; ++k) {
            for (int piece = 0; piece < pieces; ++piece) advance(walk, step_mm / float(pieces));
            sum += light_at(walk) * exp(-0.5 * float(k * k) * 9.0 / float(half_taps * half_taps));
        }
    }
    return normalize_by_alpha(sum);
}

#endif
