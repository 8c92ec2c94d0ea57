#version 460
#extension GL_GOOGLE_include_directive : require
// Pre-integrated skin: scattering as a function of N.L and curvature, of small bumps as one normal a channel, and of
// shadow edges as a function of where in the penumbra one is (Penner 2011).
#include "shared/frame.glsl"

layout(set = 0, binding = 1, scalar) uniform Params {
    float curvature_gain;
    float tune_curvature;
    float normal_lod_bias;
    float shadow_width_mm;
};
layout(constant_id = 3) const int shadow = 1;
// A plain shadow keeps the scene's penumbra, so that both variants filter what they should.
#define DERMIS_SHADOW_WIDTH_MM (shadow == 1 ? shadow_width_mm : penumbra_mm)
#include "shared/forward.glsl"
#include "preintegrated/curve_2015.glsl"

const int kDiffuseLut = 0, kDiffuseCurve2015 = 1, kDiffuseClosedForm = 2;
layout(constant_id = 2) const int diffuse = kDiffuseLut;
const int kShadowPlain = 0, kShadowScattered = 1;
const int kCurvatureVertex = 0, kCurvatureDerivative = 1, kCurvatureImage = 2;
layout(constant_id = 4) const int curvature = kCurvatureVertex;
const int kNormalsSharp = 0, kNormalsSmooth = 1, kNormalsBlended = 2;
layout(constant_id = 5) const int normals = kNormalsBlended;
const int kAmbientExact = 0, kAmbientCurve2015 = 1;
layout(constant_id = 6) const int ambient = kAmbientExact;

layout(set = 0, binding = 18) uniform texture2D curvature_map;
layout(set = 0, binding = 21) uniform texture2D skin_lut;          // N.L * .5 + .5, curvature
layout(set = 0, binding = 22) uniform texture2D skin_zonal;        // curvature, order 0 to 2
layout(set = 0, binding = 23) uniform texture2D skin_shadow;       // position in the penumbra, at shadow_width_mm
layout(set = 0, binding = 24) uniform texture2D skin_closed_form;  // curvature, rows a q s k0 k1
layout(set = 0, binding = 25) uniform texture2D skin_variance;     // mm^2 along one axis, per channel

const float kMaxCurvaturePerMm = 0.5;

// Similar triangles (Penner 2011): how fast the normal turns over how fast the point moves. It sees the mesh's facets
// and the camera's distance; the other two sources do not.
float derivative_curvature(Surface s) {
    return clamp(length(fwidth(s.n_geometry_world)), 0.0, 1.0) / (length(fwidth(s.p_world_mm)) * tune_curvature);
}

// Hollows scatter as bulges of the same curvature do.
float skin_curvature_per_mm(Surface s) {
    float k = s.curvature_per_mm;
    if (curvature == kCurvatureDerivative) k = derivative_curvature(s);
    if (curvature == kCurvatureImage)
        k = curvature_scale_per_mm * texture(sampler2D(curvature_map, trilinear_repeat), s.uv).r;
    return clamp(abs(k) * curvature_gain, 0.0, kMaxCurvaturePerMm);
}

// From the centre of the first texel to that of the last.
float texel_centres(float x, float size) { return (clamp(x, 0.0, 1.0) * (size - 1.0) + 0.5) / size; }

vec3 closed_form_row(float curvature_per_mm, int row) {
    vec2 size = vec2(textureSize(sampler2D(skin_closed_form, linear_clamp), 0));
    return textureLod(sampler2D(skin_closed_form, linear_clamp),
                      vec2(texel_centres(curvature_per_mm / kMaxCurvaturePerMm, size.x), (float(row) + 0.5) / size.y),
                      0.0).rgb;
}

// D = (a t + s sqrt(q^2 + t^2) + k0 + k1 t^2) / 2: src/fit/closed_form.h.
vec3 closed_form(vec3 t, float curvature_per_mm) {
    vec3 q = closed_form_row(curvature_per_mm, 1), t2 = t * t;
    return 0.5 * (closed_form_row(curvature_per_mm, 0) * t +
                  closed_form_row(curvature_per_mm, 2) * sqrt(q * q + t2) + closed_form_row(curvature_per_mm, 3) +
                  closed_form_row(curvature_per_mm, 4) * t2);
}

