// Pre-integrated skin (Penner 2011): scattering is a function of N.L and curvature, at small bumps by one normal per
// channel, at shadow edges by the position in the penumbra. DERMIS_TABLES reads these functions from tables; without it they
// are expressions that are fitted to the same profile.
#ifndef DERMIS_PREINTEGRATED_SHADING_GLSL
#define DERMIS_PREINTEGRATED_SHADING_GLSL

#include "shaders/include/frame.glsl"
#include "techniques/preintegrated/constants.h"

layout(scalar) uniform Params {
    float curvature_gain;
    float shadow_width_mm;
};
layout(push_constant, scalar) uniform PassValues {
    vec3 occlusion_weight_0, occlusion_weight_1, occlusion_weight_2;  // of Surface::occlusion_blurred
#ifdef DERMIS_BAKED_NORMALS
    vec3 own_normal_weight;  // dermis/optics/diffused_normals.h
    float green_spread, diffused_texels;
#endif
};
layout(constant_id = 3) const int shadow = kShadowGathered;
// shadow=plain filters by the scene's penumbra, shadow=scattered by the width that the shadow table was made for.
#define DERMIS_SHADOW_WIDTH_MM shadow_filter_mm(s.n_geometry_world, light.to_light_world)

// At grazing light a wider filter than the penumbra would light skin that is in shadow.
float scattered_shadow_part(vec3 n_world, vec3 to_light_world) {
    return shadow == kShadowScattered ? smoothstep(kGrazing, kSteep, dot(n_world, to_light_world)) : 0.0;
}
float shadow_filter_mm(vec3 n_world, vec3 to_light_world) {
    return mix(penumbra_mm, shadow_width_mm, scattered_shadow_part(n_world, to_light_world));
}
#define DERMIS_PREPARE_SURFACE
#define DERMIS_OWN_VIEW
#define DERMIS_TRANSMISSION
#define DERMIS_OWN_BODY
#define DERMIS_OWN_CURVATURE
#define DERMIS_SCATTERED_VISIBILITY
#ifndef DERMIS_TABLES
#define DERMIS_TRANSMISSION_EXPRESSION
#elif !defined(DERMIS_BAKED_NORMALS)
#define DERMIS_BECKMANN_TABLE
#endif
#include "shaders/include/forward.glsl"
#include "shaders/include/skin/curvature.glsl"
#include "shaders/include/skin/curve_2015.glsl"
#include "shaders/include/skin/normals.glsl"
#include "techniques/preintegrated/skin.glsl"

layout(constant_id = 2) const int diffuse = kDiffuseLut;
layout(constant_id = 4) const int curvature = kCurvatureVertex;
layout(constant_id = 5) const int normals = kNormalsBlended;
layout(constant_id = 6) const int ambient = kAmbientProfile;

#ifndef DERMIS_BAKED_NORMALS
uniform sampler2D curvature_map;
#endif
// Set by prepare_geometry() and prepare_surface(); the same for every light.
vec3 skin_diagonal_per_mm, skin_mixed_per_mm;  // the curvature tensor
float curvature_around_per_mm;
vec3 n_mean_world;    // mean of the normals that the smoother read covers: shorter than 1 where they differ
vec3 smooth_weight;   // of the light on these normals; the light on the sharp normal has the rest
// Computed early, so that the derivatives of the texture coordinates do not stay in registers.
float sharp_normal_mm;  // width on the skin of the sharp read of the normal map
float normal_magnification, occlusion_magnification;  // magnification_levels()
float smooth_levels;  // mip levels from the sharp normal to the smooth one
float bumps;          // variance of the normals that the smoother read averages

#ifdef DERMIS_TABLES
#include "techniques/preintegrated/tables.glsl"
#include "techniques/preintegrated/gathered_shadow.glsl"
#else
#include "techniques/preintegrated/expressions.glsl"
#endif
#ifdef DERMIS_BAKED_NORMALS
#include "techniques/preintegrated/diffused_normals.glsl"
DiffusedNormals diffused;
float diffused_level;
#endif

void choose_curvature(Surface s) {
    skin_diagonal_per_mm = curvature_gain * s.curvature_diagonal_per_mm;
    skin_mixed_per_mm = curvature_gain * s.curvature_mixed_per_mm;
#ifndef DERMIS_BAKED_NORMALS
    if (curvature == kCurvatureVertex) return;
    if (curvature == kCurvatureImage) {
        vec3 t, b, per_mm = curvature_scale_per_mm * (texture(curvature_map, s.uv).rgb - curvature_mid);
        tangent_frame(s.n_geometry_world, t, b);
        skin_diagonal_per_mm = curvature_gain * tangent_diagonal(per_mm, t, b);
        skin_mixed_per_mm = curvature_gain * tangent_mixed(per_mm, t, b);
        return;
    }
    float k = curvature_from_derivatives(fwidth(s.n_geometry_world), fwidth(s.p_world_mm));
    skin_diagonal_per_mm = sphere_diagonal(curvature_gain * k, s.n_geometry_world);
    skin_mixed_per_mm = sphere_mixed(curvature_gain * k, s.n_geometry_world);
#endif
}

