// What the package's shaders take from URP's Core.hlsl, with the same names and types: for a compiler, and for unity_head, which draws
// with them. The object's space is the world's; a depth is 0 at the near plane.
#ifndef STUB_CORE
#define STUB_CORE
#define half float
#define half3 float3
#define half4 float4
// The name that the device looks for in a draw.
#define UnityPerMaterial Material
#define CBUFFER_START(name) cbuffer name {
#define CBUFFER_END }
// The device has its samplers by fixed names; the package's maps are all within 0 to 1.
SamplerState trilinear_clamp, linear_clamp;
#define TEXTURE2D(name) Texture2D name
#define SAMPLER(name)
#define SAMPLE_TEXTURE2D(t, s, uv) t.Sample(trilinear_clamp, uv)
#define SAMPLE_TEXTURE2D_LOD(t, s, uv, lod) t.SampleLevel(trilinear_clamp, uv, lod)
#define LOAD_TEXTURE2D(t, place) t.Load(int3(place, 0))
#define SAMPLE_TEXTURE2D_SHADOW(t, s, place) t.SampleCmpLevelZero(s, (place).xy, (place).z)
#define UNITY_VERTEX_INPUT_INSTANCE_ID
#define UNITY_VERTEX_OUTPUT_STEREO
#define UNITY_SETUP_INSTANCE_ID(input)
#define UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output)
#define UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input)
#define UNITY_NEAR_CLIP_VALUE 0.0
#define UNITY_REVERSED_Z 0
// Rows of the matrix into clip space, the eye, and the ambient probe as URP packs it.
cbuffer StubCamera {
    float4 stub_clip_0, stub_clip_1, stub_clip_2, stub_clip_3, stub_eye;
    float4 unity_SHAr, unity_SHAg, unity_SHAb, unity_SHBr, unity_SHBg, unity_SHBb, unity_SHC;
}
float3 TransformObjectToWorld(float3 p) { return p; }
float3 TransformObjectToWorldDir(float3 d) { return normalize(d); }
float3 TransformWorldToObjectDir(float3 d) { return normalize(d); }
float3 TransformObjectToWorldNormal(float3 n) { return normalize(n); }
float4 TransformWorldToHClip(float3 p) {
    float4 h = float4(p, 1.0);
    return float4(dot(stub_clip_0, h), dot(stub_clip_1, h), dot(stub_clip_2, h), dot(stub_clip_3, h));
}
float GetOddNegativeScale() { return 1.0; }
float3 GetWorldSpaceNormalizeViewDir(float3 p) { return normalize(stub_eye.xyz - p); }
float2 GetNormalizedScreenSpaceUV(float4 p) { return p.xy; }
float ComputeFogFactor(float z) { return 0.0; }
float3 MixFog(float3 c, float f) { return c; }
float3 UnpackNormalScale(float4 packed, float scale) { return float3((2.0 * packed.xy - 1.0) * scale, 1.0); }
#endif
