// The lit pass of a head: baked normals, curvature and occlusion of the vertices, scattered shadow edges of the main light, light
// through thin parts, scattered light of the ambient probe.
//
// glTFast mirrors x and turns every pair of texture coordinates upside down: y is 1 - y. "The mesh's space" below is that of the file,
// in which all maps and tensors are baked; of a mesh that moves it turns with the frames of the vertices.
#ifndef DERMIS_SKIN_HEAD_FORWARD
#define DERMIS_SKIN_HEAD_FORWARD

#include "SkinHeadInput.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
#include "../Runtime/Skin.hlsl"

static const float kSkinMaxCurvaturePerMm = @max_curvature_per_mm@;
static const float2 kTableSize = float2(@table_width@, @table_height@);

TEXTURE2D(_BaseMap);
SAMPLER(sampler_BaseMap);
TEXTURE2D(_NormalMap);
SAMPLER(sampler_NormalMap);
TEXTURE2D(_SurfaceMap);
SAMPLER(sampler_SurfaceMap);
TEXTURE2D(_NormalsRed);
SAMPLER(sampler_NormalsRed);
TEXTURE2D(_NormalsGreen);
TEXTURE2D(_NormalsSpread);
TEXTURE2D(_ThicknessMap);
SAMPLER(sampler_ThicknessMap);
TEXTURE2D(_SkinTable);
SAMPLER(sampler_SkinTable);

// The axes of the world in the mesh's space at a pixel.
static float3 skin_axis_x, skin_axis_y, skin_axis_z;

float3 SkinMeshToWorld(float3 direction) {
    return normalize(float3(dot(skin_axis_x, direction), dot(skin_axis_y, direction), dot(skin_axis_z, direction)));
}
float3 SkinWorldToMesh(float3 direction) {
    return normalize(skin_axis_x * direction.x + skin_axis_y * direction.y + skin_axis_z * direction.z);
}

#include "SkinHeadShadow.hlsl"

