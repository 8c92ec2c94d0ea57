#pragma once
// Whether the skin's UVs can hold a light map, and the consequences where they cannot.

#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis {

/// Warnings, one line each, naming materials: UVs in other UDIM tiles or outside 0..1 (lit without
/// scattering), UVs that overlap by more than 0.1 % (places that share texels share light). Error: skin
/// without UVs. Cost: 20 ms for 20,000 triangles.
[[nodiscard]] Result<std::vector<std::string>> check_skin_atlas(const Scene& scene);

}  // namespace dermis
