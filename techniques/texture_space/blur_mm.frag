#version 460
#extension GL_GOOGLE_include_directive : require
// One pass of the same blur with its radius in millimetres: taps are on a disk on the surface, independent of the UV layout, and
// follow it across seams.
#include "shaders/atlas/blur_mm.glsl"
#include "techniques/texture_space/taps.glsl"

layout(location = 0) out vec4 light_out;

void main() {
    BlurCentre centre = blur_centre(ivec2(gl_FragCoord.xy));
    light_out = vec4(0.0);
    if (!centre.is_skin) return;
    vec4 sum = blur_tap(centre, vec2(0.0)) * centre_weight();
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        sum += blur_tap(centre, t.xy) * t.z;
    }
    light_out = normalize_by_alpha(sum);
}