// A map's curvature has a sign as the vertices' has; that of derivatives has none.
float gain_curvature_per_mm(Surface s) {
    if (curvature == kCurvatureImage) return 0.5 * dot(skin_diagonal_per_mm, vec3(1.0));
    return curvature_gain * mean_curvature_per_mm(s);
}

float texel_of_normal_map_mm(Surface s) {
    vec2 map_size = vec2(textureSize(normal_map, 0));
    return texel_mm(dFdx(s.p_world_mm), dFdy(s.p_world_mm), dFdx(s.uv) * map_size, dFdy(s.uv) * map_size);
}

void prepare_geometry(Surface s) {
    choose_curvature(s);
    curvature_around_per_mm = min(curvature_around(skin_diagonal_per_mm, skin_mixed_per_mm), kMaxCurvaturePerMm);
    if (normals == kNormalsSharp) return;
#ifdef DERMIS_BAKED_NORMALS
    diffused_level = diffused_normals_level(s.atlas_uv, diffused_texels);
#endif
    float lod = max(textureQueryLod(normal_map, s.uv).x, 0.0);
    sharp_normal_mm = max(texel_of_normal_map_mm(s), 1e-8) * exp2(lod);
    normal_magnification = magnification_levels(normal_map, s.uv);
    if (has_occlusion_map != 0) occlusion_magnification = magnification_levels(occlusion_map, s.uv);
}

void prepare_surface(inout Surface s) {
    if (normals == kNormalsSharp) return;
    smooth_weight = vec3(1.0);
    smooth_levels = kPublishedNormalLevels;
    if (normals == kNormalsBlended || normals == kNormalsLerp) {
        vec4 blend = normal_blend(sharp_normal_mm);
        smooth_weight = blend.rgb;
        smooth_levels = blend.a;
    }
#ifdef DERMIS_BAKED_NORMALS
    diffused = read_diffused_normals(s, own_normal_weight, green_spread, curvature_around_per_mm, diffused_level);
    diffused.k_per_mm *= curvature_gain;
#else
    float bias = smooth_levels + normal_magnification;
    n_mean_world = mean_normal_world(s.n_geometry_world, s.uv, bias);
    bumps = 0.0;
    if (normal_space == kNormalSpaceAbsent) return;
    vec3 of_sharp = mean_of_normal_map(s.uv, 0.0);
    n_mean_world /= length(of_sharp);
    bumps = normal_scale * normal_scale * bumps_variance(of_sharp, mean_of_normal_map(s.uv, bias));
#endif
}

vec3 falloff(float n_dot_l, float k) {
    if (diffuse == kDiffuseCurve2015) return curve_2015_direct(n_dot_l, k);
    if (diffuse == kDiffuseClosedForm) return closed_form(vec3(n_dot_l), k);
    return profile_falloff(n_dot_l, k);
}

// One N.L per channel.
vec3 falloff_of_channels(vec3 n_dot_l, float k) {
    return vec3(falloff(n_dot_l.r, k).r, falloff(n_dot_l.g, k).g, falloff(n_dot_l.b, k).b);
}

// The mean light of the bumps that the smoother read covers.
vec3 falloff_of_bumps(vec3 to_light_world, float k) {
    float mean = dot(n_mean_world, to_light_world), deviation = bumps_deviation(bumps, mean);
    return 0.5 * (falloff(min(mean + deviation, 1.0), k) + falloff(max(mean - deviation, -1.0), k));
}

vec3 diffuse_falloff(Surface s, vec3 to_light_world) {
#ifdef DERMIS_BAKED_NORMALS
    return falloff_of_diffused_normals(diffused, to_light_world, kMaxCurvaturePerMm);
#else
    float k = min(curvature_towards(skin_diagonal_per_mm, skin_mixed_per_mm, s.n_geometry_world, to_light_world),
                  kMaxCurvaturePerMm);
    if (normals == kNormalsSmooth) return falloff(dot(normalize(n_mean_world), to_light_world), k);
    if (normals == kNormalsLerp) {
        vec3 n_smooth = normalize(n_mean_world);
        return falloff_of_channels(vec3(dot(lerped_normal(s.n_world, n_smooth, smooth_weight.r), to_light_world),
                                        dot(lerped_normal(s.n_world, n_smooth, smooth_weight.g), to_light_world),
                                        dot(lerped_normal(s.n_world, n_smooth, smooth_weight.b), to_light_world)), k);
    }
    vec3 sharp = falloff(dot(s.n_world, to_light_world), k);
    if (normals == kNormalsSharp) return sharp;
    return blended_light(sharp, falloff_of_bumps(to_light_world, k), smooth_weight);
#endif
}

