// The values of a head's material, the same in every pass, as the SRP Batcher wants them; in place of SkinInput.hlsl.
#ifndef DERMIS_SKIN_INPUT
#define DERMIS_SKIN_INPUT

#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"

CBUFFER_START(UnityPerMaterial)
    float4 _BaseMap_ST;
    float4 _BaseColor;
    float _BumpScale;
    float _ObjectSpaceNormals;
    float _Roughness;
    float _F0;
    float _BakedNormals;
    float _ThicknessMaxMm;
    float _MmPerUnit;
    float _PenumbraMm;
    float _CurvatureGain;
    float _Scattering;
    float _CurvedGain;
    float _Moves;
    float _TargetCount;
    float _RowsOfTarget;
    float _MostChangePerMm;
    float4 _CurvatureOfTargets_TexelSize;
    float4 _NormalsRed_TexelSize;
    float4 _SkinTable_TexelSize;
CBUFFER_END

#endif
