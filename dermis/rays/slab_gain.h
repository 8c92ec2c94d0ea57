#pragma once
// The gain of light that passes a thin part, as an ear or a wing of the nose.
//
// Techniques take that light from the profile: t / (1 + t) of the base colour, t = slab_transmittance(),
// since both sides together return 1. Walks through a slab bring 1.25 to 1.75 / albedo times as much. The
// ratio hardly depends on the thickness up to the mean radius, so one number a channel holds it.

#include "dermis/optics/profile.h"

namespace dermis::inline rays {

/// Light that leaves a slab of `thickness_mm` lit from behind, over irradiance and base colour: by the
/// profile, and by `walks` random walks through walk_medium_of(profile). Deterministic. A channel without
/// albedo passes 0.
[[nodiscard]] double slab_passes(const Profile& profile, int channel, double thickness_mm);
[[nodiscard]] double walked_slab_passes(const Profile& profile, int channel, double thickness_mm, int walks,
                                        uint32_t seed);

/// The walks' light over the profile's, of slabs of a quarter to two mean radii together; cached. A slab of a
/// quarter to one mean radius differs by 20 % at most, of two by 45 % (tested). Half a second of processor
/// time.
[[nodiscard]] Rgb walked_slab_gain(const Profile& profile);

}  // namespace dermis::inline rays
