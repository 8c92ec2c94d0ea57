// Shadow edges from the visibility at places around the point, weighted by the profile. The light that
// leaves is the sum of w V E over the places: w is the profile, V the visible part of the light, E the
// light that would enter. The functions of the curvature and the baked normals hold the sum of w E, so
// this is V averaged with the weights w E. The places lie on the quadric of the curvature tensor, and E
// is N.L of the quadric's normal.
//
// The quadric is not the mesh. The places are lifted off it, the farther ones by more, so that bumps do
// not shade themselves. The lift moves the edge of a shadow. Therefore only the difference between this
// average and the same average over the penumbra alone is added to the visibility at the point. Red, which
// reaches farthest, has sums of its own, in which places count less the more the quadric has turned there.
//
// The light that the gain (gain.glsl) adds or takes enters farther away than the profile's, beyond the places.
// Its visibility is extrapolated from that at the point and the average over the places.
#ifndef DERMIS_SKIN_GATHERED_SHADOW_GLSL
#define DERMIS_SKIN_GATHERED_SHADOW_GLSL

#include "shaders/include/skin/curvature.glsl"

// Tuned for the captured share on the head scan and the bust; half or twice as much loses .01 to .05.
const float kGatherLiftTexels = 2.25, kGatherLiftMm = 0.45;
// Where the quadric gets less than this part of the light of a facing surface, a few lit places would
// decide, so the difference counts in proportion. Half as much loses up to .01 of the share.
const float kGatherFaint = 0.3;
// A place counts 1 - kGatherTurn s^2 in red, where s is the slope of the quadric there: 0 from 35 degrees on.
// Without it red's share of the surface integral on heads is lower by .01 (light skin) to .12.
const float kGatherTurn = 2.0;
// Red has at least this share of green's light. At .8 lids still turn green; .9 shows at a straight shadow on
// flat skin.
const float kGatherRedOfGreen = 0.87;
// How far the visibility of the gain's light is extrapolated, as a multiple of the step from the visibility
// at the point to the average over the profile. The share of random walks on heads is highest from 3 to 6.
const float kGatherGain = 4.0;

// How far the point is lifted along the normal before the places are looked up; map_texel_mm is of the
// shadow map.
float gather_lift_mm(float map_texel_mm) { return max(kGatherLiftTexels * map_texel_mm, kGatherLiftMm); }

// The tangent towards the light; across is any tangent, for light along the normal. The other one is
// cross(n, tangent).
vec3 gather_tangent(vec3 n, vec3 to_light, vec3 across) {
    vec3 along = to_light - dot(n, to_light) * n;
    float sine = length(along);
    return sine > 1e-3 ? along / sine : across;
}

// The curvature tensor in the frame of two tangents, in 1/mm: x.S x, y.S y, x.S y. Its diagonal and
// mixed elements are those of the functions of curvature.
vec3 gather_bends(vec3 diagonal_per_mm, vec3 mixed_per_mm, vec3 x, vec3 y) {
    vec3 of_x = tensor_times(diagonal_per_mm, mixed_per_mm, x), of_y = tensor_times(diagonal_per_mm, mixed_per_mm, y);
    return vec3(dot(of_x, x), dot(of_y, y), dot(of_x, y));
}

// N.L of the quadric at a place: x and y on the tangents, in mm. cosine and sine are of the angle
// between normal and light.
float gather_cosine(vec2 place_mm, vec3 bends_per_mm, float cosine, float sine) {
    return max(cosine + sine * (bends_per_mm.x * place_mm.x + bends_per_mm.z * place_mm.y), 0.0);
}

// 1 at the point, 0 where the quadric has turned too far to be the mesh.
float gather_trust(vec2 place_mm, vec3 bends_per_mm) {
    vec2 turn = vec2(bends_per_mm.x * place_mm.x + bends_per_mm.z * place_mm.y,
                     bends_per_mm.z * place_mm.x + bends_per_mm.y * place_mm.y);
    return max(1.0 - kGatherTurn * dot(turn, turn), 0.0);
}

// How far the place is along the normal, in mm; lift_mm is the place's own.
float gather_rise_mm(vec2 place_mm, float lift_mm, vec3 bends_per_mm) {
    vec2 bend = vec2(bends_per_mm.x * place_mm.x + bends_per_mm.z * place_mm.y,
                     bends_per_mm.z * place_mm.x + bends_per_mm.y * place_mm.y);
    return lift_mm - 0.5 * dot(place_mm, bend);
}

// In place of the visibility of the light, a channel. Sums over `count` places: lit is that of weight
// times cosine times visibility, all that of weight times cosine, penumbra that of the penumbra's
// weight times visibility.
vec3 gathered_light(float visibility, vec3 lit, vec3 all, float penumbra, float count) {
    float known = min(all.x / (kGatherFaint * count), 1.0);
    return clamp(visibility + known * (lit / max(all, vec3(1e-5)) - penumbra / count), 0.0, 1.0);
}

// gathered, with red from its own sums. gathered: gathered_light() over all places. red_sums: x is the sum of
// gather_trust() times cosine times visibility, y the sum of gather_trust() times cosine. Where few places
// are trusted red follows green: else shadows and lids in thin light turn green.
vec3 gathered_trusted_light(float visibility, vec3 gathered, vec2 red_sums, float penumbra, float count) {
    vec3 trusted = gathered_light(visibility, vec3(red_sums.x), vec3(red_sums.y), penumbra, count);
    return vec3(max(trusted.x, kGatherRedOfGreen * gathered.y), gathered.y, gathered.z);
}

// The visibility of the light that the gain adds or takes. gathered: gathered_light() over all places.
vec3 gathered_gain_light(float visibility, vec3 gathered) {
    return clamp(gathered + kGatherGain * (gathered - visibility), 0.0, 1.0);
}

// One visibility for light that is multiplied by the gain of the place later. trusted:
// gathered_trusted_light(); gathered: over all places.
vec3 gathered_with_gain(float visibility, vec3 trusted, vec3 gathered, vec3 gain_of_place) {
    vec3 entering = trusted + (gain_of_place - 1.0) * gathered_gain_light(visibility, gathered);
    return max(entering, vec3(0.0)) / max(gain_of_place, vec3(1e-3));
}

#endif
