#pragma once
// The bust's triangles: how fine they are where.

#include "subjects/bust/field.h"
#include "subjects/bust/surface.h"

namespace dermis::bust {

/// Everything the bust lies in, with room.
inline constexpr Box kBustBox = {{-175, -235, -135}, {175, 150, 150}};

/// Wished edge length in mm at a point of the standard head: short at lids, lips, nose and ears.
[[nodiscard]] double wished_edge_mm(const Ear& ear, Point p_standard);

/// 5 to 7 s of processor time (bench/bust_bench.cpp).
[[nodiscard]] Surface make_head_surface(const BustField& field);

}  // namespace dermis::bust
