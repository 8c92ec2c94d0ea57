#pragma once
// Light over a ball lit by one distant light, by random walks: what pre-integration computes from a profile.

#include <vector>

#include "dermis/optics/medium.h"

namespace dermis::inline rays {

/// Where walks that start at one point of a ball end: their share of the light in classes of the angle at the
/// ball's centre, over what flat skin of the same medium returns. The shares add up to the gain of the ball.
struct BallExitance {
    double curvature_per_mm = 0;
    std::vector<Rgb> share;  ///< class i of n is around the angle ball_angle_rad(i, n)
};

[[nodiscard]] double ball_angle_rad(size_t i, size_t count);

/// One for each curvature (above 0). Cached. About 2 million walks a second per core.
[[nodiscard]] std::vector<BallExitance> walk_balls(const ScatteringMedium& medium,
                                                   const std::vector<double>& curvatures_per_mm, int walks);

/// Exitance over irradiance at normal incidence at a place of this N.L, -1..1: the clamped cosine, averaged
/// over the circles of the classes.
[[nodiscard]] Rgb light_on_ball(const BallExitance& ball, double n_dot_l);

}  // namespace dermis::inline rays
