#pragma once
// Light from behind through skin of a known thickness: what a package has to draw, in double precision.

#include <string>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis {

inline constexpr float kBehindYawDeg = 160, kBehindPitchDeg = 20, kBehindIntensity = 3.14159265f;
[[nodiscard]] Vec3 to_light_behind();
inline constexpr float kThicknessMaxMm = 4;
/// The sheet is this thick at u: 1 mm. The board's edge is past it, so that the shadow ends in the picture.
inline constexpr float kSheetU = 0.25f, kBoardZMm = -20, kBoardEdgeMm = 7;

/// Grows from 0 to kThicknessMaxMm along u.
[[nodiscard]] Image thickness_ramp();
[[nodiscard]] float thickness_mm(float u);

/// Such a pixel does not say how much light it has.
[[nodiscard]] bool is_overexposed(const Image& picture, int x, int y);

/// The renderer's picture of the sphere, without transmission, with what the far side adds and what leaves
/// there taken.
[[nodiscard]] Image with_transmission(const Image& sphere, const std::string& profile);

/// The sheet where the board does not shade it.
[[nodiscard]] Vec3 sheet_color_srgb(const std::string& profile);
/// Where the board's shadow ends on the visible side.
[[nodiscard]] float shadow_edge_x_mm();

}  // namespace dermis
