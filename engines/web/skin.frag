// Skin under distant lights and an environment: Lambert at the left of wipe_x, pre-integrated skin (Penner 2011) at its right.
// skin.essl, shared.glsl and light.glsl come before this file.

in vec3 p_mm;
in vec3 normal;
in vec4 tangent;
in vec2 uv;
in vec3 curvature_diagonal_per_mm, curvature_mixed_per_mm;
in vec4 occlusion;
out vec4 color;

const int kMaxLights = 4;
uniform vec3 eye_mm;
uniform float exposure;
uniform int tone_map;
uniform float wipe_x;     // in pixels
uniform bool is_skin;
uniform bool show_curvature;

uniform vec3 albedo_linear;
uniform float roughness_scale, f0;
uniform int normal_space;
uniform float normal_scale;
uniform sampler2D albedo_map, normal_map;
uniform sampler2D surface_map;  // roughness, factor on f0, occlusion

uniform int light_count;
uniform vec3 to_light[kMaxLights], irradiance_linear[kMaxLights];
uniform bool casts_shadow[kMaxLights];
uniform float shadow_width_mm;

uniform float skin_tone;                     // layer of the tables
uniform sampler2DArray diffuse_table;        // N.L by curvature
uniform sampler2DArray rows_table;           // kRowZonal, kRowShadow, kRowNormals
uniform float max_curvature_per_mm;          // of diffuse_table
uniform mat3 occlusion_weights;              // of the three blurs, a column each
uniform mat3 gain_form_mm;                   // slope, length and bend, a column each

vec4 read_row(int row, float x) {
    float size = float(textureSize(rows_table, 0).x);
    return texture(rows_table, vec3(texel_centres(x, size), (float(row) + 0.5) / float(kRowCount), skin_tone));
}

// The mean of the normals that a read of the map covers, `levels` more than the sharp one, in the map's space.
vec3 mean_of_normal_map(float levels) { return texture(normal_map, uv, levels).xyz * 2.0 - 1.0; }

vec3 to_world(vec3 n, vec3 mapped) {
    if (normal_space == kNormalSpaceAbsent) return n;
    if (normal_space == kNormalSpaceObject) return mix(n, mapped, normal_scale);
    mapped.xy *= normal_scale;
    vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz)), b = tangent.w * cross(n, t);
    return mapped.x * t + mapped.y * b + mapped.z * n;
}

// Mip level of the sharp read; below 0 the map is magnified.
float sharp_level(vec2 size) {
    vec2 dx = dFdx(uv) * size, dy = dFdy(uv) * size;
    return 0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1e-8));
}

struct Skin {
    vec3 n_geometry, n_sharp;
    vec3 n_mean;         // of the normals that the smoother read covers: shorter than 1 where they differ
    vec3 smooth_weight;  // of the light that these get, red, green, blue
    float smooth_levels;
    float bumps;         // variance of these normals
};

Skin make_skin(vec3 n) {
    vec2 size = vec2(textureSize(normal_map, 0));
    float level = sharp_level(size);
    float map_texel_mm = texel_mm(dFdx(p_mm), dFdy(p_mm), dFdx(uv) * size, dFdy(uv) * size);
    float read_mm = max(map_texel_mm, 1e-8) * exp2(max(level, 0.0));
    vec4 blend = read_row(kRowNormals, (log2(read_mm) - kMinLogMm) / (kMaxLogMm - kMinLogMm));
    float levels = blend.a + max(-level, 0.0);
    vec3 sharp = mean_of_normal_map(0.0), smooth_read = mean_of_normal_map(levels);
    Skin s = Skin(n, normalize(to_world(n, sharp)), to_world(n, smooth_read), blend.rgb, levels, 0.0);
    if (normal_space == kNormalSpaceAbsent) return s;
    s.n_mean /= length(sharp);
    s.bumps = normal_scale * normal_scale * bumps_variance(sharp, smooth_read);
    return s;
}

vec3 falloff(float n_dot_l, float k) {
    vec2 at = diffuse_coordinate(n_dot_l, min(k, max_curvature_per_mm), max_curvature_per_mm);
    return texture(diffuse_table, vec3(at, skin_tone)).rgb;
}

// Radiant exitance over irradiance at normal incidence. A shadow's edge scatters too, where the light is not grazing.
vec3 direct_skin(Skin s, vec3 l, float visibility, float scattered_part) {
    float k = curvature_towards(curvature_diagonal_per_mm, curvature_mixed_per_mm, s.n_geometry, l);
    float mean = dot(s.n_mean, l), deviation = bumps_deviation(s.bumps, mean);
    vec3 of_bumps = 0.5 * (falloff(min(mean + deviation, 1.0), k) + falloff(max(mean - deviation, -1.0), k));
    vec3 light = blended_light(falloff(dot(s.n_sharp, l), k), of_bumps, s.smooth_weight);
    return light * mix(vec3(visibility), read_row(kRowShadow, visibility).rgb, scattered_part);
}