struct SkinHeadAttributes {
    float4 positionOS : POSITION;
    float3 normalOS : NORMAL;
    float4 tangentOS : TANGENT;
    float2 uv : TEXCOORD0;
    float2 atlas : TEXCOORD1;
    float2 bends : TEXCOORD2;
    float2 bendAndRed : TEXCOORD3;
    float2 greenAndBlue : TEXCOORD4;
    float2 occlusion : TEXCOORD5;
    float2 frameXy : TEXCOORD6;
    float2 frameZw : TEXCOORD7;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct SkinHeadVaryings {
    float4 positionCS : SV_POSITION;
    float4 uvAndAtlas : TEXCOORD0;
    float4 positionAndFog : TEXCOORD1;
    float4 normalAndOcclusion : TEXCOORD2;
    float3 bends : TEXCOORD3;      // numbers of the curvature tensor, in 1/mm
    float3 scattered : TEXCOORD4;  // occlusion, scattered by the profile
    float3 tangentWS : TEXCOORD5;
    float3 axisX : TEXCOORD6;  // of the world in the mesh's space
    float3 axisY : TEXCOORD7;
    float3 axisZ : TEXCOORD8;
    UNITY_VERTEX_OUTPUT_STEREO
};

// By the frame of the bakes and that of the pose, in a world whose x is mirrored back.
void SkinSetAxes(SkinHeadAttributes input, inout SkinHeadVaryings output) {
    const float3 kMirror = float3(-1.0, 1.0, 1.0);
    if (_Moves < 0.5) {
        output.axisX = TransformWorldToObjectDir(float3(1.0, 0.0, 0.0)) * kMirror;
        output.axisY = TransformWorldToObjectDir(float3(0.0, 1.0, 0.0)) * kMirror;
        output.axisZ = TransformWorldToObjectDir(float3(0.0, 0.0, 1.0)) * kMirror;
        return;
    }
    float4 frame = float4(input.frameXy.x, 1.0 - input.frameXy.y, input.frameZw.x, 1.0 - input.frameZw.y);
    float3 n = output.normalAndOcclusion.xyz * kMirror, along = output.tangentWS * kMirror;
    float3 t = normalize(along - n * dot(n, along)), b = cross(n, t);
    output.axisX = -skin_turned(frame, float3(t.x, b.x, n.x));
    output.axisY = skin_turned(frame, float3(t.y, b.y, n.y));
    output.axisZ = skin_turned(frame, float3(t.z, b.z, n.z));
}

SkinHeadVaryings SkinHeadVertex(SkinHeadAttributes input) {
    SkinHeadVaryings output = (SkinHeadVaryings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
    float3 positionWS = TransformObjectToWorld(input.positionOS.xyz);
    output.positionCS = TransformWorldToHClip(positionWS);
    output.uvAndAtlas = float4(input.uv * _BaseMap_ST.xy + _BaseMap_ST.zw, input.atlas);
    output.positionAndFog = float4(positionWS, ComputeFogFactor(output.positionCS.z));
    output.normalAndOcclusion = float4(TransformObjectToWorldNormal(input.normalOS), input.occlusion.x);
    output.tangentWS = TransformObjectToWorldDir(input.tangentOS.xyz);
    SkinSetAxes(input, output);
    output.bends = float3(input.bends.x, 1.0 - input.bends.y, input.bendAndRed.x);
    output.scattered = float3(1.0 - input.bendAndRed.y, input.greenAndBlue.x, 1.0 - input.greenAndBlue.y);
    return output;
}

struct SkinHeadSurface {
    float3 positionWS, n, v;  // world; n with the normal map
    float3 n_geometry;        // world
    float3 n_mesh, n_red, n_green, n_blue, diagonal, mixed;  // the mesh's space
    float3 band_1, band_2;    // factors on Lambert's bands of light from all around
    float2 uneven;
    float curvature_per_mm;
    float3 albedo, gain, gain_behind, far_share, scattered_occlusion;
    float occlusion, roughness, f0, past_far_wall;
};

float SkinLimited(float curvature_per_mm) { return min(_CurvatureGain * curvature_per_mm, kSkinMaxCurvaturePerMm); }

// The normal map's, in the world. The bitangent is on the side where v grows over the pixel: whichever sign a reader gives it.
float3 SkinMappedNormal(SkinHeadVaryings input, float3 n) {
    float3 mapped = SAMPLE_TEXTURE2D(_NormalMap, sampler_NormalMap, input.uvAndAtlas.xy).xyz * 2.0 - 1.0;
    float3 p_dx = ddx(input.positionAndFog.xyz), p_dy = ddy(input.positionAndFog.xyz);
    float2 uv_dx = ddx(input.uvAndAtlas.xy), uv_dy = ddy(input.uvAndAtlas.xy);
    float3 t = normalize(input.tangentWS - n * dot(n, input.tangentWS)), b = cross(n, t);
    float3 along_v = (p_dy * uv_dx.x - p_dx * uv_dy.x) * (uv_dx.x * uv_dy.y - uv_dx.y * uv_dy.x);
    if (dot(b, along_v) < 0.0) b = -b;
    if (_ObjectSpaceNormals > 0.5) return normalize(SkinMeshToWorld(lerp(SkinWorldToMesh(n), mapped, _BumpScale)));
    return normalize(_BumpScale * (mapped.x * t + mapped.y * b) + mapped.z * n);
}

void SkinReadBakedNormals(inout SkinHeadSurface s, float2 atlas, float3 own_mesh) {
    float level = skin_baked_level(ddx(atlas) * _NormalsRed_TexelSize.zw, ddy(atlas) * _NormalsRed_TexelSize.zw);
    float3 red = SAMPLE_TEXTURE2D_LOD(_NormalsRed, sampler_NormalsRed, atlas, level).rgb;
    float3 green = SAMPLE_TEXTURE2D_LOD(_NormalsGreen, sampler_NormalsRed, atlas, level).rgb;
    float3 spread = SAMPLE_TEXTURE2D_LOD(_NormalsSpread, sampler_NormalsRed, atlas, level).rgb;
    s.n_red = skin_mean_normal_red(red, spread, own_mesh);
    s.n_green = skin_mean_normal_green(red, green, spread, own_mesh);
    s.n_blue = skin_mean_normal_blue(red, green, spread, own_mesh);
    float3 lengths = float3(length(s.n_red), length(s.n_green), length(s.n_blue));
    s.n_red /= lengths.r;
    s.n_green /= lengths.g;
    s.n_blue /= lengths.b;
    float is_skin = skin_baked_skin(red);
    s.uneven = (spread.xy * 2.0 - 1.0) * is_skin;
    s.curvature_per_mm = lerp(s.curvature_per_mm, SkinLimited(skin_curvature_of_mean(lengths.r)), is_skin);
    s.band_1 = lengths;
    s.band_2 = skin_band_2_of_means(lengths);
}

void SkinReadMaterial(inout SkinHeadSurface s, SkinHeadVaryings input) {
    float3 surface = SAMPLE_TEXTURE2D(_SurfaceMap, sampler_SurfaceMap, input.uvAndAtlas.xy).rgb;
    float thickness_mm = SAMPLE_TEXTURE2D(_ThicknessMap, sampler_ThicknessMap, input.uvAndAtlas.zw).g * _ThicknessMaxMm;
    s.albedo = _BaseColor.rgb * SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uvAndAtlas.xy).rgb;
    s.roughness = max(_Roughness * surface.g, 0.03);
    s.f0 = _F0 * surface.b;
    s.occlusion = min(input.normalAndOcclusion.w, surface.r);
    s.scattered_occlusion = min(input.scattered, (float3)surface.r);
    s.gain = _CurvedGain > 0.5 ? skin_gain(_CurvatureGain * input.bends.x) : (float3)1.0;
    s.gain_behind = _CurvedGain > 0.5 ? skin_gain_through(s.gain, kSkinGainOfSlabs) : (float3)1.0;
    s.far_share = skin_far_share(thickness_mm);
    s.past_far_wall = skin_past_far_wall_mm(thickness_mm) / _MmPerUnit;
}

SkinHeadSurface SkinHeadSurfaceOf(SkinHeadVaryings input) {
    SkinHeadSurface s = (SkinHeadSurface)0;
    s.positionWS = input.positionAndFog.xyz;
    s.n_geometry = normalize(input.normalAndOcclusion.xyz);
    s.n = SkinMappedNormal(input, s.n_geometry);
    s.v = GetWorldSpaceNormalizeViewDir(s.positionWS);
    s.n_mesh = SkinWorldToMesh(s.n_geometry);
    float3 t = skin_vertex_tangent(s.n_mesh), b = cross(s.n_mesh, t), own_mesh = SkinWorldToMesh(s.n);
    s.diagonal = skin_tangent_diagonal(input.bends, t, b);
    s.mixed = skin_tangent_mixed(input.bends, t, b);
    s.curvature_per_mm = SkinLimited(skin_curvature_around(s.diagonal, s.mixed));
    s.n_red = s.n_green = s.n_blue = own_mesh;
    s.band_1 = skin_ambient_band_1(s.curvature_per_mm) * (1.5 / kSkinPi);
    s.band_2 = skin_ambient_band_2(s.curvature_per_mm) * (4.0 / kSkinPi);
    if (_BakedNormals > 0.5) SkinReadBakedNormals(s, input.uvAndAtlas.zw, own_mesh);
    SkinReadMaterial(s, input);
    return s;
}

float3 SkinFalloff(float n_dot_l, float curvature_per_mm) {
    float2 uv = skin_diffuse_coordinate(n_dot_l, curvature_per_mm, kSkinMaxCurvaturePerMm);
    return SAMPLE_TEXTURE2D_LOD(_SkinTable, sampler_SkinTable, uv, 0).rgb;
}

// In place of saturate(N.L).
float3 SkinEntered(SkinHeadSurface s, float3 to_light_world) {
    if (_Scattering < 0.5) return (float3)saturate(dot(s.n, to_light_world));
    float3 to_light = SkinWorldToMesh(to_light_world);
    float curvature = s.curvature_per_mm * sqrt(skin_spread_towards(s.n_red, s.uneven, to_light));
    if (_BakedNormals < 0.5) curvature = _CurvatureGain * skin_curvature_towards(s.diagonal, s.mixed, s.n_mesh, to_light);
    curvature = min(curvature, kSkinMaxCurvaturePerMm);
    return float3(SkinFalloff(dot(s.n_red, to_light), curvature).r, SkinFalloff(dot(s.n_green, to_light), curvature).g,
                  SkinFalloff(dot(s.n_blue, to_light), curvature).b);
}

// Reflected radiance of one light; entering: the part of it that enters around the point, visible: that arrives at the point itself,
// behind: on the far side of a thin part.
float3 SkinHeadLight(SkinHeadSurface s, Light light, float3 entering, float visible, float behind) {
    float3 diffuse = SkinEntered(s, light.direction) * entering, specular = (float3)0;
    if (_Scattering > 0.5) {
        diffuse *= s.gain * (1.0 - s.far_share);
        diffuse += s.gain_behind * s.far_share * (behind * saturate(-dot(s.n_geometry, light.direction)));
    }
    float n_dot_l = dot(s.n, light.direction);
    if (n_dot_l > 0.0) {
        float3 h = normalize(light.direction + s.v);
        float lobe = skin_ggx(saturate(dot(s.n, h)), n_dot_l, max(dot(s.n, s.v), 1e-3), s.roughness * s.roughness);
        // URP leaves out the 1 / pi of Lambert and of the lobe alike.
        specular = (float3)(kSkinPi * lobe * skin_fresnel_schlick(s.f0, saturate(dot(h, s.v))) * visible);
    }
    return (s.albedo * diffuse + specular) * light.color * light.distanceAttenuation;
}

float3 SkinHeadMainLight(SkinHeadSurface s) {
    Light light = GetMainLight(TransformWorldToShadowCoord(s.positionWS), s.positionWS, half4(1, 1, 1, 1));
    float3 far_position = s.positionWS + light.direction * s.past_far_wall;
    float behind = GetMainLight(TransformWorldToShadowCoord(far_position), far_position, half4(1, 1, 1, 1)).shadowAttenuation;
    float visible = light.shadowAttenuation;
    float3 entering = (float3)visible;
#if defined(SKIN_READS_SHADOW_MAP)
    float texel_mm = SkinShadowTexelMm(s.positionWS), strength = GetMainLightShadowParams().x * (1.0 - GetMainLightShadowFade(s.positionWS));
    visible = SkinPlainShadow(s.positionWS, s.n_geometry, light.direction, texel_mm);
    entering = (float3)visible;
    if (_Scattering > 0.5)
        entering = SkinGatheredShadow(s.positionWS, s.n_mesh, SkinWorldToMesh(light.direction), s.diagonal, s.mixed, visible, texel_mm,
                                      s.gain);
    visible = lerp(1.0, visible, strength);
    entering = lerp((float3)1.0, entering, strength);
#elif defined(_MAIN_LIGHT_SHADOWS_SCREEN)
    behind = 1.0;  // the screen has the shadow of the visible side alone
#endif
    return SkinHeadLight(s, light, entering, visible, behind);
}

float3 SkinHeadAdditionalLight(SkinHeadSurface s, uint index) {
    Light light = GetAdditionalLight(index, s.positionWS, half4(1, 1, 1, 1));
    Light behind = GetAdditionalLight(index, s.positionWS + light.direction * s.past_far_wall, half4(1, 1, 1, 1));
    return SkinHeadLight(s, light, (float3)light.shadowAttenuation, light.shadowAttenuation, behind.shadowAttenuation);
}

float3 SkinHeadLights(SkinHeadSurface s, SkinHeadVaryings input) {
    float3 radiance = SkinHeadMainLight(s);
#if defined(_ADDITIONAL_LIGHTS) || defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // What the macros of the light loop read.
    InputData inputData = (InputData)0;
    inputData.positionWS = s.positionWS;
    inputData.normalizedScreenSpaceUV = GetNormalizedScreenSpaceUV(input.positionCS);
    uint pixelLightCount = GetAdditionalLightsCount();
#if defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // Directional lights after the main one are not in the clusters.
    for (uint i = 0; i < min(URP_FP_DIRECTIONAL_LIGHTS_COUNT, MAX_VISIBLE_LIGHTS); ++i) radiance += SkinHeadAdditionalLight(s, i);
#endif
    LIGHT_LOOP_BEGIN(pixelLightCount)
        radiance += SkinHeadAdditionalLight(s, lightIndex);
    LIGHT_LOOP_END
#endif
    return radiance;
}

// Irradiance of the ambient probe over pi, as SampleSH(), with factors on its bands (Ramamoorthi, Hanrahan 2001).
float3 SkinProbe(float3 n, float3 band_1, float3 band_2) {
    float3 zz = float3(unity_SHBr.z, unity_SHBg.z, unity_SHBb.z) / 3.0;
    float3 mean = float3(unity_SHAr.w, unity_SHAg.w, unity_SHAb.w) + zz;
    float3 first = float3(dot(unity_SHAr.xyz, n), dot(unity_SHAg.xyz, n), dot(unity_SHAb.xyz, n));
    float4 products = n.xyzz * n.yzzx;
    float3 second = float3(dot(unity_SHBr, products), dot(unity_SHBg, products), dot(unity_SHBb, products)) - zz +
                    unity_SHC.rgb * (n.x * n.x - n.y * n.y);
    return max(mean + band_1 * first + band_2 * second, (float3)0.0);
}

float3 SkinHeadAmbient(SkinHeadSurface s) {
    if (_Scattering < 0.5) return SkinProbe(s.n, (float3)1.0, (float3)1.0) * s.occlusion;
    // Blue takes green's direction, which is nearly its own.
    float3 of_red = SkinProbe(SkinMeshToWorld(s.n_red), s.band_1, s.band_2);
    float3 of_green = SkinProbe(SkinMeshToWorld(s.n_green), s.band_1, s.band_2);
    return float3(of_red.r, of_green.gb) * s.scattered_occlusion * s.gain;
}

float4 SkinHeadFragment(SkinHeadVaryings input) : SV_Target {
    UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input);
    // Not assigned, or imported with a size limit: words instead of wrong light.
    if (any(_SkinTable_TexelSize.zw != kTableSize)) return float4((float3)skin_sign_of_missing_table(input.positionCS.xy), 1.0);
    skin_axis_x = input.axisX;
    skin_axis_y = input.axisY;
    skin_axis_z = input.axisZ;
    SkinHeadSurface s = SkinHeadSurfaceOf(input);
    float3 radiance = SkinHeadLights(s, input) + s.albedo * SkinHeadAmbient(s);
    return float4(MixFog(radiance, input.positionAndFog.w), 1.0);
}

#endif
