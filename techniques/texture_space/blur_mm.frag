#version 460
#extension GL_GOOGLE_include_directive : require
// One pass of the same blur with its radius in millimetres: taps are on a disk on the surface, independent of the UV layout, and
// follow it across seams. The steps of the metric have the kernel size in them.
#include "shaders/atlas/blur_mm.glsl"
#include "techniques/texture_space/taps.glsl"

layout(location = 0) out vec4 light_out;

void main() {
    BlurCentre centre = blur_centre(ivec2(gl_FragCoord.xy));
    light_out = vec4(0.0);
    if (!centre.is_skin) return;
    vec4 here = blur_tap(centre, vec2(0.0));
    vec3 sum = here.rgb * (1.0 - share), weight = here.a * (1.0 - share);
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        vec4 light = blur_tap(centre, t.xy * radius);
        sum += light.rgb * t.z * share;
        weight += light.a * t.z * share;
    }
    if (here.a == 0.0 && weight == vec3(0.0)) return;
    light_out = half_rounded(vec4(mix(here.rgb, sum / max(weight, vec3(1e-6)), greaterThan(weight, vec3(1e-6))), 1.0));
}
