#version 460
#extension GL_GOOGLE_include_directive : require
// One pass of a blur in millimetres: the way to each tap is walked on the surface, independent of the UV layout and across
// seams. The steps of the metric have the kernel size in them.
#include "shaders/atlas/walk_mm.glsl"
#include "techniques/texture_space/constants.h"

layout(push_constant, scalar) uniform PassValues {
    float radius;           // mm, where the kernel size is 0
    vec3 share;             // of the light that the taps replace, a colour each
    float fitted_texel_mm;  // of the map that the radius was fitted for
};

layout(constant_id = 3) const int pieces = 1;  // of the way to a tap

layout(location = 0) out vec4 light_out;

// Reading between texels spreads light too: where texels are smaller on the skin than those of the fit the taps go farther,
// where they are larger less far, so that both together spread it as the fit has it.
float local_radius(BlurCentre centre) {
    float texel_area = 1.0 / max(abs(centre.steps.x * centre.steps.w - centre.steps.y * centre.steps.z), 1e-12);
    float lacking = kBilinearVariance * (fitted_texel_mm * fitted_texel_mm - texel_area) / kRingVariance;
    return sqrt(max(radius * radius + lacking, 0.0));
}

void main() {
    BlurCentre centre = blur_centre(ivec2(gl_FragCoord.xy));
    light_out = vec4(0.0);
    if (!centre.is_skin) return;
    vec4 here = light_at(centre.at);
    vec3 sum = here.rgb * (1.0 - share), weight = here.a * (1.0 - share);
    float here_radius = local_radius(centre);
    for (int i = 0; i < 8; ++i) {
        vec3 t = ring_tap(i, true);
        float way = length(t.xy);
        Walk walk = walk_from(centre, t.xy / way);
        for (int piece = 0; piece < pieces; ++piece) advance(walk, here_radius * way / float(pieces));
        vec4 light = light_at(walk);
        sum += light.rgb * t.z * share;
        weight += light.a * t.z * share;
    }
    if (here.a == 0.0 && weight == vec3(0.0)) return;
    light_out = half_rounded(vec4(mix(here.rgb, sum / max(weight, vec3(1e-6)), greaterThan(weight, vec3(1e-6))), 1.0));
}
