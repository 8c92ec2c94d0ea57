// Points of the picture in mm, from a place of the picture and a distance along the camera's axis.
#ifndef DERMIS_SCREEN_RAYS_GLSL
#define DERMIS_SCREEN_RAYS_GLSL

#include "shaders/include/frame.glsl"

// The point at uv (0..1, origin top-left) and axial distance z is eye + z * (corner + uv.x * right + uv.y * down).
struct PictureRays {
    vec3 forward, corner, right, down;
};

vec3 toward(vec2 ndc) {
    vec4 p = inverse_view_projection * vec4(ndc, 1.0, 1.0);
    return p.xyz / p.w - eye_world_mm;
}

vec3 at_distance_1(vec2 ndc, vec3 forward) {
    vec3 d = toward(ndc);
    return d / dot(d, forward);
}

PictureRays picture_rays() {
    PictureRays rays;
    rays.forward = normalize(toward(vec2(0.0)));
    rays.corner = at_distance_1(vec2(-1.0), rays.forward);
    rays.right = at_distance_1(vec2(1.0, -1.0), rays.forward) - rays.corner;
    rays.down = at_distance_1(vec2(-1.0, 1.0), rays.forward) - rays.corner;
    return rays;
}

// Position relative to the eye.
vec3 picture_point_mm(PictureRays rays, vec2 uv, float z_mm) {
    return z_mm * (rays.corner + uv.x * rays.right + uv.y * rays.down);
}

#endif
