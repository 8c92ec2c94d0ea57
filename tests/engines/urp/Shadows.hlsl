// What the package's shaders take from URP's Shadows.hlsl: one map, without cascades. Core.hlsl says what for.
#ifndef STUB_SHADOWS
#define STUB_SHADOWS
#include "Core.hlsl"
Texture2D _MainLightShadowmapTexture;
SamplerComparisonState shadow_compare;
#define sampler_LinearClampCompare shadow_compare
// Rows of the matrix into the map, 0 to 1; the map's size; bias along the light and along the normal.
cbuffer StubShadow { float4 stub_shadow_0, stub_shadow_1, stub_shadow_2, _MainLightShadowmapSize, stub_shadow_bias; }
static float4x4 _MainLightWorldToShadow[1] = {
    float4x4(stub_shadow_0, stub_shadow_1, stub_shadow_2, float4(0.0, 0.0, 0.0, 1.0))
};
#define BEYOND_SHADOW_FAR(place) (place.z <= 0.0 || place.z >= 1.0)
half ComputeCascadeIndex(float3 p) { return 0.0; }
float4 TransformWorldToShadowCoord(float3 p) {
    float4 h = float4(p, 1.0);
    return float4(dot(stub_shadow_0, h), dot(stub_shadow_1, h), dot(stub_shadow_2, h), 0.0);
}
half4 GetMainLightShadowParams() { return half4(1, 0, 0, 0); }
half GetMainLightShadowFade(float3 p) { return 0.0; }
float3 ApplyShadowBias(float3 p, float3 n, float3 l) {
    return p + l * stub_shadow_bias.x + n * ((1.0 - saturate(dot(l, n))) * stub_shadow_bias.y);
}
#endif
