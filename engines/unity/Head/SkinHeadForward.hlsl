// The lit pass of a head: baked normals, curvature and occlusion of the vertices, scattered shadow edges of the main light, light
// through thin parts, scattered light of the ambient probe, reflections of the reflection probes.
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
TEXTURE2D(_CurvatureOfTargets);
TEXTURE2D(_TargetWeights);
TEXTURE2D(_ReflectedShares);
TEXTURE2D(_SkinTable);
SAMPLER(sampler_SkinTable);

#define SKIN_TABLE_IN
#define SKIN_TABLE
float3 SkinTable(float2 uv) { return SAMPLE_TEXTURE2D_LOD(_SkinTable, sampler_SkinTable, uv, 0).rgb; }

#include "SkinHeadLight.hlsl"
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

// What morph targets add to the mean curvature of a vertex. In the picture of their changes, a target has rows from the top, a vertex a
// texel: 127ths of _MostChangePerMm around 128. _TargetWeights: number of a target, its weight beyond that in which the head opens. Limited:
// in a fold, whose walls come close, the sum would be too much.
float SkinChangeByTargets(int vertex) {
    int wide = (int)_CurvatureOfTargets_TexelSize.z, top = (int)_CurvatureOfTargets_TexelSize.w - 1;
    float steps = 0.0;
    for (int i = 0; i < (int)_TargetCount; ++i) {
        float2 target = LOAD_TEXTURE2D(_TargetWeights, int2(i, 0)).xy;
        int row = (int)target.x * (int)_RowsOfTarget + vertex / wide;
        steps += target.y * (255.0 * LOAD_TEXTURE2D(_CurvatureOfTargets, int2(vertex % wide, top - row)).r - 128.0);
    }
    return clamp(steps / 127.0, -1.0, 1.0) * _MostChangePerMm;
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
    int vertex = (int)(1.5 - input.occlusion.y);
    output.bends = float3(input.bends.x + SkinChangeByTargets(vertex), 1.0 - input.bends.y, input.bendAndRed.x);
    output.scattered = float3(1.0 - input.bendAndRed.y, input.greenAndBlue.x, 1.0 - input.greenAndBlue.y);
    return output;
}

// The normal map's, in the world.
float3 SkinNormal(SkinHeadVaryings input, float3 n) {
    float3 mapped = SAMPLE_TEXTURE2D(_NormalMap, sampler_NormalMap, input.uvAndAtlas.xy).xyz * 2.0 - 1.0;
    if (_ObjectSpaceNormals > 0.5) return normalize(SkinMeshToWorld(lerp(SkinWorldToMesh(n), mapped, _BumpScale)));
    return SkinMappedNormal(n, input.tangentWS, mapped, _BumpScale, -1.0, ddx(input.positionAndFog.xyz), ddy(input.positionAndFog.xyz),
                            ddx(input.uvAndAtlas.xy), ddy(input.uvAndAtlas.xy));
}

void SkinReadBakedNormals(inout SkinHeadSurface s, float2 atlas) {
    float level = skin_baked_level(ddx(atlas) * _NormalsRed_TexelSize.zw, ddy(atlas) * _NormalsRed_TexelSize.zw);
    SkinSetBakedNormals(s, SAMPLE_TEXTURE2D_LOD(_NormalsRed, sampler_NormalsRed, atlas, level).rgb,
                        SAMPLE_TEXTURE2D_LOD(_NormalsGreen, sampler_NormalsRed, atlas, level).rgb,
                        SAMPLE_TEXTURE2D_LOD(_NormalsSpread, sampler_NormalsRed, atlas, level).rgb);
}

SkinHeadSurface SkinHeadSurfaceOf(SkinHeadVaryings input) {
    SkinHeadSurface s = (SkinHeadSurface)0;
    s.scattering = _Scattering;
    s.curvature_gain = _CurvatureGain;
    s.baked_normals = _BakedNormals;
    s.n_geometry = normalize(input.normalAndOcclusion.xyz);
    s.n = SkinNormal(input, s.n_geometry);
    s.v = GetWorldSpaceNormalizeViewDir(input.positionAndFog.xyz);
    SkinSetCurvature(s, input.bends);
    if (_BakedNormals > 0.5) SkinReadBakedNormals(s, input.uvAndAtlas.zw);
    float3 albedo = _BaseColor.rgb * SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uvAndAtlas.xy).rgb;
    float3 surface = SAMPLE_TEXTURE2D(_SurfaceMap, sampler_SurfaceMap, input.uvAndAtlas.xy).rgb;
    float thickness_mm = SAMPLE_TEXTURE2D(_ThicknessMap, sampler_ThicknessMap, input.uvAndAtlas.zw).g * _ThicknessMaxMm;
    SkinSetMaterial(s, albedo, surface, _Roughness, _F0, input.normalAndOcclusion.w, input.scattered, input.bends.x, _CurvedGain,
                    thickness_mm);
    return s;
}

// URP leaves out the 1 / pi of Lambert and of the lobe alike: its light is an irradiance over pi.
float3 SkinHeadUrpLight(SkinHeadSurface s, Light light, float3 entering, float visible, float behind) {
    return SkinHeadLight(s, light.direction, light.color * light.distanceAttenuation, entering, visible, behind);
}

