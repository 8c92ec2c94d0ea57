// What the package's shaders take from URP's Shadows.hlsl, as declarations with the same types: for a compiler alone.
#ifndef STUB_SHADOWS
#define STUB_SHADOWS
#include "Core.hlsl"
float3 ApplyShadowBias(float3 p, float3 n, float3 l) { return p + n - l; }
#endif
