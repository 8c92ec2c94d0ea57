#pragma once
// The diffuse transport by simulation: light scattering in a homogeneous medium behind a smooth boundary.
//
// A path starts below the visible point and is followed back to where its light entered. One channel, chosen
// by throughput, draws the free path, weighted by the mean of all channels' densities (Wilkie, Nawaz, Droske,
// Weidlich, Hanika 2014, Hero Wavelength Spectral Sampling); Henyey and Greenstein draws the direction;
// Russian roulette ends weak paths. At the boundary a path is reflected with Fresnel's probability, else it
// ends.
//
// Entering light fills the refraction cone like diffuse light: the boundary is a smooth dielectric that also
// diffuses. With eta 1 nothing is reflected, and directions inside are Lambert's.

#include <algorithm>
#include <optional>
#include <span>

#include "dermis/optics/medium.h"
#include "dermis/rays/random.h"
#include "dermis/rays/sampling.h"

namespace dermis::inline rays {

/// Where a straight line inside the medium meets its boundary.
struct BoundaryHit {
    float distance_mm = 0;
    Vec3 n_out;           ///< unit, out of the medium
    bool mirror = false;  ///< the medium continues behind it in the same way: every path is reflected
};

/// A path's end. Nothing came back: absorbed, or lost through a hole of the mesh.
struct WalkEnd {
    Vec3 throughput;  ///< of each channel, from the end to the start
    Vec3 p_mm;        ///< on the boundary
    Vec3 direction;   ///< of the last flight
    int collisions = 0;
    bool lost = false;  ///< the line met no boundary, or met it from outside
};

/// The medium in the form the walk wants; sigma_t > 0 in every channel.
struct WalkMedium {
    Vec3 sigma_s_per_mm, sigma_t_per_mm;
    float g = 0;
    float eta = 1;
};
[[nodiscard]] WalkMedium walk_medium(const ScatteringMedium& medium);

/// Most collisions of one path: at albedo 1 roulette never ends one, and a path that long adds almost
/// nothing.
inline constexpr int kMostCollisions = 100'000;

/// The direction of diffuse light just inside: density proportional to (1 - F) cosine about the inward
/// normal.
[[nodiscard]] Vec3 sample_entry_direction(Vec3 n_out, float eta, Pcg32& random);

/// The chance of each channel to lead the next step: by what the path carries of it.
[[nodiscard]] Vec3 hero_chances(Vec3 throughput);
/// The free flight of one collision: scatter or leave.
struct Flight {
    float distance_mm;
    int hero;  ///< the channel it was drawn from
};
[[nodiscard]] Flight sample_flight(const WalkMedium& medium, Vec3 throughput, Pcg32& random);
/// Multiplies the throughput by what passes `distance_mm` over the density with which flights do.
[[nodiscard]] Vec3 pass_weight(const WalkMedium& medium, Vec3 throughput, float distance_mm);
/// The same for a collision there.
[[nodiscard]] Vec3 scatter_weight(const WalkMedium& medium, Vec3 throughput, float distance_mm);
/// False when the path ends; else the throughput is raised by what ending ones lose.
[[nodiscard]] bool survives_roulette(Vec3& throughput, Pcg32& random);
/// Where the boundary sends a path that arrives with `direction`: out (nothing), or back in, in this
/// direction.
[[nodiscard]] std::optional<Vec3> reflected_at(const BoundaryHit& hit, Vec3 direction, float eta,
                                               Pcg32& random);

/// Boundary: std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm); nothing
/// means that the flight of max_mm stays inside, or for an infinite one that the line never leaves.
template <class Boundary>
[[nodiscard]] WalkEnd random_walk(const WalkMedium& medium, Boundary&& boundary, Vec3 p_mm, Vec3 direction,
                                  Pcg32& random) {
    WalkEnd path{.throughput = {1, 1, 1}, .p_mm = p_mm, .direction = direction};
    const WalkEnd absorbed{};
    while (path.collisions < kMostCollisions) {
        const Flight flight = sample_flight(medium, path.throughput, random);
        const std::optional<BoundaryHit> hit = boundary(path.p_mm, path.direction, flight.distance_mm);
        if (!hit) {
            path.throughput = scatter_weight(medium, path.throughput, flight.distance_mm);
            path.p_mm += path.direction * flight.distance_mm;
            path.direction = sample_henyey_greenstein(random.next_2d(), path.direction, medium.g);
            ++path.collisions;
            if (!survives_roulette(path.throughput, random)) return absorbed;
            continue;
        }
        if (dot(hit->n_out, path.direction) <= 0) return {.lost = true};
        path.throughput = pass_weight(medium, path.throughput, hit->distance_mm);
        path.p_mm += path.direction * hit->distance_mm;
        const auto reflected = reflected_at(*hit, path.direction, medium.eta, random);
        if (!reflected) return path;
        path.direction = *reflected;
    }
    return absorbed;
}

/// The medium fills z < 0.
struct HalfSpace {
    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        if (direction.z <= 0) return std::nullopt;
        const float distance_mm = std::max(0.0f, -p_mm.z) / direction.z;
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, {0, 0, 1}};
    }
};

/// The medium lies behind the plane through p_mm with the outward unit normal n_out.
struct PlaneBoundary {
    Vec3 plane_mm, n_out;
    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        const float along = dot(direction, n_out);
        if (along <= 0) return std::nullopt;
        const float distance_mm = std::max(0.0f, dot(plane_mm - p_mm, n_out)) / along;
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, n_out};
    }
};

struct HalfSpaceAlbedo {
    Vec3 mean, standard_error;
};
[[nodiscard]] HalfSpaceAlbedo mean_of(std::span<const Vec3> values);
/// How much of the light that entered a half-space comes out again, red, green, blue, 0..1. `start`: the
/// direction just inside (z < 0), or none for diffuse light. Deterministic. Cost: 1 microsecond for each
/// collision of a walk.
[[nodiscard]] HalfSpaceAlbedo half_space_albedo(const ScatteringMedium& medium, std::optional<Vec3> start,
                                                int walks, uint32_t seed);

}  // namespace dermis::inline rays
