// The material's values, the same in every pass, as the SRP Batcher wants them.
#ifndef DERMIS_SKIN_INPUT
#define DERMIS_SKIN_INPUT

#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"

CBUFFER_START(UnityPerMaterial)
    float4 _BaseMap_ST;
    float4 _BaseColor;
    float _BumpScale;
    float _Roughness;
    float _F0;
    float _MmPerUnit;
    float _CurvatureGain;
    float _ThicknessMaxMm;
    float4 _SkinTable_TexelSize;
CBUFFER_END

#endif