vec3 scattered_occlusion(Skin s) {
    vec3 sharp = 1.0 - occlusion_weights[0] - occlusion_weights[1] - occlusion_weights[2];
    vec3 of_vertices = sharp * occlusion.x + occlusion_weights * occlusion.yzw;
    vec3 of_map = mix(texture(surface_map, uv).bbb, texture(surface_map, uv, s.smooth_levels).bbb, s.smooth_weight);
    return min(of_vertices, of_map);
}

vec3 ambient_skin(Skin s, float k) {
    vec3 band[3];
    for (int l = 0; l < 3; ++l)
        band[l] = sqrt(4.0 * kPi / float(2 * l + 1)) * read_row(kRowZonal + l, k / kMaxCurvaturePerMm).rgb;
    vec3 arriving = blended_light(environment_convolved(s.n_sharp, band[0], band[1], band[2]),
                                  environment_convolved(s.n_mean, band[0], band[1], band[2]), s.smooth_weight);
    return arriving * scattered_occlusion(s);
}

float specular(vec3 n, vec3 v, vec3 l, float roughness, float reflectance) {
    float n_dot_l = dot(n, l);
    if (n_dot_l <= 0.0) return 0.0;
    vec3 h = normalize(v + l);
    float n_dot_h = clamp(dot(n, h), 0.0, 1.0), n_dot_v = clamp(dot(n, v), 1e-3, 1.0);
    return fresnel_schlick(reflectance, clamp(dot(h, v), 0.0, 1.0)) * two_lobe_ggx(n_dot_h, n_dot_l, n_dot_v, roughness);
}

// Dark blue where it is flat, green at a radius of 16 mm, yellow at 8 mm, red at 4 mm and less.
vec3 curvature_color(float k) {
    float x = clamp(k / 0.25, 0.0, 1.0);
    vec3 low = mix(vec3(0.125, 0.188, 0.302), vec3(0.184, 0.561, 0.514), clamp(x * 4.0, 0.0, 1.0));
    vec3 high = mix(vec3(0.949, 0.827, 0.369), vec3(0.784, 0.216, 0.176), clamp(x * 2.0 - 1.0, 0.0, 1.0));
    return mix(low, high, clamp(x * 4.0 - 1.0, 0.0, 1.0));
}

void main() {
    vec3 n = normalize(normal), v = normalize(eye_mm - p_mm);
    float k = curvature_around(curvature_diagonal_per_mm, curvature_mixed_per_mm);
    if (show_curvature) {
        color = vec4(curvature_color(k) * (0.35 + 0.65 * max(dot(n, v), 0.0)), 1.0);
        return;
    }
    // Outside of the branch: every pixel of a block takes derivatives.
    Skin s = make_skin(n);
    vec3 n_sharp = s.n_sharp;
    vec3 albedo = albedo_linear * texture(albedo_map, uv).rgb;
    vec3 surface = texture(surface_map, uv).rgb;
    float roughness = clamp(roughness_scale * surface.r, 0.03, 1.0), reflectance = f0 * surface.g;
    float open = min(occlusion.x, surface.b);

    bool scatters = is_skin && gl_FragCoord.x >= wipe_x;
    vec3 exitance = scatters ? ambient_skin(s, k)
                             : environment_convolved(n_sharp, vec3(kPi), vec3(2.0 * kPi / 3.0), vec3(kPi / 4.0)) * open;
    vec3 reflected = environment_specular(n_sharp, v, roughness, reflectance, open);
    for (int i = 0; i < light_count; ++i) {
        vec3 l = to_light[i];
        float part = scatters ? smoothstep(kGrazing, kSteep, dot(n, l)) : 0.0;
        float visibility = casts_shadow[i] ? shadow_visibility(p_mm, n, l, mix(penumbra_mm, shadow_width_mm, part)) : 1.0;
        vec3 response = scatters ? direct_skin(s, l, visibility, part) : vec3(max(dot(n_sharp, l), 0.0) * visibility);
        exitance += irradiance_linear[i] * response;
        reflected += irradiance_linear[i] * visibility * specular(n_sharp, v, l, roughness, reflectance);
    }
    if (scatters) {
        float mean_curvature_per_mm = 0.5 * dot(curvature_diagonal_per_mm, vec3(1.0));
        exitance *= gain_of_curvature(mean_curvature_per_mm, gain_form_mm[0], gain_form_mm[1], gain_form_mm[2]);
    }
    vec3 radiance = albedo * exitance / kPi + reflected;
    color = vec4(srgb_encode(tone_mapped(max(radiance, vec3(0.0)) * exposure, tone_map)), 1.0);
}
