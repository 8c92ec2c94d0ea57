// What the package's shaders take from URP's Lighting.hlsl, as declarations with the same types: for a compiler alone.
#ifndef STUB_LIGHTING
#define STUB_LIGHTING
#include "Core.hlsl"
#define URP_FP_DIRECTIONAL_LIGHTS_COUNT 2u
#define MAX_VISIBLE_LIGHTS 256u
#define LIGHT_LOOP_BEGIN(count) for (uint lightIndex = 0u; lightIndex < count + (uint)(0.0 * inputData.positionWS.x); ++lightIndex) {
#define LIGHT_LOOP_END }
struct Light { half3 direction; half3 color; float distanceAttenuation; half shadowAttenuation; uint layerMask; };
struct InputData { float3 positionWS; float2 normalizedScreenSpaceUV; };
Light stub_light() {
    Light light;
    light.direction = half3(0, 0, 1);
    light.color = (half3)1;
    light.distanceAttenuation = 1;
    light.shadowAttenuation = 1;
    light.layerMask = 1u;
    return light;
}
float4 TransformWorldToShadowCoord(float3 p) { return float4(p, 1.0); }
Light GetMainLight(float4 shadowCoord, float3 positionWS, half4 shadowMask) { return stub_light(); }
Light GetAdditionalLight(uint i, float3 positionWS, half4 shadowMask) { return stub_light(); }
uint GetAdditionalLightsCount() { return 3u; }
half3 SampleSH(half3 n) { return n; }
#endif
