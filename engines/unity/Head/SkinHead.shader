// Skin of the head of `dermis export --engine unity SCENE`, for URP: as Dermis/Skin, with all that is baked for a head. Made by dermis
// @version@ for @profile@.
Shader "Dermis/Skin Head"
{
    Properties
    {
        [MainTexture] _BaseMap("Albedo", 2D) = "white" {}
        [MainColor] _BaseColor("Tint of the albedo", Color) = (1, 1, 1, 1)
        [NoScaleOffset] _NormalMap("Normal map: linear, not of Unity's type", 2D) = "bump" {}
        _BumpScale("Strength of the normal map", Range(0, 2)) = 1
        [ToggleUI] _ObjectSpaceNormals("The normal map is in the mesh's space", Float) = 0
        [NoScaleOffset] _SurfaceMap("Occlusion, roughness, factor on the reflectance: linear", 2D) = "white" {}
        _Roughness("Perceptual roughness", Range(0.03, 1)) = 1
        _F0("Reflectance at normal incidence", Range(0, 0.08)) = 0.028
        [ToggleUI] _BakedNormals("Baked normals", Float) = 0
        [NoScaleOffset] _NormalsRed("Baked normals: red", 2D) = "black" {}
        [NoScaleOffset] _NormalsGreen("Baked normals: green", 2D) = "black" {}
        [NoScaleOffset] _NormalsSpread("Baked normals: spread", 2D) = "black" {}
        [NoScaleOffset] _ThicknessMap("Thickness over the atlas: green, linear", 2D) = "white" {}
        _ThicknessMaxMm("Thickness in mm of a map value of 1", Float) = 1000
        _MmPerUnit("Millimetres in a unit of the scene", Float) = 1000
        _PenumbraMm("Width of a shadow's edge in mm", Float) = 1
        _CurvatureGain("Factor on the curvature", Range(0, 4)) = 1
        [ToggleUI] _Scattering("Scattering; off: Lambert", Float) = 1
        [ToggleUI] _CurvedGain("What curved skin returns beyond flat skin", Float) = 1
        [ToggleUI] _Moves("The mesh moves: it has the frames of its bakes", Float) = 0
        [NoScaleOffset] _CurvatureOfTargets("Changes of the curvature by morph targets: linear", 2D) = "black" {}
        [NoScaleOffset] _TargetWeights("Their weights: set by the script", 2D) = "black" {}
        _TargetCount("Targets that change the curvature now", Float) = 0
        _RowsOfTarget("Rows of a target", Float) = 1
        _MostChangePerMm("Largest change of the mean curvature in 1/mm", Float) = 0
        [NoScaleOffset] _ReflectedShares("What a lobe reflects of light from all around", 2D) = "black" {}
        [NoScaleOffset] _SkinTable("Skin table", 2D) = "black" {}
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" "RenderPipeline" = "UniversalPipeline" "Queue" = "Geometry" }
        Pass
        {
            Name "ForwardLit"
            Tags { "LightMode" = "UniversalForwardOnly" }
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex SkinHeadVertex
            #pragma fragment SkinHeadFragment
            #pragma multi_compile _ _MAIN_LIGHT_SHADOWS _MAIN_LIGHT_SHADOWS_CASCADE _MAIN_LIGHT_SHADOWS_SCREEN
            #pragma multi_compile _ _ADDITIONAL_LIGHTS
            #pragma multi_compile _ _FORWARD_PLUS _CLUSTER_LIGHT_LOOP
            #pragma multi_compile_fragment _ _ADDITIONAL_LIGHT_SHADOWS
            #pragma multi_compile_fragment _ _SHADOWS_SOFT
            #pragma multi_compile_fragment _ _REFLECTION_PROBE_BLENDING
            #pragma multi_compile_fragment _ _REFLECTION_PROBE_BOX_PROJECTION
            #pragma multi_compile_fragment _ _REFLECTION_PROBE_ATLAS
            #pragma multi_compile_fog
            #pragma multi_compile_instancing
            #include "SkinHeadForward.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "ShadowCaster"
            Tags { "LightMode" = "ShadowCaster" }
            ColorMask 0
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex SkinShadowVertex
            #pragma fragment SkinDepthFragment
            #pragma multi_compile_instancing
            #pragma multi_compile_vertex _ _CASTING_PUNCTUAL_LIGHT_SHADOW
            #include "SkinHeadInput.hlsl"
            #include "../Runtime/SkinDepth.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "DepthOnly"
            Tags { "LightMode" = "DepthOnly" }
            ColorMask R
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex SkinDepthVertex
            #pragma fragment SkinDepthFragment
            #pragma multi_compile_instancing
            #include "SkinHeadInput.hlsl"
            #include "../Runtime/SkinDepth.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "DepthNormalsOnly"
            Tags { "LightMode" = "DepthNormalsOnly" }
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex SkinDepthVertex
            #pragma fragment SkinNormalsFragment
            #pragma multi_compile_instancing
            #include "SkinHeadInput.hlsl"
            #include "../Runtime/SkinDepth.hlsl"
            ENDHLSL
        }
    }
}
