#pragma once
// Eyes whose outer surface covers the iris: the file has no alpha that would make the cornea clear.

#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Cuts the cornea out of opaque eye materials without a colour map, as an alpha map over their UVs, and adds
/// to the reason of their parts. A cornea is where the surface bulges out of its sphere; it must lie around a
/// material that names an iris or a pupil. Leaves materials with overlapping or no UVs as they are.
void cut_out_corneas(Mesh& mesh, std::vector<FoundPart>& parts);

}  // namespace dermis::inline scene
