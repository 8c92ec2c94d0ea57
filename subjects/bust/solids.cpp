#include "subjects/bust/solids.h"

namespace dermis::bust {

Tube::Tube(std::span<const Knot> knots, int steps_per_span) {
    const auto knot = [&](size_t k) -> const Knot& { return knots[std::min(k, knots.size() - 1)]; };
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
        const Knot &a = knot(i == 0 ? 0 : i - 1), &b = knot(i), &c = knot(i + 1), &d = knot(i + 2);
        for (int k = 0; k < steps_per_span; ++k) {
            const double t = double(k) / steps_per_span;
            const Point bend = (c.at - a.at) + (a.at * 2 - b.at * 5 + c.at * 4 - d.at) * t +
                               ((b.at - c.at) * 3 + d.at - a.at) * (t * t);
            path_.push_back({b.at + bend * (0.5 * t), mix(b.radius, c.radius, smooth_step(0, 1, t))});
        }
    }
    path_.push_back(knots.back());
}

double Tube::distance_mm(Point p) const {
    double nearest = 1e9;
    for (size_t i = 0; i + 1 < path_.size(); ++i)
        nearest = std::min(nearest,
                           swept_ball(p, path_[i].at, path_[i].radius, path_[i + 1].at, path_[i + 1].radius));
    return nearest;
}

}  // namespace dermis::bust
