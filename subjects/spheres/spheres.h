#pragma once

namespace dermis {

/// Radii of the spheres, left to right.
inline constexpr float kSphereRadiiMm[4] = {2, 4, 8, 16};

}  // namespace dermis
