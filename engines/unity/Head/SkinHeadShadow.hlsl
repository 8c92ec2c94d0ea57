// Shadow of the main light: its map read at places around the point, each weighted by the profile. The map is URP's own; shadows in
// screen space have none that a material could read.
#ifndef DERMIS_SKIN_HEAD_SHADOW
#define DERMIS_SKIN_HEAD_SHADOW

#if (defined(_MAIN_LIGHT_SHADOWS) || defined(_MAIN_LIGHT_SHADOWS_CASCADE)) && !defined(_MAIN_LIGHT_SHADOWS_SCREEN)
#define SKIN_READS_SHADOW_MAP

static const int kDiskPlaces = @shadow_taps@, kGatherPlaces = @shadow_place_count@, kFirstPlaces = @first_shadow_places@;
// Along two tangents and off the surface, in mm; w: weight of the penumbra alone.
static const float4 kGatherOffsets[kGatherPlaces] = {
    @shadow_place_offsets@
};
// Of red, green and blue.
static const float3 kGatherWeights[kGatherPlaces] = {
    @shadow_place_weights@
};

// 0 or 1, filtered over four texels.
float SkinSeenAt(float3 positionWS) {
    float4 place = TransformWorldToShadowCoord(positionWS);
    float seen = SAMPLE_TEXTURE2D_SHADOW(_MainLightShadowmapTexture, sampler_LinearClampCompare, place.xyz);
    return BEYOND_SHADOW_FAR(place) ? 1.0 : seen;
}

float SkinShadowTexelMm(float3 positionWS) {
#if defined(_MAIN_LIGHT_SHADOWS_CASCADE)
    int cascade = (int)ComputeCascadeIndex(positionWS);
#else
    int cascade = 0;
#endif
    return _MainLightShadowmapSize.x / length(_MainLightWorldToShadow[cascade][0].xyz) * _MmPerUnit;
}

// The edge of a shadow, _PenumbraMm wide; of what does not scatter.
float SkinPlainShadow(float3 positionWS, float3 n_world, float3 to_light_world, float texel_mm) {
    float seen = 0.0;
    [loop] for (int i = 0; i < kDiskPlaces; ++i)
        seen += SkinSeenAt(positionWS + skin_disk_offset_mm(float(i), float(kDiskPlaces), n_world, to_light_world,
                                                            0.5 * _PenumbraMm, texel_mm) / _MmPerUnit);
    return seen / float(kDiskPlaces);
}

// n, to_light and the tensor are in the mesh's space; visible is SkinPlainShadow(). For light that is multiplied by gain later.
float3 SkinGatheredShadow(float3 positionWS, float3 n, float3 to_light, float3 diagonal, float3 mixed, float visible, float texel_mm,
                          float3 gain) {
    float3 across = normalize(cross(abs(n.y) < 0.9 ? float3(0.0, 1.0, 0.0) : float3(1.0, 0.0, 0.0), n));
    float3 x = skin_gather_tangent(n, to_light, across), y = cross(n, x), bends = skin_gather_bends(diagonal, mixed, x, y);
    float cosine = dot(n, to_light), sine = length(to_light - n * cosine);
    float3 x_world = SkinMeshToWorld(x) / _MmPerUnit, y_world = SkinMeshToWorld(y) / _MmPerUnit, n_world = SkinMeshToWorld(n) / _MmPerUnit;
    float3 origin = positionWS + n_world * skin_gather_lift_mm(texel_mm);
    float3 lit = (float3)0, whole = (float3)0;
    float2 red = (float2)0;  // lit and whole of the places that are trusted
    float penumbra = 0.0;
    [loop] for (int i = 0; i < kGatherPlaces; ++i) {
        // Red reaches farthest: its weight is never 0.
        if (i == kFirstPlaces && lit.r == visible * whole.r) return (float3)visible;
        float4 place = kGatherOffsets[i];
        float faces = skin_gather_cosine(place.xy, bends, cosine, sine);
        float seen = SkinSeenAt(origin + x_world * place.x + y_world * place.y + n_world * skin_gather_rise_mm(place.xy, place.z, bends));
        whole += kGatherWeights[i] * faces;
        lit += kGatherWeights[i] * (faces * seen);
        red += skin_gather_trust(place.xy, bends) * faces * float2(seen, 1.0);
        penumbra += place.w * seen;
    }
    float3 gathered = skin_gathered_light(visible, lit, whole, penumbra, float(kGatherPlaces));
    float3 trusted = skin_gathered_trusted_light(visible, gathered, red, penumbra, float(kGatherPlaces));
    return skin_gathered_with_gain(visible, trusted, gathered, gain);
}

#endif
#endif
