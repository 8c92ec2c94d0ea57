#include "subjects/bust/noise.h"

namespace dermis::bust {

float value_noise(Point p, uint32_t seed) {
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y)), z = int(std::floor(p.z));
    const auto fade = [](double t) { return float(t * t * (3 - 2 * t)); };
    const float u = fade(p.x - x), v = fade(p.y - y), w = fade(p.z - z);
    const auto row = [&](int dy, int dz) {
        const float a = lattice_random(x, y + dy, z + dz, seed),
                    b = lattice_random(x + 1, y + dy, z + dz, seed);
        return a + (b - a) * u;
    };
    const float a = row(0, 0), b = row(1, 0), c = row(0, 1), d = row(1, 1);
    const float low = a + (b - a) * v, high = c + (d - c) * v;
    return 2 * (low + (high - low) * w) - 1;
}

Cells cell_noise(Point p, uint32_t seed) {
    const int x0 = int(std::floor(p.x - 0.5)), y0 = int(std::floor(p.y - 0.5)),
              z0 = int(std::floor(p.z - 0.5));
    Cells cells = {9, 9, 0};
    for (int k = 0; k < 8; ++k) {
        const int x = x0 + (k & 1), y = y0 + (k >> 1 & 1), z = z0 + (k >> 2);
        const float random = lattice_random(x, y, z, seed);
        // Three more numbers from the digits of the first.
        const auto digit = [&](float f) {
            const float v = random * f;
            return 0.2f + 0.6f * (v - std::floor(v));
        };
        const float dx = float(x - p.x) + digit(37.31f), dy = float(y - p.y) + digit(173.7f),
                    dz = float(z - p.z) + digit(911.9f);
        const float d = dx * dx + dy * dy + dz * dz;
        if (d < cells.nearest) {
            cells.second = cells.nearest;
            cells.nearest = d;
            cells.random = random;
        } else if (d < cells.second) {
            cells.second = d;
        }
    }
    cells.nearest = std::sqrt(cells.nearest);
    cells.second = std::sqrt(cells.second);
    return cells;
}

}  // namespace dermis::bust
