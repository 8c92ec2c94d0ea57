#pragma once
// Noise over space, repeatable on every machine: integer hashes, no tables.

#include <cstdint>

#include "subjects/bust/point.h"

namespace dermis::bust {

/// Uniform in [0, 1) for a cell of the integer lattice.
inline float lattice_random(int x, int y, int z, uint32_t seed) {
    uint32_t h = seed ^ uint32_t(x) * 0x8da6b343u ^ uint32_t(y) * 0xd8163841u ^ uint32_t(z) * 0xcb1ab31fu;
    h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u, h ^= h >> 15;
    return float(h >> 8) * (1.0f / 16777216.0f);
}

/// Smooth noise in [-1, 1], features about one unit apart (Perlin's value noise).
float value_noise(Point p, uint32_t seed);

/// Distances to the nearest and the second nearest of one random point a unit cell, and the nearest one's own
/// random number (Worley 1996). Only the 8 cells around are searched: points are kept in the middle half of
/// their cells.
struct Cells {
    float nearest, second, random;
};
Cells cell_noise(Point p, uint32_t seed);

}  // namespace dermis::bust
