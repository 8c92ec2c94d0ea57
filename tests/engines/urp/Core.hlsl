// What the package's shaders take from URP's Core.hlsl, as declarations with the same types: for a compiler alone.
#ifndef STUB_CORE
#define STUB_CORE
#define half float
#define half3 float3
#define half4 float4
#define CBUFFER_START(name) cbuffer name {
#define CBUFFER_END }
#define TEXTURE2D(name) Texture2D name
#define SAMPLER(name) SamplerState name
#define SAMPLE_TEXTURE2D(t, s, uv) t.Sample(s, uv)
#define SAMPLE_TEXTURE2D_LOD(t, s, uv, lod) t.SampleLevel(s, uv, lod)
#define UNITY_VERTEX_INPUT_INSTANCE_ID
#define UNITY_VERTEX_OUTPUT_STEREO
#define UNITY_SETUP_INSTANCE_ID(input)
#define UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output)
#define UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input)
#define UNITY_NEAR_CLIP_VALUE 1.0
#define UNITY_REVERSED_Z 1
cbuffer StubMatrices { float4x4 stub_world, stub_clip; }
float3 TransformObjectToWorld(float3 p) { return mul(stub_world, float4(p, 1.0)).xyz; }
float3 TransformObjectToWorldDir(float3 d) { return mul((float3x3)stub_world, d); }
float3 TransformObjectToWorldNormal(float3 n) { return mul((float3x3)stub_world, n); }
float4 TransformWorldToHClip(float3 p) { return mul(stub_clip, float4(p, 1.0)); }
float GetOddNegativeScale() { return 1.0; }
float3 GetWorldSpaceNormalizeViewDir(float3 p) { return normalize(-p); }
float2 GetNormalizedScreenSpaceUV(float4 p) { return p.xy; }
float ComputeFogFactor(float z) { return z; }
float3 MixFog(float3 c, float f) { return c * f; }
float3 UnpackNormalScale(float4 packed, float scale) { return float3((2.0 * packed.xy - 1.0) * scale, 1.0); }
#endif
