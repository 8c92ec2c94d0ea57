#pragma once
// Whether the skin's UVs can hold a light map, and the consequences where they cannot.

#include <optional>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

/// Warnings, one line each, naming materials: UVs that are missing or overlap, so that the atlas has others
/// (scene/skin_atlas.h). Without such an atlas: UVs in other UDIM tiles or outside 0..1 (lit without
/// scattering), UVs that overlap by more than 0.1 % (places that share texels share light). Error: skin
/// without UVs and without an atlas. Cost: 20 ms for 20,000 triangles.
[[nodiscard]] Result<std::vector<std::string>> check_skin_atlas(const Scene& scene);

/// Why maps over the skin's atlas cannot be used, and the fix; empty if each place but 1 % has its own
/// texels. UVs in other tiles are allowed: they have no texels, which a shader sees.
[[nodiscard]] std::string unfit_for_baked_maps(const Scene& scene);

/// Some of the skin has UVs below 0 or above 1.
[[nodiscard]] bool has_skin_outside_atlas(const Scene& scene);

}  // namespace dermis::inline render
