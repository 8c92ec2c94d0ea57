#include "subjects/bust/hairs.h"

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

constexpr double kCell = 1.5, kLow = 4, kHigh = 64;  // both axes
constexpr int kCells = int((kHigh - kLow) / kCell);
// Half a texel of the 2048 atlas on the face: a thinner hair is drawn paler instead.
constexpr double kSoftMm = 0.17;

class Random {
  public:
    explicit Random(uint32_t seed) : state_(seed * 747796405u + 2891336453u) {}
    double between(double low, double high) {
        state_ = state_ * 1664525u + 1013904223u;
        uint32_t v = state_;
        v ^= v >> 15, v *= 0x2c1b3c6du, v ^= v >> 12;
        return low + (high - low) * (v >> 8) / 16777216.0;
    }

  private:
    uint32_t state_;
};

// Middle line and half width of the brow along its length, 0 beside the nose to 1 at the tail.
struct BrowLine {
    double x, y, half, lean_rad;  ///< lean of the hairs from straight outward
};
constexpr BrowLine kBrow[] = {{10.0, 37.6, 2.6, 1.20}, {15.0, 38.3, 4.0, 0.95}, {22.0, 39.3, 4.6, 0.60},
                              {31.0, 40.6, 4.4, 0.32}, {40.0, 41.0, 3.8, 0.06}, {48.0, 39.3, 2.9, -0.28},
                              {55.0, 35.8, 1.4, -0.52}};

BrowLine brow_at(double t) {
    constexpr int kLast = int(std::size(kBrow)) - 1;
    const double at = std::clamp(t, 0.0, 1.0) * kLast;
    const int i = std::min(int(at), kLast - 1);
    const double f = at - i;
    const BrowLine &a = kBrow[i], &b = kBrow[i + 1];
    return {mix(a.x, b.x, f), mix(a.y, b.y, f), mix(a.half, b.half, f), mix(a.lean_rad, b.lean_rad, f)};
}

}  // namespace

Hairs::Hairs(uint32_t seed) {
    for (Side* side : {&left_, &right_}) {
        side->cells.resize(size_t(kCells) * kCells);
        const uint32_t own = seed * 2 + (side == &left_ ? 0 : 1);
        grow_brow(*side, own);
        grow_lashes(*side, own + 77);
    }
}

void Hairs::grow(Side& side, const std::array<Point, 3>& curve, double half_width_mm, double opacity) {
    // A quadratic curve in three straight pieces, thinning to its tip.
    constexpr int kPieces = 3;
    const auto at = [&](double t) { return mix(mix(curve[0], curve[1], t), mix(curve[1], curve[2], t), t); };
    for (int i = 0; i < kPieces; ++i) {
        const double t0 = double(i) / kPieces, t1 = double(i + 1) / kPieces;
        const Stroke s = {at(t0), at(t1), half_width_mm * (1 - 0.8 * t0), half_width_mm * (1 - 0.8 * t1),
                          opacity * (1 - 0.3 * t0)};
        const double reach = half_width_mm + kSoftMm;
        const auto cell = [](double v) { return std::clamp(int((v - kLow) / kCell), 0, kCells - 1); };
        for (int y = cell(std::min(s.from.y, s.to.y) - reach); y <= cell(std::max(s.from.y, s.to.y) + reach);
             ++y)
            for (int x = cell(std::min(s.from.x, s.to.x) - reach);
                 x <= cell(std::max(s.from.x, s.to.x) + reach); ++x)
                side.cells[size_t(y) * kCells + size_t(x)].push_back(s);
    }
}

void Hairs::grow_brow(Side& side, uint32_t seed) {
    Random random(seed);
    constexpr int kHairs = 720;
    for (int i = 0; i < kHairs; ++i) {
        const double t = (i + random.between(0, 1)) / kHairs;
        // The sum of two random numbers: denser along the middle line than at the borders.
        const double across = random.between(-0.62, 0.62) + random.between(-0.5, 0.5);
        const BrowLine b = brow_at(t * 0.96);
        const Point root = {b.x + random.between(-0.6, 0.6), b.y + across * b.half, 0};
        // Upper hairs lie down towards the middle line and lower ones rise to it.
        const double lean =
            b.lean_rad - across * mix(0.15, 0.55, smooth_step(0.1, 0.5, t)) + random.between(-0.16, 0.16);
        const double length = mix(4.2, 7.5, smooth_step(0, 0.35, t)) * random.between(0.65, 1.1) *
                              mix(1, 0.65, smooth_step(0.75, 1, t));
        const double bend = lean - mix(0.5, 0.25, t);
        const Point middle = root + Point{std::cos(lean), std::sin(lean), 0} * (0.5 * length);
        grow(side, {root, middle, middle + Point{std::cos(bend), std::sin(bend), 0} * (0.5 * length)},
             random.between(0.10, 0.17), random.between(0.55, 0.92));
    }
}

void Hairs::grow_lashes(Side& side, uint32_t seed) {
    Random random(seed);
    constexpr int kLashes = 95;
    for (int i = 0; i < kLashes; ++i) {
        const double t = (i + random.between(0.1, 0.9)) / kLashes, x = mix(17.0, 47.5, t);
        // They point down and outward over the lower lid, and turn up again at the tips.
        const double fan = mix(-1.75, -0.75, t) + random.between(-0.12, 0.12);
        const double length = mix(2.0, 5.2, smooth_step(0, 0.6, t)) * random.between(0.7, 1.05);
        const Point root = {x, lid_slit_y(x) + 0.1, 0};
        const Point middle = root + Point{std::cos(fan), std::sin(fan), 0} * (0.55 * length);
        grow(side,
             {root, middle, middle + Point{std::cos(fan + 0.6), std::sin(fan + 0.6), 0} * (0.45 * length)},
             random.between(0.08, 0.12), random.between(0.4, 0.75));
    }
}

float Hairs::cover(Point p) const {
    const double x = std::abs(p.x);
    if (x < kLow || x >= kHigh - kCell || p.y < kLow || p.y >= kHigh - kCell || p.z < 55) return 0;
    const Side& side = p.x > 0 ? left_ : right_;
    double bare = 1;
    for (const Stroke& s : side.cells[size_t((p.y - kLow) / kCell) * kCells + size_t((x - kLow) / kCell)]) {
        const Point along = s.to - s.from, q = Point{x, p.y, 0} - s.from;
        const double t = std::clamp(dot(q, along) / std::max(dot(along, along), 1e-9), 0.0, 1.0);
        const double half = mix(s.half_width_from, s.half_width_to, t), away = length(q - along * t);
        const double inside = std::clamp((half + kSoftMm - away) / (2 * kSoftMm), 0.0, half / kSoftMm);
        bare *= 1 - s.opacity * std::min(inside, 1.0);
    }
    // The margin of the upper lid, dark with their roots.
    const double below = lid_slit_y(x) - p.y;
    const double margin = smooth_step(16, 21, x) * (1 - smooth_step(44.5, 49, x)) *
                          (1 - smooth_step(0.2, 0.9, std::abs(below + 0.05)));
    return float(1 - bare * (1 - 0.7 * margin));
}

}  // namespace dermis::bust