vec3 direct_response(Surface s, vec3 to_light_world) { return diffuse_falloff(s, to_light_world); }

Entering scattered_visibility(Surface s, int light, vec3 to_light_world, float visibility) {
    if (shadow == kShadowPlain) return Entering(vec3(visibility), vec3(visibility));
#ifdef DERMIS_TABLES
    if (shadow == kShadowGathered) return gathered_visibility(s, light, to_light_world, visibility);
#endif
    vec3 edge = mix(vec3(visibility), profile_edge(visibility), scattered_shadow_part(s.n_geometry_world, to_light_world));
    return Entering(edge, edge);
}

// The chord of the sphere of this curvature.
float own_way_mm(Surface s, vec3 to_light_world) {
    float k = curvature_towards(skin_diagonal_per_mm, skin_mixed_per_mm, s.n_geometry_world, to_light_world);
    return 2.0 * max(-dot(s.n_geometry_world, to_light_world), 0.0) / max(k, 1e-4);
}

// sqrt(4 pi / (2 l + 1)) zh_l in place of the cosine lobe's bands (Ramamoorthi, Hanrahan 2001).
void ambient_bands(out vec3 band[3]) {
    vec3 zh[3];
    if (ambient == kAmbientCurve2015) {
        zh[0] = curve_2015_zonal_0(curvature_around_per_mm);
        zh[1] = curve_2015_zonal_1(curvature_around_per_mm);
        zh[2] = vec3(0.495416);
    } else if (ambient == kAmbientExact) {
        exact_zonal(curvature_around_per_mm, zh);
    } else {
        profile_zonal(curvature_around_per_mm, zh);
    }
    for (int l = 0; l < 3; ++l) band[l] = sqrt(4.0 * kPi / float(2 * l + 1)) * zh[l];
}

// Occluded light scatters too: a crease is lit through its sides, in red farther than in blue. weights.h mixes the
// occlusion of the vertices; the occlusion map is mixed like the normals.
vec3 scattered_occlusion(Surface s) {
    vec3 weight_0 = occlusion_weight_0, weight_1 = occlusion_weight_1, weight_2 = occlusion_weight_2;
    vec3 of_vertices = (1.0 - weight_0 - weight_1 - weight_2) * s.occlusion_vertex + weight_0 * s.occlusion_blurred.x +
                       weight_1 * s.occlusion_blurred.y + weight_2 * s.occlusion_blurred.z;
    if (has_occlusion_map == 0) return of_vertices;
    float levels = smooth_levels + occlusion_magnification;
    float sharp = texture(occlusion_map, s.uv).r;
    if (normals == kNormalsSharp) return min(of_vertices, vec3(sharp));
    vec3 of_map = mix(vec3(sharp), texture(occlusion_map, s.uv, levels).rrr, smooth_weight);
    return min(of_vertices, of_map);
}

#ifdef DERMIS_BAKED_NORMALS
// The mean of the lobe's first band has the length of the mean normal. Blue takes green's direction, which is nearly its own.
vec3 ambient_of_diffused_normals() {
    vec3 band_1 = 2.0 * kPi / 3.0 * diffused.mean_length, band_2 = 0.25 * kPi * diffused.band_2;
    return vec3(environment_convolved(diffused.n[0], vec3(kPi), band_1, band_2).r,
                environment_convolved(diffused.n[1], vec3(kPi), band_1, band_2).gb);
}
vec3 ambient_response(Surface s) { return ambient_of_diffused_normals() * scattered_occlusion(s); }
#else
vec3 ambient_response(Surface s) {
    vec3 band[3];
    ambient_bands(band);
    vec3 arriving = environment_convolved(s.n_world, band[0], band[1], band[2]);
    if (normals == kNormalsLerp) {
        vec3 n_smooth = normalize(n_mean_world);
        for (int c = 0; c < 3; ++c)
            arriving[c] = environment_convolved(lerped_normal(s.n_world, n_smooth, smooth_weight[c]), band[0], band[1], band[2])[c];
    } else if (normals != kNormalsSharp) {
        arriving = blended_light(arriving, environment_convolved(n_mean_world, band[0], band[1], band[2]), smooth_weight);
    }
    return arriving * scattered_occlusion(s);
}
#endif

// The curvature that shading uses: radiance 1 is 0.25 per mm.
vec3 own_view(Surface s) {
#ifdef DERMIS_BAKED_NORMALS
    return vec3(4.0 * diffused.k_per_mm);
#else
    return vec3(4.0 * curvature_around_per_mm);
#endif
}

#endif
