// A head's skin under one light and under light from all around, from what is baked for it. For Unity and Unreal, whose own files give
// before this one Skin.hlsl, kSkinMaxCurvaturePerMm and
//
//     #define SKIN_TABLE_IN and SKIN_TABLE, parameters and arguments of SkinTable() before the others, each with its comma
//     float3 SkinTable(SKIN_TABLE_IN float2 uv): the skin's table there
//
// "The mesh's space" is that of the exported file, in which all maps and tensors are baked. The world's axes are those of that space, up to
// a rotation; of a mesh that moves the space turns with the frames of the vertices.
#ifndef DERMIS_SKIN_HEAD_LIGHT
#define DERMIS_SKIN_HEAD_LIGHT

// The axes of the world in the mesh's space at a pixel.
static float3 skin_axis_x, skin_axis_y, skin_axis_z;

float3 SkinMeshToWorld(float3 direction) {
    return normalize(float3(dot(skin_axis_x, direction), dot(skin_axis_y, direction), dot(skin_axis_z, direction)));
}
float3 SkinWorldToMesh(float3 direction) {
    return normalize(skin_axis_x * direction.x + skin_axis_y * direction.y + skin_axis_z * direction.z);
}

struct SkinHeadSurface {
    float3 n, v;              // world; n with the normal map
    float3 n_geometry;        // world
    float3 n_mesh, n_red, n_green, n_blue, diagonal, mixed;  // the mesh's space
    float3 band_1, band_2;    // factors on Lambert's bands of light from all around
    float2 uneven;
    float curvature_per_mm, curvature_gain;
    float baked_normals, scattering;  // 0 or 1
    float3 albedo, gain, gain_behind, far_share, scattered_occlusion;
    float occlusion, roughness, f0, past_far_wall_mm;
};

float SkinLimited(SkinHeadSurface s, float curvature_per_mm) { return min(s.curvature_gain * curvature_per_mm, kSkinMaxCurvaturePerMm); }

// A tangent-space normal map's, in the world. Derivatives are over the pixel, to the right and down. The bitangent is on the side where the
// texture coordinate v falls, or grows with v_sign -1: whichever sign a reader gives it.
float3 SkinMappedNormal(float3 n, float3 tangent, float3 mapped, float strength, float v_sign, float3 p_dx, float3 p_dy, float2 uv_dx,
                        float2 uv_dy) {
    float3 t = normalize(tangent - n * dot(n, tangent)), b = cross(n, t);
    float3 along_v = (p_dy * uv_dx.x - p_dx * uv_dy.x) * (uv_dx.x * uv_dy.y - uv_dx.y * uv_dy.x);
    if (v_sign * dot(b, along_v) > 0.0) b = -b;
    return normalize(strength * (mapped.x * t + mapped.y * b) + mapped.z * n);
}

// After n, v, n_geometry and the settings. bends: the curvature tensor in the frame of the vertices, in 1/mm.
void SkinSetCurvature(inout SkinHeadSurface s, float3 bends) {
    s.n_mesh = SkinWorldToMesh(s.n_geometry);
    float3 t = skin_vertex_tangent(s.n_mesh), b = cross(s.n_mesh, t);
    s.diagonal = skin_tangent_diagonal(bends, t, b);
    s.mixed = skin_tangent_mixed(bends, t, b);
    s.curvature_per_mm = SkinLimited(s, skin_curvature_around(s.diagonal, s.mixed));
    s.n_red = s.n_green = s.n_blue = SkinWorldToMesh(s.n);
    s.band_1 = skin_ambient_band_1(s.curvature_per_mm) * (1.5 / kSkinPi);
    s.band_2 = skin_ambient_band_2(s.curvature_per_mm) * (4.0 / kSkinPi);
}

// Texels of the three maps at the level of skin_baked_level(). After SkinSetCurvature().
void SkinSetBakedNormals(inout SkinHeadSurface s, float3 red, float3 green, float3 spread) {
    float3 own_mesh = SkinWorldToMesh(s.n);
    s.n_red = skin_mean_normal_red(red, spread, own_mesh);
    s.n_green = skin_mean_normal_green(red, green, spread, own_mesh);
    s.n_blue = skin_mean_normal_blue(red, green, spread, own_mesh);
    float3 lengths = float3(length(s.n_red), length(s.n_green), length(s.n_blue));
    s.n_red /= lengths.r;
    s.n_green /= lengths.g;
    s.n_blue /= lengths.b;
    float is_skin = skin_baked_skin(red);
    s.uneven = (spread.xy * 2.0 - 1.0) * is_skin;
    s.curvature_per_mm = lerp(s.curvature_per_mm, SkinLimited(s, skin_curvature_of_mean(lengths.r)), is_skin);
    s.band_1 = lengths;
    s.band_2 = skin_band_2_of_means(lengths);
}

