// The edge of a shadow and light that scatters across it: a shadow map read at places around the point, each weighted by the profile. For
// Unity and Unreal, whose own files give before this one SkinHeadLight and
//
//     #define SKIN_SHADOW_IN and SKIN_SHADOW, parameters and arguments of SkinSeenAt() before the others, each with its comma
//     float SkinSeenAt(SKIN_SHADOW_IN float3 offset_mm): 0 or 1, filtered over four texels; the offset is from the point, in the world
#ifndef DERMIS_SKIN_HEAD_GATHER
#define DERMIS_SKIN_HEAD_GATHER

static const int kDiskPlaces = @shadow_taps@, kGatherPlaces = @shadow_place_count@, kFirstPlaces = @first_shadow_places@;
// Along two tangents and off the surface, in mm; w: weight of the penumbra alone.
static const float4 kGatherOffsets[kGatherPlaces] = {
    @shadow_place_offsets@
};
// Of red, green and blue.
static const float3 kGatherWeights[kGatherPlaces] = {
    @shadow_place_weights@
};

// The edge of a shadow, penumbra_mm wide; of what does not scatter.
float SkinPlainShadow(SKIN_SHADOW_IN float3 n_world, float3 to_light_world, float penumbra_mm, float texel_mm) {
    float seen = 0.0;
    [loop] for (int i = 0; i < kDiskPlaces; ++i)
        seen += SkinSeenAt(SKIN_SHADOW skin_disk_offset_mm(float(i), float(kDiskPlaces), n_world, to_light_world, 0.5 * penumbra_mm,
                                                           texel_mm));
    return seen / float(kDiskPlaces);
}

// n, to_light and the tensor are in the mesh's space; visible is SkinPlainShadow(). For light that is multiplied by gain later.
float3 SkinGatheredShadow(SKIN_SHADOW_IN float3 n, float3 to_light, float3 diagonal, float3 mixed, float visible, float texel_mm,
                          float3 gain) {
    float3 across = normalize(cross(abs(n.y) < 0.9 ? float3(0.0, 1.0, 0.0) : float3(1.0, 0.0, 0.0), n));
    float3 x = skin_gather_tangent(n, to_light, across), y = cross(n, x), bends = skin_gather_bends(diagonal, mixed, x, y);
    float cosine = dot(n, to_light), sine = length(to_light - n * cosine);
    float3 x_world = SkinMeshToWorld(x), y_world = SkinMeshToWorld(y), n_world = SkinMeshToWorld(n);
    float3 lift_mm = n_world * skin_gather_lift_mm(texel_mm);
    float3 lit = (float3)0, whole = (float3)0;
    float2 red = (float2)0;  // lit and whole of the places that are trusted
    float penumbra = 0.0;
    [loop] for (int i = 0; i < kGatherPlaces; ++i) {
        // Red reaches farthest: its weight is never 0.
        if (i == kFirstPlaces && lit.r == visible * whole.r) return (float3)visible;
        float4 place = kGatherOffsets[i];
        float faces = skin_gather_cosine(place.xy, bends, cosine, sine);
        float seen = SkinSeenAt(SKIN_SHADOW lift_mm + x_world * place.x + y_world * place.y +
                                              n_world * skin_gather_rise_mm(place.xy, place.z, bends));
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