vec3 lut_sample(float t, float v) { return textureLod(sampler2D(skin_lut, linear_clamp), vec2(t * 0.5 + 0.5, v), 0.0).rgb; }

// One N.L a channel: the table is read once for each.
vec3 diffuse_falloff(vec3 t, float curvature_per_mm) {
    if (diffuse == kDiffuseCurve2015) return curve_2015_direct(t, curvature_per_mm);
    if (diffuse == kDiffuseClosedForm) return closed_form(t, curvature_per_mm);
    float v = curvature_per_mm / kMaxCurvaturePerMm;
    if (normals != kNormalsBlended) return lut_sample(t.r, v);
    return vec3(lut_sample(t.r, v).r, lut_sample(t.g, v).g, lut_sample(t.b, v).b);
}

// How far each channel's normal goes from the sharp to the smooth one. A read at mip level l averages over a box of
// w = 2^l texels, of variance w^2 / 12. Mixing the reads at l and l + bias with weight x adds x times the difference of
// their variances, which is to be the profile's.
vec3 normal_blend(Surface s) {
    vec2 map_size = vec2(textureSize(sampler2D(normal_map, trilinear_repeat), 0));
    float texel_mm = length(fwidth(s.p_world_mm)) / max(length(fwidth(s.uv) * map_size), 1e-8);
    float lod = max(textureQueryLod(sampler2D(normal_map, trilinear_repeat), s.uv).x, 0.0);
    float sharp_mm = exp2(lod) * texel_mm, smooth_mm = exp2(lod + normal_lod_bias) * texel_mm;
    float added_mm2 = (smooth_mm * smooth_mm - sharp_mm * sharp_mm) / 12.0;
    vec3 variance_mm2 = texelFetch(sampler2D(skin_variance, nearest_clamp), ivec2(0), 0).rgb;
    return clamp(variance_mm2 / max(added_mm2, 1e-8), 0.0, 1.0);
}

vec3 cosines(Surface s, vec3 to_light_world) {
    float sharp = dot(s.n_world, to_light_world);
    if (normals == kNormalsSharp) return vec3(sharp);
    float smoothed = dot(mapped_normal_world(s.n_geometry_world, s.uv, normal_lod_bias), to_light_world);
    if (normals == kNormalsSmooth) return vec3(smoothed);
    return mix(vec3(sharp), vec3(smoothed), normal_blend(s));
}

vec3 direct_response(Surface s, vec3 to_light_world, float visibility) {
    vec3 scattered = diffuse_falloff(cosines(s, to_light_world), skin_curvature_per_mm(s));
    if (shadow == kShadowPlain) return scattered * visibility;
    // Turned away from the light the shadow map only says what N.L says already; there the falloff alone decides.
    float facing = smoothstep(-0.15, 0.15, dot(s.n_geometry_world, to_light_world));
    vec3 penumbra = textureLod(sampler2D(skin_shadow, linear_clamp), vec2(visibility, 0.5), 0.0).rgb;
    return scattered * mix(vec3(1.0), penumbra, facing);
}

// sqrt(4 pi / (2 l + 1)) zh_l in place of the cosine lobe's bands (Ramamoorthi, Hanrahan 2001).
vec3 ambient_response(Surface s) {
    float k = skin_curvature_per_mm(s);
    vec3 zh[3];
    if (ambient == kAmbientCurve2015) {
        curve_2015_zonal(k, zh);
    } else {
        float width = float(textureSize(sampler2D(skin_zonal, linear_clamp), 0).x);
        for (int l = 0; l < 3; ++l)
            zh[l] = textureLod(sampler2D(skin_zonal, linear_clamp),
                               vec2(texel_centres(k / kMaxCurvaturePerMm, width), (float(l) + 0.5) / 3.0), 0.0).rgb;
    }
    return environment_convolved(s.n_world, sqrt(4.0 * kPi) * zh[0], sqrt(4.0 * kPi / 3.0) * zh[1],
                                 sqrt(4.0 * kPi / 5.0) * zh[2]);
}
