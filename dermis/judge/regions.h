#pragma once
// Where a captured share is decided: parts of the skin that ask different things of a technique. Cut from the
// reference's own data, by rays through the middles of the pixels; a pixel may be in several or in none.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/judge/captured.h"
#include "dermis/scene/scene.h"

namespace dermis::inline judge {

/// N.L is of the key light and the shading normal.
enum class Region {
    relief,       ///< lit, N.L above kReliefCosine, no edge of a cast shadow near: normals and pores decide
    terminator,   ///< N.L within kReliefCosine of 0, no edge of a cast shadow near
    shadow_edge,  ///< within kNearMm of the edge of a cast shadow
    thin,         ///< less than kThinMm of skin behind the surface
    concave,      ///< curvature below kConcavePerMm, or hidden skin within kNearMm (folds, lips, lids)
    convex        ///< curvature above kConvexPerMm
};
inline constexpr std::array kRegions = {Region::relief, Region::terminator, Region::shadow_edge,
                                        Region::thin,   Region::concave,    Region::convex};

inline constexpr float kReliefCosine = 0.3f;
inline constexpr float kNearMm = 3;
inline constexpr float kThinMm = 6;
inline constexpr float kConcavePerMm = -0.05f;
inline constexpr float kConvexPerMm = 0.1f;

/// "relief", "terminator", "shadow_edge", "thin", "concave", "convex".
[[nodiscard]] std::string_view region_name(Region region);
/// One sentence, with its limits.
[[nodiscard]] std::string region_text(Region region);

/// One channel each, 1 inside; in the order of kRegions.
using RegionMasks = std::array<Image, kRegions.size()>;

/// `skin` is 1 where pixels count. The scene must be complete (complete_scene): curvature is the mesh's own.
/// Errors: as RayScene, MaterialSet and find_flesh.
[[nodiscard]] Result<RegionMasks> find_regions(const Scene& scene, const Image& skin);

/// Where they are: u8 sRGB, one colour a region, stripes where they overlap.
[[nodiscard]] Image region_picture(const RegionMasks& regions, const Image& skin);
[[nodiscard]] Vec3 region_color(Region region);

/// One row of regions.csv; nothing where the scene has no such pixel.
struct RegionShare {
    Region region;
    std::optional<Captured> captured;
};
[[nodiscard]] Result<std::vector<RegionShare>> captured_by_region(const Image& technique_effect,
                                                                  const EffectHalves& reference,
                                                                  const RegionMasks& regions);

}  // namespace dermis::inline judge
