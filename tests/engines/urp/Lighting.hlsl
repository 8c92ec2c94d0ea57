// What the package's shaders take from URP's Lighting.hlsl; the main light is a directional one. Core.hlsl says what for.
#ifndef STUB_LIGHTING
#define STUB_LIGHTING
#include "Core.hlsl"
#include "Shadows.hlsl"
#define URP_FP_DIRECTIONAL_LIGHTS_COUNT 2u
#define MAX_VISIBLE_LIGHTS 256u
#define LIGHT_LOOP_BEGIN(count) for (uint lightIndex = 0u; lightIndex < count + (uint)(0.0 * inputData.positionWS.x); ++lightIndex) {
#define LIGHT_LOOP_END }
struct Light { half3 direction; half3 color; float distanceAttenuation; half shadowAttenuation; uint layerMask; };
struct InputData { float3 positionWS; float2 normalizedScreenSpaceUV; };
cbuffer StubLight { float4 stub_light_direction, stub_light_color; }
Light GetMainLight(float4 shadowCoord, float3 positionWS, half4 shadowMask) {
    Light light;
    light.direction = stub_light_direction.xyz;
    light.color = stub_light_color.rgb;
    light.distanceAttenuation = 1.0;
    light.shadowAttenuation = 1.0;
#if defined(_MAIN_LIGHT_SHADOWS)
    if (!BEYOND_SHADOW_FAR(shadowCoord))
        light.shadowAttenuation = SAMPLE_TEXTURE2D_SHADOW(_MainLightShadowmapTexture, sampler_LinearClampCompare, shadowCoord.xyz);
#endif
    light.layerMask = 1u;
    return light;
}
Light GetAdditionalLight(uint i, float3 positionWS, half4 shadowMask) { return GetMainLight(float4(0, 0, 0, 0), positionWS, shadowMask); }
uint GetAdditionalLightsCount() { return 3u; }
// The sky's reflections; a level has a roughness, evenly from 0 to 1.
TextureCube unity_SpecCube0;
half3 GlossyEnvironmentReflection(half3 reflectVector, float3 positionWS, half perceptualRoughness, half occlusion,
                                  float2 normalizedScreenSpaceUV) {
    uint width, height, levels;
    unity_SpecCube0.GetDimensions(0, width, height, levels);
    return unity_SpecCube0.SampleLevel(trilinear_clamp, reflectVector, perceptualRoughness * float(levels - 1u)).rgb * occlusion;
}
half3 SampleSH(half3 n) { return float3(unity_SHAr.w, unity_SHAg.w, unity_SHAb.w); }
#endif
