// The lit pass: main light and additional lights with their shadows, ambient probes, fog.
#ifndef DERMIS_SKIN_FORWARD
#define DERMIS_SKIN_FORWARD

#include "SkinInput.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
#include "Skin.hlsl"

static const float kSkinMaxCurvaturePerMm = @max_curvature_per_mm@;
static const float2 kTableSize = float2(@table_width@, @table_height@);

TEXTURE2D(_BaseMap);
SAMPLER(sampler_BaseMap);
TEXTURE2D(_BumpMap);
SAMPLER(sampler_BumpMap);
TEXTURE2D(_SurfaceMap);
SAMPLER(sampler_SurfaceMap);
TEXTURE2D(_ThicknessMap);
SAMPLER(sampler_ThicknessMap);
TEXTURE2D(_SkinTable);
SAMPLER(sampler_SkinTable);

struct SkinAttributes {
    float4 positionOS : POSITION;
    float3 normalOS : NORMAL;
    float4 tangentOS : TANGENT;
    float2 uv : TEXCOORD0;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct SkinVaryings {
    float4 positionCS : SV_POSITION;
    float2 uv : TEXCOORD0;
    float3 positionWS : TEXCOORD1;
    float3 normalWS : TEXCOORD2;
    float4 tangentWS : TEXCOORD3;  // w: sign of the bitangent
    float fog : TEXCOORD4;
    UNITY_VERTEX_OUTPUT_STEREO
};

SkinVaryings SkinVertex(SkinAttributes input) {
    SkinVaryings output = (SkinVaryings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
    output.positionWS = TransformObjectToWorld(input.positionOS.xyz);
    output.positionCS = TransformWorldToHClip(output.positionWS);
    output.uv = input.uv * _BaseMap_ST.xy + _BaseMap_ST.zw;
    output.normalWS = TransformObjectToWorldNormal(input.normalOS);
    output.tangentWS = float4(TransformObjectToWorldDir(input.tangentOS.xyz),
                              input.tangentOS.w * GetOddNegativeScale());
    output.fog = ComputeFogFactor(output.positionCS.z);
    return output;
}

struct SkinSurface {
    float3 albedo, n, v;  // linear, with the gain of the place; world space, normalised
    float curvature_per_mm, roughness, f0;
#if defined(_SKIN_THIN)
    float3 n_geometry, far_share, albedo_through;
    float past_far_wall;  // towards a light, to where the shadow of what comes through is looked up, in units
#endif
};

// Reflected radiance of one light.
float3 SkinLight(SkinSurface s, Light light) {
    float3 irradiance = light.color * (light.distanceAttenuation * light.shadowAttenuation);
    float n_dot_l = dot(s.n, light.direction);
    float2 uv = skin_diffuse_coordinate(n_dot_l, s.curvature_per_mm, kSkinMaxCurvaturePerMm);
    // URP leaves out the 1 / pi of Lambert and of the lobes alike.
    float3 radiance = s.albedo * SAMPLE_TEXTURE2D_LOD(_SkinTable, sampler_SkinTable, uv, 0).rgb;
#if defined(_SKIN_THIN)
    radiance *= 1.0 - s.far_share;
#endif
    if (n_dot_l > 0.0) {
        float3 h = normalize(light.direction + s.v);
        float lobes = skin_two_lobe_ggx(saturate(dot(s.n, h)), n_dot_l, max(dot(s.n, s.v), 1e-3), s.roughness);
        radiance += kSkinPi * lobes * skin_fresnel_schlick(s.f0, saturate(dot(h, s.v)));
    }
    return radiance * irradiance;
}

#if defined(_SKIN_THIN)
// Radiance of what has entered the far side. The light is that past the far wall: at the surface itself the skin would shade its
// own back.
float3 SkinLightBehind(SkinSurface s, Light light) {
    float3 irradiance = light.color * (light.distanceAttenuation * light.shadowAttenuation);
    return s.albedo_through * s.far_share * saturate(-dot(s.n_geometry, light.direction)) * irradiance;
}

#endif

float3 SkinMainLight(SkinSurface s, float3 positionWS) {
    Light light = GetMainLight(TransformWorldToShadowCoord(positionWS), positionWS, half4(1, 1, 1, 1));
    float3 radiance = SkinLight(s, light);
#if defined(_SKIN_THIN)
    float3 far_position = positionWS + light.direction * s.past_far_wall;
    Light behind = GetMainLight(TransformWorldToShadowCoord(far_position), far_position, half4(1, 1, 1, 1));
#if defined(_MAIN_LIGHT_SHADOWS_SCREEN)
    behind.shadowAttenuation = 1.0;  // that of the screen is of the visible side alone
#endif
    radiance += SkinLightBehind(s, behind);
#endif
    return radiance;
}

float3 SkinAdditionalLight(SkinSurface s, uint index, float3 positionWS) {
    Light light = GetAdditionalLight(index, positionWS, half4(1, 1, 1, 1));
    float3 radiance = SkinLight(s, light);
#if defined(_SKIN_THIN)
    float3 far_position = positionWS + light.direction * s.past_far_wall;
    radiance += SkinLightBehind(s, GetAdditionalLight(index, far_position, half4(1, 1, 1, 1)));
#endif
    return radiance;
}

float3 SkinLights(SkinSurface s, SkinVaryings input) {
    float3 radiance = SkinMainLight(s, input.positionWS);
#if defined(_ADDITIONAL_LIGHTS) || defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // What the macros of the light loop read.
    InputData inputData = (InputData)0;
    inputData.positionWS = input.positionWS;
    inputData.normalizedScreenSpaceUV = GetNormalizedScreenSpaceUV(input.positionCS);
    uint pixelLightCount = GetAdditionalLightsCount();
#if defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // Directional lights after the main one are not in the clusters.
    for (uint i = 0; i < min(URP_FP_DIRECTIONAL_LIGHTS_COUNT, MAX_VISIBLE_LIGHTS); ++i)
        radiance += SkinAdditionalLight(s, i, input.positionWS);
#endif
    LIGHT_LOOP_BEGIN(pixelLightCount)
        radiance += SkinAdditionalLight(s, lightIndex, input.positionWS);
    LIGHT_LOOP_END
#endif
    return radiance;
}

float4 SkinFragment(SkinVaryings input) : SV_Target {
    UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input);
    // Not assigned, or imported with a size limit: words instead of wrong light.
    if (any(_SkinTable_TexelSize.zw != kTableSize)) return float4((float3)skin_sign_of_missing_table(input.positionCS.xy), 1.0);

    float3 n_geometry = normalize(input.normalWS);
    float3 bump = UnpackNormalScale(SAMPLE_TEXTURE2D(_BumpMap, sampler_BumpMap, input.uv), _BumpScale);
    float3 bitangent = input.tangentWS.w * cross(n_geometry, input.tangentWS.xyz);
    SkinSurface s;
    s.albedo = _BaseColor.rgb * SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uv).rgb;
    s.n = normalize(bump.x * input.tangentWS.xyz + bump.y * bitangent + bump.z * n_geometry);
    s.v = GetWorldSpaceNormalizeViewDir(input.positionWS);
    float3 surface = SAMPLE_TEXTURE2D(_SurfaceMap, sampler_SurfaceMap, input.uv).rgb;
    s.roughness = max(_Roughness * surface.g, 0.03);
    s.f0 = _F0 * surface.b;
    // Of the mesh: a bump of the map is smaller than what scatters.
    s.curvature_per_mm = min(_CurvatureGain * skin_curvature_from_derivatives(fwidth(n_geometry),
                                                                         fwidth(input.positionWS) * _MmPerUnit),
                             kSkinMaxCurvaturePerMm);
    float3 p_mm = input.positionWS * _MmPerUnit;
    float3 gain = skin_gain(_CurvatureGain *
                            skin_mean_curvature_from_derivatives(ddx(p_mm), ddy(p_mm), ddx(n_geometry), ddy(n_geometry)));
#if defined(_SKIN_THIN)
    float thickness_mm = SAMPLE_TEXTURE2D(_ThicknessMap, sampler_ThicknessMap, input.uv).g * _ThicknessMaxMm;
    s.n_geometry = n_geometry;
    s.far_share = skin_far_share(thickness_mm);
    s.albedo_through = s.albedo * skin_gain_through(gain, kSkinGainOfSlabs);
    s.past_far_wall = skin_past_far_wall_mm(thickness_mm) / _MmPerUnit;
#endif
    s.albedo *= gain;
    float3 radiance = SkinLights(s, input) + s.albedo * surface.r * SampleSH(s.n);
    return float4(MixFog(radiance, input.fog), 1.0);
}

#endif
