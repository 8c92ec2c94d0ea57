// Light maps in texels: alpha is the size of the blur where skin was written, and kUnwritten elsewhere, where the colour
// is 0.
#ifndef DERMIS_ATLAS_WRITTEN_GLSL
#define DERMIS_ATLAS_WRITTEN_GLSL

#include "shaders/include/frame.glsl"

const float kUnwritten = 1.0;

// The bilinear mean over four texels, unwritten ones counting as 0, and the share of it that was written.
vec4 light_and_coverage(texture2D map, vec2 uv) {
    vec4 alphas = textureGather(sampler2D(map, linear_clamp), uv, 3);
    vec2 f = fract(uv * vec2(textureSize(sampler2D(map, linear_clamp), 0)) - 0.5);
    // In the order of textureGather: (0, 1), (1, 1), (1, 0), (0, 0).
    vec4 weights = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
    float coverage = dot(weights, vec4(lessThan(alphas, vec4(kUnwritten))));
    return vec4(textureLod(sampler2D(map, linear_clamp), uv, 0.0).rgb, coverage);
}

#endif
