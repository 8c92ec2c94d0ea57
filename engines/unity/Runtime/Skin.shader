// Skin for URP, pre-integrated: diffuse light over N.L and curvature from SkinTable.exr, two specular lobes, transmission
// through thin parts by a map of their thickness. Made by dermis
// @version@ for @profile@.
Shader "Dermis/Skin"
{
    Properties
    {
        [MainTexture] _BaseMap("Albedo", 2D) = "white" {}
        [MainColor] _BaseColor("Tint of the albedo", Color) = (0.72, 0.47, 0.36, 1)
        [Normal] _BumpMap("Normal map", 2D) = "bump" {}
        _BumpScale("Strength of the normal map", Range(0, 2)) = 1
        [NoScaleOffset] _SurfaceMap("Occlusion, roughness, factor on the reflectance: linear", 2D) = "white" {}
        _Roughness("Perceptual roughness", Range(0.1, 1)) = 0.45
        _F0("Reflectance at normal incidence", Range(0, 0.08)) = 0.028
        _MmPerUnit("Millimetres in a unit of the scene", Float) = 1000
        _CurvatureGain("Factor on the curvature", Range(0, 4)) = 1
        [Toggle(_SKIN_THIN)] _Thin("Transmission through thin parts", Float) = 0
        [NoScaleOffset] _ThicknessMap("Their thickness: green, linear", 2D) = "white" {}
        _ThicknessMaxMm("Thickness in mm of a map value of 1", Float) = 20
        [NoScaleOffset] _SkinTable("Skin table", 2D) = "black" {}
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" "RenderPipeline" = "UniversalPipeline" "Queue" = "Geometry" }
        Pass
        {
            // Forward only: URP draws it so with the Deferred path too.
            Name "ForwardLit"
            Tags { "LightMode" = "UniversalForwardOnly" }
            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex SkinVertex
            #pragma fragment SkinFragment
            #pragma multi_compile _ _MAIN_LIGHT_SHADOWS _MAIN_LIGHT_SHADOWS_CASCADE _MAIN_LIGHT_SHADOWS_SCREEN
            #pragma multi_compile _ _ADDITIONAL_LIGHTS
            #pragma multi_compile _ _FORWARD_PLUS _CLUSTER_LIGHT_LOOP
            #pragma multi_compile_fragment _ _ADDITIONAL_LIGHT_SHADOWS
            #pragma multi_compile_fragment _ _SHADOWS_SOFT
            #pragma shader_feature_local_fragment _SKIN_THIN
            #pragma multi_compile_fog
            #pragma multi_compile_instancing
            #include "SkinForward.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "ShadowCaster"
            Tags { "LightMode" = "ShadowCaster" }
            ColorMask 0
            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex SkinShadowVertex
            #pragma fragment SkinDepthFragment
            #pragma multi_compile_instancing
            #pragma multi_compile_vertex _ _CASTING_PUNCTUAL_LIGHT_SHADOW
            #include "SkinDepth.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "DepthOnly"
            Tags { "LightMode" = "DepthOnly" }
            ColorMask R
            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex SkinDepthVertex
            #pragma fragment SkinDepthFragment
            #pragma multi_compile_instancing
            #include "SkinDepth.hlsl"
            ENDHLSL
        }
        Pass
        {
            Name "DepthNormalsOnly"
            Tags { "LightMode" = "DepthNormalsOnly" }
            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex SkinDepthVertex
            #pragma fragment SkinNormalsFragment
            #pragma multi_compile_instancing
            #include "SkinDepth.hlsl"
            ENDHLSL
        }
    }
}