float3 SkinHeadMainLight(SkinHeadSurface s, float3 positionWS) {
    Light light = GetMainLight(TransformWorldToShadowCoord(positionWS), positionWS, half4(1, 1, 1, 1));
    float3 far_position = positionWS + light.direction * (s.past_far_wall_mm / _MmPerUnit);
    float behind = GetMainLight(TransformWorldToShadowCoord(far_position), far_position, half4(1, 1, 1, 1)).shadowAttenuation;
    float visible = light.shadowAttenuation;
    float3 entering = (float3)visible;
#if defined(SKIN_READS_SHADOW_MAP)
    float texel_mm = SkinShadowTexelMm(positionWS), strength = GetMainLightShadowParams().x * (1.0 - GetMainLightShadowFade(positionWS));
    visible = SkinPlainShadow(positionWS, s.n_geometry, light.direction, _PenumbraMm, texel_mm);
    entering = (float3)visible;
    if (_Scattering > 0.5)
        entering = SkinGatheredShadow(positionWS, s.n_mesh, SkinWorldToMesh(light.direction), s.diagonal, s.mixed, visible, texel_mm,
                                      s.gain);
    visible = lerp(1.0, visible, strength);
    entering = lerp((float3)1.0, entering, strength);
#elif defined(_MAIN_LIGHT_SHADOWS_SCREEN)
    behind = 1.0;  // the screen has the shadow of the visible side alone
#endif
    return SkinHeadUrpLight(s, light, entering, visible, behind);
}

float3 SkinHeadAdditionalLight(SkinHeadSurface s, float3 positionWS, uint index) {
    Light light = GetAdditionalLight(index, positionWS, half4(1, 1, 1, 1));
    Light behind = GetAdditionalLight(index, positionWS + light.direction * (s.past_far_wall_mm / _MmPerUnit), half4(1, 1, 1, 1));
    return SkinHeadUrpLight(s, light, (float3)light.shadowAttenuation, light.shadowAttenuation, behind.shadowAttenuation);
}

float3 SkinHeadLights(SkinHeadSurface s, SkinHeadVaryings input) {
    float3 positionWS = input.positionAndFog.xyz, radiance = SkinHeadMainLight(s, positionWS);
#if defined(_ADDITIONAL_LIGHTS) || defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // What the macros of the light loop read.
    InputData inputData = (InputData)0;
    inputData.positionWS = positionWS;
    inputData.normalizedScreenSpaceUV = GetNormalizedScreenSpaceUV(input.positionCS);
    uint pixelLightCount = GetAdditionalLightsCount();
#if defined(_FORWARD_PLUS) || defined(_CLUSTER_LIGHT_LOOP)
    // Directional lights after the main one are not in the clusters.
    for (uint i = 0; i < min(URP_FP_DIRECTIONAL_LIGHTS_COUNT, MAX_VISIBLE_LIGHTS); ++i)
        radiance += SkinHeadAdditionalLight(s, positionWS, i);
#endif
    LIGHT_LOOP_BEGIN(pixelLightCount)
        radiance += SkinHeadAdditionalLight(s, positionWS, lightIndex);
    LIGHT_LOOP_END
#endif
    return radiance;
}

// The ambient probe, as SampleSH() has it.
float3 SkinHeadProbe(SkinHeadSurface s) {
    float3 terms[9];
    terms[6] = float3(unity_SHBr.z, unity_SHBg.z, unity_SHBb.z) / 3.0;
    terms[0] = float3(unity_SHAr.w, unity_SHAg.w, unity_SHAb.w) + terms[6];
    terms[1] = float3(unity_SHAr.y, unity_SHAg.y, unity_SHAb.y);
    terms[2] = float3(unity_SHAr.z, unity_SHAg.z, unity_SHAb.z);
    terms[3] = float3(unity_SHAr.x, unity_SHAg.x, unity_SHAb.x);
    terms[4] = float3(unity_SHBr.x, unity_SHBg.x, unity_SHBb.x);
    terms[5] = float3(unity_SHBr.y, unity_SHBg.y, unity_SHBb.y);
    terms[7] = float3(unity_SHBr.w, unity_SHBg.w, unity_SHBb.w);
    terms[8] = unity_SHC.rgb;
    return SkinHeadAmbient(s, terms);
}

// Of the reflection probes, or of the sky where there are none. Unity's pictures begin at the bottom.
float3 SkinHeadReflections(SkinHeadSurface s, SkinHeadVaryings input) {
    float2 at = SkinReflectedShareAt(s);
    float2 shares = SAMPLE_TEXTURE2D_LOD(_ReflectedShares, sampler_SkinTable, float2(at.x, 1.0 - at.y), 0).rg;
    float3 radiance = GlossyEnvironmentReflection(reflect(-s.v, s.n), input.positionAndFog.xyz, s.roughness, 1.0,
                                                  GetNormalizedScreenSpaceUV(input.positionCS));
    return SkinHeadReflection(s, shares, radiance);
}

float4 SkinHeadFragment(SkinHeadVaryings input) : SV_Target {
    UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input);
    // Not assigned, or imported with a size limit: words instead of wrong light.
    if (any(_SkinTable_TexelSize.zw != kTableSize)) return float4((float3)skin_sign_of_missing_table(input.positionCS.xy), 1.0);
    skin_axis_x = input.axisX;
    skin_axis_y = input.axisY;
    skin_axis_z = input.axisZ;
    SkinHeadSurface s = SkinHeadSurfaceOf(input);
    float3 radiance = SkinHeadLights(s, input) + SkinHeadProbe(s) + SkinHeadReflections(s, input);
    return float4(MixFog(radiance, input.positionAndFog.w), 1.0);
}

#endif
