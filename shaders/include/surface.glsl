// The point being shaded: geometry from the vertex shader, material from its maps and constants.
#ifndef DERMIS_SURFACE_GLSL
#define DERMIS_SURFACE_GLSL

#include "shaders/include/frame.glsl"
#include "shaders/include/wrinkles.h"

// With several samples a pixel a triangle may cover a sample and not the pixel's middle. centroid keeps what would be wrong
// beyond the triangle inside of it. The others keep the derivatives that pick mip levels, or are of every technique, where
// it takes registers: occlusion is held above 0 instead.
layout(location = 0) in vec3 p_world_mm_in;
layout(location = 1) in vec3 n_world_in;
layout(location = 2) in vec4 t_world_in;
layout(location = 3) in vec2 uv_in;
layout(location = 4) in float occlusion_in;
layout(location = 5) centroid in vec3 curvature_diagonal_per_mm_in;
layout(location = 6) centroid in vec3 curvature_mixed_per_mm_in;
layout(location = 7) centroid in vec3 occlusion_blurred_in;
layout(location = 8) in vec4 color_linear_in;
layout(location = 9) in vec2 atlas_uv_in;
layout(location = 10) centroid in vec3 walked_gain_in;  // dermis/rays/vertex_gain.h
layout(location = 13) in float tension_in;     // dermis/mesh/tension.h; 0 of meshes at rest

layout(scalar) uniform Material {
    vec3 albedo_linear;
    float roughness;
    vec3 emission_linear;
    float specular;
    float f0;
    float metallic;
    float opacity;
    int normal_space;  // kNormalSpaceTangent, ...
    float normal_scale;
    int opacity_from_map;
    float curvature_scale_per_mm;  // of a difference of 1 in the curvature map
    float curvature_mid;           // its value on flat skin
    float alpha_cutoff;            // 0: nothing is cut out
    int emission_from_map;
    float scatter;                 // share of the skin's diffuse light that scatters
    int has_wrinkle_map;           // bits: kWrinkleStretch, kWrinkleCompress
    float wrinkle_from, wrinkle_full;  // tensions
    float wrinkle_stretch_weight, wrinkle_compress_weight;  // least shares by morph targets, 0 to 1
};

// Whether any material of the scene has the map; without one, the value 1 is a constant.
layout(constant_id = 50) const int has_albedo_map = 1;
layout(constant_id = 51) const int has_normal_map = 1;
layout(constant_id = 52) const int has_specular_map = 1;
layout(constant_id = 53) const int has_roughness_map = 1;
layout(constant_id = 54) const int has_occlusion_map = 1;

layout(constant_id = 57) const int has_scatter = 0;  // some skin of the scene scatters less than all
layout(constant_id = 58) const int has_scatter_map = 0;
layout(constant_id = 59) const int has_wrinkles = 0;  // some mesh is in a pose, and some material has a wrinkle map

uniform sampler2D albedo_map;
uniform sampler2D normal_map;
uniform sampler2DArray wrinkle_maps;  // stretched, compressed
uniform sampler2D specular_map;
uniform sampler2D roughness_map;
uniform sampler2D occlusion_map;
uniform sampler2D scatter_map;

struct Surface {
    vec3 p_world_mm;
    vec3 n_geometry_world;  // interpolated, without the normal map
    vec3 n_world;
    float n_mean_length;    // of the mean of the normal map's normals over the pixel: below 1 where they differ
    vec3 to_eye_world;
    vec2 uv;                // of the material's maps
    vec2 atlas_uv;          // of light maps and baked normals: dermis/scene/skin_atlas.h
    vec3 albedo_linear;
    float roughness;        // perceptual; alpha = roughness^2
    float f0;
    float occlusion;              // of the vertices or the map, the darker one
    float occlusion_vertex;
    vec3 occlusion_blurred;       // of the vertices, over the surface, by variances of kOcclusionVariance0Mm2, 1, 2
    vec3 curvature_diagonal_per_mm, curvature_mixed_per_mm;  // the tensor: dermis/mesh/mesh.h
};

float mean_curvature_per_mm(Surface s) {
    return 0.5 * dot(s.curvature_diagonal_per_mm, vec3(1.0));
}

// Levels by which a map is magnified, or 0. A bias adds to the level before it is clamped to 0, so
// under magnification a smoother read has to add these too.
float magnification_levels(sampler2D map, vec2 uv) {
    return max(-textureQueryLod(map, uv).y, 0.0);
}

