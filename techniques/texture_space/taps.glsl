// The taps of the four filters that the source compares.
#ifndef DERMIS_TEXTURE_SPACE_TAPS_GLSL
#define DERMIS_TEXTURE_SPACE_TAPS_GLSL

#include "techniques/texture_space/constants.h"

layout(push_constant, scalar) uniform PassValues {
    float radius;        // where the kernel size below is 1
    float kernel_scale;  // kernel size: map * scale + bias
    float kernel_bias;
    float pass_index;
    vec3 share;          // of the light that the taps replace, a colour each
    float fitted_texel_mm;  // of the map that the radius was fitted for; 0: for none
    float tap_variance;     // along one axis, at radius 1
};

layout(constant_id = 0) const int blur_filter = kFilterPoisson;
layout(constant_id = 2) const int as_printed = 0;  // the disk as the source lists it, off its middle

// The twelve points of a Poisson disk that the source lists. Their mean is not 0, so that every pass moves the light.
const vec2 kPoissonDisk[12] =
    vec2[](vec2(-0.326212, -0.40581), vec2(-0.840144, -0.07358), vec2(-0.695914, 0.457137), vec2(-0.203345, 0.620716),
           vec2(0.96234, -0.194983), vec2(0.473434, -0.480026), vec2(0.519456, 0.767022), vec2(0.185461, -0.893124),
           vec2(0.507431, 0.064425), vec2(0.89642, 0.412458), vec2(-0.32194, -0.932615), vec2(-0.791559, -0.59771));

const vec2 kPoissonMean = vec2(0.030452, -0.104674);

int tap_count() { return blur_filter == kFilterPoisson ? 12 : blur_filter == kFilterKawase ? 4 : 8; }

// Offset in radii and weight of a tap around the centre; the weights sum to 1.
vec3 tap(int i) {
    if (blur_filter == kFilterPoisson) return vec3(kPoissonDisk[i] - (as_printed != 0 ? vec2(0.0) : kPoissonMean), 1.0 / 12.0);
    // Kawase 2003: four diagonal taps half a texel off, each pass a texel further out.
    if (blur_filter == kFilterKawase) return vec3(vec2((i & 1) * 2 - 1, (i & 2) - 1) * (0.5 + pass_index), 0.25);
    int cell = i < 4 ? i : i + 1;  // the eight cells around the middle of 3 x 3
    vec2 offset = vec2(cell % 3, cell / 3) - 1.0;
    // 1 2 1 in both axes, without the centre's 4.
    float weight = blur_filter == kFilterGaussian ? (2.0 - abs(offset.x)) * (2.0 - abs(offset.y)) / 12.0 : 0.125;
    return vec3(offset, weight);
}

#endif
