#include "dermis/rays/ball_exitance.h"

#include <cmath>
#include <numbers>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/sphere_boundary.h"

namespace dermis::inline rays {
namespace {

constexpr size_t kClasses = 128;
constexpr float Vec3::*kChannelOf[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

// Angles grow as the square of the class: most walks of large balls end near their start.
double upper_angle_rad(size_t i, size_t count) {
    const double x = double(i) / double(count);
    return std::numbers::pi * x * x;
}

size_t class_of(double angle_rad) {
    return std::min(size_t(std::sqrt(angle_rad / std::numbers::pi) * double(kClasses)), kClasses - 1);
}

// The mean of max(0, n.l) on the circle at this angle around a place of this N.L.
double mean_cosine_on_circle(double angle_rad, double n_dot_l) {
    const double a = n_dot_l * std::cos(angle_rad);
    const double b = std::sqrt(std::max(1 - n_dot_l * n_dot_l, 0.0)) * std::sin(angle_rad);
    if (a >= b) return a;
    if (a <= -b) return 0;
    const double lit_rad = std::acos(-a / b);
    return (a * lit_rad + b * std::sin(lit_rad)) / std::numbers::pi;
}

constexpr Vec3 kUp = {0, 0, 1};  // outwards where walks start

// Plain: guides towards a plane do not help in a ball.
template <class Boundary>
std::vector<WalkEnd> walk_in(const Boundary& boundary, const ScatteringMedium& medium, int walks) {
    const WalkMedium prepared = walk_medium(medium);
    std::vector<WalkEnd> ends(static_cast<size_t>(walks));
    parallel_for(ends.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Pcg32 random(7, uint32_t(i));
            const Vec3 start = sample_entry_direction(kUp, prepared.eta, random);
            ends[i] = random_walk(prepared, boundary, {}, start, random);
        }
    });
    return ends;
}

// Of walks by the same random numbers as in the balls: most of their noise cancels in the quotient.
Rgb flat_returns(const ScatteringMedium& medium, int walks) {
    Rgb sum = {0, 0, 0};
    for (const WalkEnd& end : walk_in(PlaneBoundary{{}, kUp}, medium, walks))
        for (size_t c = 0; c < 3; ++c) sum[c] += end.throughput.*kChannelOf[c];
    return sum;
}

BallExitance ball_exitance(const ScatteringMedium& medium, double curvature_per_mm, int walks,
                           const Rgb& flat) {
    BallExitance ball{.curvature_per_mm = curvature_per_mm, .share = std::vector<Rgb>(kClasses)};
    for (Rgb& share : ball.share) share = {0, 0, 0};
    for (const WalkEnd& end : walk_in(SphereBoundary(curvature_per_mm), medium, walks)) {
        // The angle from the chord: an angle from a cosine would lose small ones to rounding.
        const double sine = std::min(0.5 * length(end.p_mm) * curvature_per_mm, 1.0);
        Rgb& share = ball.share[class_of(2 * std::asin(sine))];
        for (size_t c = 0; c < 3; ++c)
            if (flat[c] > 0) share[c] += end.throughput.*kChannelOf[c] / flat[c];
    }
    return ball;
}

}  // namespace

double ball_angle_rad(size_t i, size_t count) {
    return 0.5 * (upper_angle_rad(i, count) + upper_angle_rad(i + 1, count));
}

std::vector<BallExitance> walk_balls(const ScatteringMedium& medium,
                                     const std::vector<double>& curvatures_per_mm, int walks) {
    Hasher hasher;
    hasher.add(rays_version()).add(medium.g).add(medium.eta).add(walks);
    for (size_t c = 0; c < 3; ++c) hasher.add(medium.sigma_s_per_mm[c]).add(medium.sigma_a_per_mm[c]);
    for (const double curvature : curvatures_per_mm) hasher.add(curvature);
    std::vector<Rgb> shares(curvatures_per_mm.size() * kClasses);
    std::vector<BallExitance> balls;
    if (!cache_load("balls", hasher.hex(), std::tie(shares))) {
        shares.clear();
        const Rgb flat = flat_returns(medium, walks);
        for (const double curvature : curvatures_per_mm) {
            const BallExitance ball = ball_exitance(medium, curvature, walks, flat);
            shares.insert(shares.end(), ball.share.begin(), ball.share.end());
        }
        cache_store("balls", hasher.hex(), std::tie(shares));
    }
    for (size_t i = 0; i < curvatures_per_mm.size(); ++i)
        balls.push_back({curvatures_per_mm[i],
                         {shares.begin() + std::ptrdiff_t(i * kClasses),
                          shares.begin() + std::ptrdiff_t((i + 1) * kClasses)}});
    return balls;
}

Rgb light_on_ball(const BallExitance& ball, double n_dot_l) {
    Rgb light = {0, 0, 0};
    for (size_t i = 0; i < ball.share.size(); ++i) {
        const double cosine = mean_cosine_on_circle(ball_angle_rad(i, ball.share.size()), n_dot_l);
        for (size_t c = 0; c < 3; ++c) light[c] += ball.share[i][c] * cosine;
    }
    return light;
}

}  // namespace dermis::inline rays