// The shares of the normal that the wrinkle maps of stretched and of compressed skin have.
vec2 wrinkle_shares() {
    float stretch = (has_wrinkle_map & kWrinkleStretch) == 0
                        ? 0.0
                        : wrinkle_share(tension_in, wrinkle_from, wrinkle_full, wrinkle_stretch_weight);
    float compress = (has_wrinkle_map & kWrinkleCompress) == 0
                         ? 0.0
                         : wrinkle_share(-tension_in, wrinkle_from, wrinkle_full, wrinkle_compress_weight);
    return vec2(stretch, compress) * wrinkle_scale(stretch, compress);
}

// The mean of the normals that a read of the map covers, a positive bias covering more (Penner 2011), in the map's space:
// shorter than 1 where they differ. Wrinkle maps take the normal map's place by their shares; dermis/rays/mapped_normal.h
// has the same.
vec3 mean_of_normal_map(vec2 uv, float lod_bias) {
    vec3 n = texture(normal_map, uv, lod_bias).xyz;
    if (has_wrinkles != 0) {
        vec2 shares = wrinkle_shares();
        n = n * (1.0 - shares.x - shares.y) + texture(wrinkle_maps, vec3(uv, 0.0), lod_bias).xyz * shares.x +
            texture(wrinkle_maps, vec3(uv, 1.0), lod_bias).xyz * shares.y;
    }
    return n * 2.0 - 1.0;
}

// Tangent and bitangent of the maps, at right angles to n.
void tangent_frame(vec3 n, out vec3 t, out vec3 b) {
    t = normalize(t_world_in.xyz - n * dot(n, t_world_in.xyz));
    b = t_world_in.w * cross(n, t);
}

vec3 mean_normal_world(vec3 n_geometry_world, vec2 uv, float lod_bias) {
    if (has_normal_map == 0 || normal_space == kNormalSpaceAbsent) return n_geometry_world;
    vec3 n = mean_of_normal_map(uv, lod_bias);
    if (normal_space == kNormalSpaceObject) return mix(n_geometry_world, n, normal_scale);
    n.xy *= normal_scale;
    vec3 t, b;
    tangent_frame(n_geometry_world, t, b);
    return n.x * t + n.y * b + n.z * n_geometry_world;
}

// Attributes of the vertices. A shader takes its taps before it loads the rest, and loads the albedo last:
// fewer registers are live during the taps.
Surface load_geometry() {
    Surface s;
    s.p_world_mm = p_world_mm_in;
    s.n_geometry_world = normalize(n_world_in);
    s.uv = uv_in;
    s.atlas_uv = atlas_uv_in;
    s.occlusion_vertex = max(occlusion_in, 0.0);
    s.occlusion_blurred = occlusion_blurred_in;
    s.curvature_diagonal_per_mm = curvature_diagonal_per_mm_in;
    s.curvature_mixed_per_mm = curvature_mixed_per_mm_in;
    return s;
}

// `lod_bias`: level bias of the normal map.
void load_normal(inout Surface s, float lod_bias) {
    vec3 n_mean_world = mean_normal_world(s.n_geometry_world, uv_in, lod_bias);
    s.n_mean_length = length(n_mean_world);
    s.n_world = n_mean_world / s.n_mean_length;
}
void load_normal(inout Surface s) { load_normal(s, 0.0); }

void load_albedo(inout Surface s) {
    s.albedo_linear =
        albedo_linear * color_linear_in.rgb * (has_albedo_map != 0 ? texture(albedo_map, uv_in).rgb : vec3(1.0));
}

void load_occlusion(inout Surface s) {
    // The material's map and the mesh's own estimate are of the same shape: the darker one counts, not both.
    s.occlusion = min(max(occlusion_in, 0.0), has_occlusion_map != 0 ? texture(occlusion_map, uv_in).r : 1.0);
}

// Share of the diffuse light that scatters; the rest leaves where it entered.
float scatter_weight(Surface s) {
    return has_scatter == 0 ? 1.0 : scatter * (has_scatter_map != 0 ? texture(scatter_map, s.uv).r : 1.0);
}

// Loads all but normal, occlusion and albedo.
void load_gloss(inout Surface s) {
    s.to_eye_world = normalize(eye_world_mm - p_world_mm_in);
    s.roughness = clamp(roughness * (has_roughness_map != 0 ? texture(roughness_map, uv_in).r : 1.0), 0.03, 1.0);
    s.f0 = f0 * specular * (has_specular_map != 0 ? texture(specular_map, uv_in).r : 1.0);
}

// Loads all but normal and albedo.
void load_material(inout Surface s) {
    load_gloss(s);
    load_occlusion(s);
}

Surface load_surface() {
    Surface s = load_geometry();
    load_normal(s);
    load_material(s);
    load_albedo(s);
    return s;
}

#endif
