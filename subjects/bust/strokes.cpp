#include "subjects/bust/strokes.h"

namespace dermis::bust {
namespace {

// The kernel's integral along a straight curve through its centre is 32/35 of its radius on either side.
constexpr double kKernelLength = 32.0 / 35.0;
constexpr double kSpacing = 0.3;

double catmull_rom(double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

StrokePoint between(std::span<const StrokePoint> curve, size_t i, double t) {
    const auto clamp = [&](size_t k) -> const StrokePoint& { return curve[std::min(k, curve.size() - 1)]; };
    const StrokePoint& a = curve[i == 0 ? 0 : i - 1];
    const StrokePoint &b = clamp(i), &c = clamp(i + 1), &d = clamp(i + 2);
    return {{catmull_rom(a.at.x, b.at.x, c.at.x, d.at.x, t), catmull_rom(a.at.y, b.at.y, c.at.y, d.at.y, t),
             catmull_rom(a.at.z, b.at.z, c.at.z, d.at.z, t)},
            mix(b.radius_mm, c.radius_mm, t),
            mix(b.lift_mm, c.lift_mm, t)};
}

}  // namespace

void StrokeLayer::add(std::span<const StrokePoint> curve, Mirror mirror, const Snap& snap) {
    const auto dab = [&](const StrokePoint& s, double weight) {
        const double inverse = 1 / (s.radius_mm * s.radius_mm);
        const Point at = snap(s.at);
        dabs_.push_back({at, inverse, s.lift_mm * weight, s.radius_mm});
        if (mirror == Mirror::yes) dabs_.push_back({mirrored(at), inverse, s.lift_mm * weight, s.radius_mm});
    };
    if (curve.size() == 1) return dab(curve[0], 1);
    for (size_t i = 0; i + 1 < curve.size(); ++i) {
        const double span_mm = length(curve[i + 1].at - curve[i].at);
        const double radius = std::min(curve[i].radius_mm, curve[i + 1].radius_mm);
        const int steps = std::max(1, int(std::ceil(span_mm / (kSpacing * radius))));
        for (int k = 0; k < steps; ++k) {
            const StrokePoint s = between(curve, i, (k + 0.5) / steps);
            dab(s, span_mm / steps / (s.radius_mm * kKernelLength));
        }
    }
}

int StrokeLayer::cell_of(Point p) const {
    const int x = int(std::floor((p.x - low_.x) / kCellMm)), y = int(std::floor((p.y - low_.y) / kCellMm)),
              z = int(std::floor((p.z - low_.z) / kCellMm));
    if (x < 0 || y < 0 || z < 0 || x >= cells_[0] || y >= cells_[1] || z >= cells_[2]) return -1;
    return (z * cells_[1] + y) * cells_[0] + x;
}

void StrokeLayer::build() {
    if (dabs_.empty()) return;
    Point high = low_ = dabs_[0].at;
    for (const Dab& d : dabs_) {
        low_ = {std::min(low_.x, d.at.x - d.radius), std::min(low_.y, d.at.y - d.radius),
                std::min(low_.z, d.at.z - d.radius)};
        high = {std::max(high.x, d.at.x + d.radius), std::max(high.y, d.at.y + d.radius),
                std::max(high.z, d.at.z + d.radius)};
    }
    cells_ = {int((high.x - low_.x) / kCellMm) + 1, int((high.y - low_.y) / kCellMm) + 1,
              int((high.z - low_.z) / kCellMm) + 1};
    std::vector<std::vector<int>> lists(size_t(cells_[0]) * cells_[1] * cells_[2]);
    for (size_t i = 0; i < dabs_.size(); ++i) {
        const Dab& d = dabs_[i];
        const auto range = [&](double center, double low, int count) {
            return std::pair{std::max(0, int(std::floor((center - d.radius - low) / kCellMm))),
                             std::min(count - 1, int(std::floor((center + d.radius - low) / kCellMm)))};
        };
        const auto [x0, x1] = range(d.at.x, low_.x, cells_[0]);
        const auto [y0, y1] = range(d.at.y, low_.y, cells_[1]);
        const auto [z0, z1] = range(d.at.z, low_.z, cells_[2]);
        for (int z = z0; z <= z1; ++z)
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x)
                    lists[(size_t(z) * cells_[1] + y) * cells_[0] + x].push_back(int(i));
    }
    first_.assign(1, 0);
    entries_.clear();
    for (const std::vector<int>& list : lists) {
        for (const int i : list) entries_.push_back(dabs_[i]);
        first_.push_back(int(entries_.size()));
    }
}

double StrokeLayer::at(Point p) const {
    const int cell = cell_of(p);
    if (cell < 0) return 0;
    double sum = 0;
    for (int i = first_[cell]; i < first_[cell + 1]; ++i) {
        const Dab& d = entries_[i];
        const double rest = 1 - dot(p - d.at, p - d.at) * d.inverse_radius2;
        if (rest > 0) sum += d.lift * rest * rest * rest;
    }
    return sum;
}

}  // namespace dermis::bust
