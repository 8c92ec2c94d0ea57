// Shadow map, depth and normals.
#ifndef DERMIS_SKIN_DEPTH
#define DERMIS_SKIN_DEPTH

#include "SkinInput.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Shadows.hlsl"

// Set by URP for the light whose map is drawn.
float3 _LightDirection, _LightPosition;

struct SkinDepthAttributes {
    float4 positionOS : POSITION;
    float3 normalOS : NORMAL;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct SkinDepthVaryings {
    float4 positionCS : SV_POSITION;
    float3 normalWS : TEXCOORD0;
    UNITY_VERTEX_OUTPUT_STEREO
};

SkinDepthVaryings SkinDepthVertex(SkinDepthAttributes input) {
    SkinDepthVaryings output = (SkinDepthVaryings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
    output.positionCS = TransformWorldToHClip(TransformObjectToWorld(input.positionOS.xyz));
    output.normalWS = TransformObjectToWorldNormal(input.normalOS);
    return output;
}

SkinDepthVaryings SkinShadowVertex(SkinDepthAttributes input) {
    SkinDepthVaryings output = (SkinDepthVaryings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    float3 positionWS = TransformObjectToWorld(input.positionOS.xyz);
    output.normalWS = TransformObjectToWorldNormal(input.normalOS);
#if defined(_CASTING_PUNCTUAL_LIGHT_SHADOW)
    float3 direction = normalize(_LightPosition - positionWS);
#else
    float3 direction = _LightDirection;
#endif
    output.positionCS = TransformWorldToHClip(ApplyShadowBias(positionWS, output.normalWS, direction));
    // In front of the near plane, casters are clamped to it.
#if UNITY_REVERSED_Z
    output.positionCS.z = min(output.positionCS.z, UNITY_NEAR_CLIP_VALUE);
#else
    output.positionCS.z = max(output.positionCS.z, UNITY_NEAR_CLIP_VALUE);
#endif
    return output;
}

float4 SkinDepthFragment(SkinDepthVaryings input) : SV_Target {
    return input.positionCS.z;
}

float4 SkinNormalsFragment(SkinDepthVaryings input) : SV_Target {
    return float4(normalize(input.normalWS), 0.0);
}

#endif
