#pragma once
// The page's lookup tables. Internal to dermis/engines.

#include <nlohmann/json.hpp>

#include "dermis/engines/web.h"
#include "dermis/engines/web/binary.h"

namespace dermis::inline engines::web {

/// The diffuse tables of all tones as layers of one texture of shared exponents; their other
/// functions as rows of another, of halves. Sizes and offsets as JSON. `baked_curvature_per_mm`: where the
/// tones' diffuse tables end. Errors: a table that is not rgba32f.
[[nodiscard]] Result<nlohmann::json> add_tables(Binary& binary, std::span<const WebTone> tones,
                                                float baked_curvature_per_mm);

/// Prefiltered cube without its largest level, spherical harmonics, and the split sum's second factor.
[[nodiscard]] Result<nlohmann::json> add_environment(Binary& binary, const Environment& environment);

/// With no more digits than the float has.
[[nodiscard]] nlohmann::json to_json(float value);
[[nodiscard]] nlohmann::json to_json(Vec3 v);

}  // namespace dermis::inline engines::web
