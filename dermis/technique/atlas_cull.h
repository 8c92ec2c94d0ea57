#pragma once
// Which texels of a light map a frame needs, as passes (Gosselin, Sander, Mitchell 2004, "Acceleration
// Techniques"): a depth image over the atlas that is 0 where later passes must work and 1 elsewhere; those
// draw at depth 0 and test for EQUAL.
//
// The source keeps texels in view with v.n + 0.3 > 0, where 0.3 allows for the blur, and exempts the ears,
// where that fails. Here the kept area grows by the blur's whole reach, in tiles of 8 texels, so that every
// texel that can touch a visible one is kept. The reach of a blur in mm follows, per tile, from the steps of
// the metric in the tiles that it may reach.

#include "dermis/technique/technique.h"

namespace dermis::inline technique {

struct AtlasCullSettings {
    bool frustum = false, back_face = false;
    bool keep_thin = false;  ///< where the kernel-size map is above kThinKernel nothing faces away
    /// How far the passes that follow carry light, all together: texels, and steps of the atlas's metric
    /// (atlas_light.h), none of which is longer than longest_texels. Steps need the image "atlas_metric".
    float reach_texels = 0, reach_steps = 0, longest_texels = 0;
    int size = 1024;            ///< of the light map
    bool across_seams = false;  ///< what follows carries light over seams (needs PassList::seams)

    [[nodiscard]] bool any() const { return frustum || back_face; }
};

/// Appends images and passes that fill "atlas_depth"; nothing when nothing is to be culled.
void add_atlas_cull(PassList& list, const AtlasCullSettings& settings);

/// Makes a pass over the atlas work on kept texels only; targets it would overwrite whole are cleared first.
void keep_unculled(Pass& pass, const AtlasCullSettings& settings);

}  // namespace dermis::inline technique
