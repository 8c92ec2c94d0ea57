// The last pass of a technique with a light map: the mesh through the camera, its diffuse light read from the map.
#ifndef DERMIS_ATLAS_FINAL_GLSL
#define DERMIS_ATLAS_FINAL_GLSL

#include "shaders/atlas/constants.h"
#include "shaders/atlas/light.glsl"
#include "shaders/atlas/written.glsl"
#include "shaders/include/gain.glsl"
#include "shaders/include/specular.glsl"
#include "shaders/include/transmission.glsl"
#include "shaders/include/view.glsl"

uniform texture2D light_map;

layout(location = 0) out vec4 radiance_out;

// Outside the atlas: other UDIM tiles, UVs beyond the edge.
bool outside_atlas(vec2 uv) { return any(greaterThan(abs(uv - 0.5), vec2(0.5001))); }

// False where the light map lacks the point: outside the atlas, between unwritten texels, and on
// skin seen from inside through the holes of an open mesh, whose texels may have been culled.
bool read_light_map(texture2D map, Surface s, int texels, out vec3 exitance) {
    vec4 blurred = texels == kTexelsWritten ? light_and_coverage(map, s.atlas_uv)
                                            : textureLod(sampler2D(map, linear_clamp), s.atlas_uv, 0.0);
    if (texels == kTexelsAsTheyAre) blurred.a = 1.0;
    exitance = blurred.rgb / max(blurred.a, 1e-4);
    bool from_inside = dot(s.n_geometry_world, s.to_eye_world) + kCullBias <= 0.0;
    return !(outside_atlas(s.atlas_uv) || from_inside || blurred.a < 1e-3);
}

layout(constant_id = 4) const int detail = kDetailPixel;

// Side of a square on the skin as large as a texel, or as a pixel if that is larger: light here holds no
// shorter waves. The first fundamental form gives the ratio of areas on the skin and in the atlas.
float coarser_side_mm(Surface s, vec2 texels) {
    vec2 across = dFdx(s.atlas_uv) * texels, down = dFdy(s.atlas_uv) * texels;
    float pixel_mm2 = length(cross(dFdx(s.p_world_mm), dFdy(s.p_world_mm)));
    float pixel_texels = abs(across.x * down.y - across.y * down.x);
    return sqrt(pixel_mm2 / clamp(pixel_texels, 1e-12, 1.0));
}

vec3 kept_detail(float side_mm) {
    float at = log2(max(side_mm, kDetailFirstMm) / kDetailFirstMm) * float(kDetailPerOctave);
    int i = int(min(at, float(kDetailSamples - 2)));
    return mix(detail_kept[i], detail_kept[i + 1], min(at - float(i), 1.0));
}

// Adds detail that the map's texels cannot hold: the light at the pixel minus the map's light before the blur, `map_lit`,
// damped as the blur damps it. Means of normals are compared, because the two read different levels of the normal map. The
// light at the pixel includes albedo ^ pre_scatter, as the map does.
vec3 scattered_exitance(texture2D map, texture2D map_lit, Surface s, vec3 direct, int texels, float pre_scatter) {
    vec3 blurred, lit;
    bool found = read_light_map(map, s, texels, blurred);
    if (found && detail == kDetailMap) return blurred;
    Exitance here = unblurred_exitance(s, direct);
    vec3 pre = pre_scatter > 0.0 ? pow(s.albedo_linear, vec3(pre_scatter)) : vec3(1.0);
    if (!found) return here.of_normal * pre;
    read_light_map(map_lit, s, texels, lit);
    vec3 kept = kept_detail(coarser_side_mm(s, vec2(textureSize(sampler2D(map, linear_clamp), 0))));
    return max(blurred + kept * (here.of_mean * pre - lit) + (here.of_normal - here.of_mean) * pre, vec3(0.0));
}

// The blur reaches points that are near along the surface; transmission adds those through the body. Near points of one
// surface have similar normals, opposite walls opposite ones. The blur goes around small parts, so the fourth power of the
// difference counts. On the dark side of a sphere of 4 mm, blur and transmission sum to 0.69 (texture_space) and 0.63
// (Gaussians) of the integral, of 2 mm to 1.18 and 1.01; without the power to 1.5 to 1.9.
float part_not_counted(LightMap map, LitPoint lit) {
    float turned = turned_away(lit), squared = turned * turned;
    return squared * squared;
}

// transmitted_part(). `passing`: share of the light past opaque and translucent surfaces.
vec3 transmitted_past(Surface s, int i, LightSample light, vec3 passing) {
    if (transmission == kTransmissionNone) return vec3(0.0);
    float n_dot_l = max(dot(s.n_world, light.to_light_world), 0.0), visibility = passing.r;
    if (tinted_shadows != 0 && n_dot_l > 0.0)
        visibility = light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm).visibility;
    return transmitted_part(s, i, light.to_light_world, n_dot_l, visibility, -1.0);
}

// The light of a pixel; shadows are looked up once.
struct PixelLight {
    vec3 direct, transmitted;       // exitance over albedo
    vec3 key_specular, specular;    // radiance: of the key light before anything casts a shadow, and of the others
    vec3 key_passing;
};

// Results of the taps in the light's maps. They need geometry and normal only.
struct Arrival {
    LightSample light;
    vec3 passing, transmitted;
};

Arrival arrival(Surface s, int i) {
    LightSample light = sample_light(i, s.p_world_mm);
    // Skin that faces away receives and reflects nothing.
    bool faces = dot(s.n_world, light.to_light_world) > 0.0;
    vec3 arriving = faces ? passing(s, i, light.to_light_world) : vec3(0.0);
    return Arrival(light, arriving, transmitted_past(s, i, light, arriving));
}

// Also loads the surface, after the taps of the single light.
PixelLight light_pixel(out Surface s) {
    s = load_geometry();
    load_normal(s);
    Arrival first;
    if (one_light != 0) first = arrival(s, 0);
    load_material(s);
    load_albedo(s);
    PixelLight sum = PixelLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0));
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        Arrival now;
        if (one_light != 0)
            now = first;
        else
            now = arrival(s, i);
        LightSample light = now.light;
        vec3 arriving = now.passing;
        float n_dot_l = dot(s.n_world, light.to_light_world);
        vec3 specular = light.irradiance_linear *
                        specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
        sum.direct += arriving_irradiance(light, max(n_dot_l, 0.0)) * diffuse_entry(s, n_dot_l) * shadow_factor(i, arriving);
        sum.transmitted += light.irradiance_linear * s.occlusion * now.transmitted;
        if (i == key_light) {
            sum.key_specular = specular;
            sum.key_passing = arriving;
        } else {
            sum.specular += specular * arriving;
        }
    }
    return sum;
}

#endif
