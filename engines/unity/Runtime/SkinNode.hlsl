// Custom Function nodes for Shader Graph, in URP and HDRP (source: this file). Cosines are of normalised directions that
// point away from the surface.
#ifndef DERMIS_SKIN_NODE
#define DERMIS_SKIN_NODE

#include "Skin.hlsl"

// Name SkinDiffuse. What a light's irradiance at normal incidence times albedo / pi is multiplied with, 0 to 1: in place of
// saturate(N.L). Curvature in 1/mm, 0 to 1.
void SkinDiffuse_float(float NdotL, float Curvature, out float3 Diffuse) {
    Diffuse = skin_diffuse(NdotL, Curvature);
}

// Name SkinCurvature. In 1/mm, of the mesh. MmPerUnit is 1000 where a unit is a metre.
void SkinCurvature_float(float3 Normal, float3 Position, float MmPerUnit, out float Curvature) {
    Curvature = saturate(skin_curvature_from_derivatives(fwidth(Normal), fwidth(Position) * MmPerUnit));
}

// Name SkinGain. What all diffuse light is multiplied with: more than 1 on convex skin, less in folds. As SkinCurvature.
void SkinGain_float(float3 Normal, float3 Position, float MmPerUnit, out float3 Gain) {
    Position *= MmPerUnit;
    Gain = skin_gain(skin_mean_curvature_from_derivatives(ddx(Position), ddy(Position), ddx(Normal), ddy(Normal)));
}

// Name SkinTransmittance. Thickness in mm.
void SkinTransmittance_float(float Thickness, out float3 Transmittance) {
    Transmittance = skin_transmittance(Thickness);
}

// Name SkinThin. Diffuse light of a thin part, with its gain: Diffuse of SkinDiffuse times the light's visibility here, Gain of SkinGain,
// Behind the light's visibility on the far side. Thickness in mm.
void SkinThin_float(float3 Diffuse, float3 Gain, float Behind, float NdotL, float Thickness, out float3 Thin) {
    Thin = skin_thin_light(Diffuse, (float3)(Behind * saturate(-NdotL)), skin_far_share(Thickness), Gain, kSkinGainOfSlabs);
}

#endif