// surface: occlusion, roughness, factor on f0. The other occlusions are the vertices'; curved_gain is 0 or 1.
void SkinSetMaterial(inout SkinHeadSurface s, float3 albedo, float3 surface, float roughness, float f0, float occlusion, float3 scattered,
                     float mean_curvature_per_mm, float curved_gain, float thickness_mm) {
    s.albedo = albedo;
    s.roughness = max(roughness * surface.g, 0.03);
    s.f0 = f0 * surface.b;
    s.occlusion = min(occlusion, surface.r);
    s.scattered_occlusion = min(scattered, (float3)surface.r);
    s.gain = curved_gain > 0.5 ? skin_gain(s.curvature_gain * mean_curvature_per_mm) : (float3)1.0;
    s.gain_behind = curved_gain > 0.5 ? skin_gain_through(s.gain, kSkinGainOfSlabs) : (float3)1.0;
    s.far_share = skin_far_share(thickness_mm);
    s.past_far_wall_mm = skin_past_far_wall_mm(thickness_mm);
}

float SkinHeadNDotV(SkinHeadSurface s) { return clamp(dot(s.n, s.v), 1e-3, 1.0); }

float3 SkinFalloff(SKIN_TABLE_IN float n_dot_l, float curvature_per_mm) {
    return SkinTable(SKIN_TABLE skin_diffuse_coordinate(n_dot_l, curvature_per_mm, kSkinMaxCurvaturePerMm));
}

// In place of saturate(N.L).
float3 SkinEntered(SKIN_TABLE_IN SkinHeadSurface s, float3 to_light_world) {
    if (s.scattering < 0.5) return (float3)saturate(dot(s.n, to_light_world));
    float3 to_light = SkinWorldToMesh(to_light_world);
    float curvature = s.curvature_per_mm * sqrt(skin_spread_towards(s.n_red, s.uneven, to_light));
    if (s.baked_normals < 0.5) curvature = s.curvature_gain * skin_curvature_towards(s.diagonal, s.mixed, s.n_mesh, to_light);
    curvature = min(curvature, kSkinMaxCurvaturePerMm);
    return float3(SkinFalloff(SKIN_TABLE dot(s.n_red, to_light), curvature).r,
                  SkinFalloff(SKIN_TABLE dot(s.n_green, to_light), curvature).g,
                  SkinFalloff(SKIN_TABLE dot(s.n_blue, to_light), curvature).b);
}

// Reflected radiance of one light, whose color is the irradiance at normal incidence over pi. entering: the part of it that enters around
// the point, visible: that arrives at the point itself, behind: on the far side of a thin part.
float3 SkinHeadLight(SKIN_TABLE_IN SkinHeadSurface s, float3 to_light, float3 color, float3 entering, float visible, float behind) {
    float3 diffuse = SkinEntered(SKIN_TABLE s, to_light) * entering, specular = (float3)0;
    if (s.scattering > 0.5) {
        diffuse *= s.gain * (1.0 - s.far_share);
        diffuse += s.gain_behind * s.far_share * (behind * saturate(-dot(s.n_geometry, to_light)));
    }
    float n_dot_l = dot(s.n, to_light);
    if (n_dot_l > 0.0) {
        float3 h = normalize(to_light + s.v);
        float lobe = skin_ggx(saturate(dot(s.n, h)), n_dot_l, SkinHeadNDotV(s), s.roughness * s.roughness);
        specular = (float3)(kSkinPi * lobe * skin_fresnel_schlick(s.f0, saturate(dot(h, s.v))) * visible);
    }
    return (s.albedo * diffuse + specular) * color;
}

// Irradiance over pi, with factors on its bands (Ramamoorthi, Hanrahan 2001). terms: of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
float3 SkinProbe(float3 terms[9], float3 n, float3 band_1, float3 band_2) {
    float3 first = terms[1] * n.y + terms[2] * n.z + terms[3] * n.x;
    float3 second = terms[4] * (n.x * n.y) + terms[5] * (n.y * n.z) + terms[6] * (3.0 * n.z * n.z - 1.0) + terms[7] * (n.x * n.z) +
                    terms[8] * (n.x * n.x - n.y * n.y);
    return max(terms[0] + band_1 * first + band_2 * second, (float3)0.0);
}

// Reflected light from all around.
float3 SkinHeadAmbient(SkinHeadSurface s, float3 terms[9]) {
    if (s.scattering < 0.5) return s.albedo * SkinProbe(terms, s.n, (float3)1.0, (float3)1.0) * s.occlusion;
    // Blue takes green's direction, which is nearly its own.
    float3 of_red = SkinProbe(terms, SkinMeshToWorld(s.n_red), s.band_1, s.band_2);
    float3 of_green = SkinProbe(terms, SkinMeshToWorld(s.n_green), s.band_1, s.band_2);
    return s.albedo * float3(of_red.r, of_green.gb) * s.scattered_occlusion * s.gain;
}

// Reflected light of the environment: the split sum (Karis 2013). radiance: the environment, filtered by the lobe of s.roughness around the
// mirrored direction; shares: red and green of reflected_shares.exr at SkinReflectedShareAt(), with the picture's first row at v 0.
float2 SkinReflectedShareAt(SkinHeadSurface s) { return float2(SkinHeadNDotV(s), s.roughness); }
float3 SkinHeadReflection(SkinHeadSurface s, float2 shares, float3 radiance) {
    return radiance * ((s.f0 * shares.x + shares.y) * skin_specular_occlusion(SkinHeadNDotV(s), s.occlusion, s.roughness));
}

#endif
