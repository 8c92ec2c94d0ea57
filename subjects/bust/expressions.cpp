#include "subjects/bust/expressions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

// 1 at the centre of an ellipsoid, smoothly 0 at its surface.
double around(Point q, Point center, Point radii) {
    const Point d = q - center;
    return bump(length({d.x / radii.x, d.y / radii.y, d.z / radii.z}));
}

// The corners go up, out and back; the cheeks rise and swell over a deeper fold; the lips get thinner.
// q is on the left half.
Point smile(Point q, Point n) {
    const double corner = around(q, {26, -39, 100}, {24, 20, 30});
    const double cheek = around(q, {40, -12, 90}, {22, 20, 26});
    const double lids = around(q, {32, 8, 92}, {20, 9, 18});
    const double fold = bump((swept_ball(q, {19, -13, 105}, 0, {33, -36, 95}, 0)) / 7);
    const double lips = around(q, {0, -40, 112}, {26, 14, 22});
    const double swell = 2.2 * cheek + 0.7 * lids - 1.0 * fold;
    return Point{4.2, 5.2, -3.4} * corner + Point{0.8, 3.0, -0.4} * cheek + Point{0, 1.2, 0} * lids +
           Point{0, 0, -1.4} * lips + n * swell;
}

// The jaw turns about an axis through its joints before the ears, and with it what hangs on it: below the
// line of the mouth all of it, beside the mouth by and by. Between the lips the crease becomes a cavity.
Point jaw_open(Point q) {
    constexpr double kAngle = 0.13, kDepthMm = 15, kHingeY = -3, kHingeZ = 12;
    const double below = lip_shape(std::min(q.x, 31.0)).line_y - q.y;
    const double part = std::max(0.0, 1 - q.x * q.x / (24.0 * 24));
    const double parted = q.z > 80 ? std::pow(part, 0.7) : 0;  // nearly an ellipse
    const double beside = smooth_step(-16, 34, below);
    const double hanging = mix(beside, smooth_step(-0.9, 0.9, below), parted);
    const double neck = smooth_step(-150, -95, q.y), back = smooth_step(-12, 45, q.z);
    const double angle = kAngle * hanging * neck * back;
    const double y = q.y - kHingeY, z = q.z - kHingeZ, c = std::cos(angle), s = std::sin(angle);
    const double depth = kDepthMm * parted * std::sqrt(part) * bump(below / 1.3);
    return {0, y * c - z * s - y, z * c + y * s - z - depth};
}

// Brows and forehead slide upwards; the forehead folds across.
Point brows_up(Point q, Point n) {
    const double front = (1 - smooth_step(42, 62, q.x)) * smooth_step(30, 62, q.z);
    const double lift = smooth_step(23, 41, q.y) * (1 - smooth_step(46, 98, q.y)) * front;
    const double folds = smooth_step(52, 60, q.y) * (1 - smooth_step(80, 92, q.y)) *
                         (1 - smooth_step(20, 44, q.x)) * smooth_step(50, 70, q.z);
    const Point up = {0, 1, 0};
    return (up - n * dot(n, up)) * (6.5 * lift) +
           n * (0.45 * folds * std::cos((q.y - 57) * 2 * std::numbers::pi / 9));
}

// The ring of muscle around the eye draws together: brow down, cheek up, outer corner in.
Point squint(Point q, Point n) {
    const double brow = around(q, {29, 41, 100}, {30, 15, 26});
    const double cheek = around(q, {33, 3, 92}, {24, 15, 24});
    const double corner = around(q, {50, 18, 82}, {17, 14, 18});
    const double lid = around(q, {32, 20, 93}, {20, 10, 18});
    const Point out = unit({0.75, 0, -0.66});
    const double along = dot(q - Point{47, 17, 83}, out), across = q.y - 17;
    const double feet = bump((std::hypot(along, across) - 11) / 9) * smooth_step(-2, 5, along);
    const double rays = std::cos(7 * std::atan2(across, along));
    return Point{-0.8, -3.4, 0} * brow + Point{0, 3.2, 0} * cheek + out * (-2.0 * corner) +
           n * (0.5 * brow + 0.9 * cheek + 0.4 * lid + 0.35 * feet * rays);
}

struct Key {
    double time_s, weight;
};
constexpr double kClipS = 4;
// Of the clip, in the order of kExpressions.
constexpr Key kSmile[] = {{0.5, 0}, {1.1, 1}, {2.3, 1}, {2.8, 0}},
              kJaw[] = {{2.7, 0}, {3.05, 1}, {3.25, 0.5}, {3.4, 0.9}, {3.8, 0}},
              kBrows[] = {{0.1, 0}, {0.5, 1}, {0.9, 1}, {1.4, 0}, {2.7, 0}, {3.05, 0.7}, {3.6, 0}},
              kSquintL[] = {{1.5, 0}, {1.65, 1}, {1.8, 1}, {2.0, 0}},
              kSquintR[] = {{1.5, 0}, {1.65, 0.2}, {1.8, 0.2}, {2.0, 0}};
constexpr std::span<const Key> kTracks[] = {kSmile, kJaw, kBrows, kSquintL, kSquintR};
static_assert(std::size(kTracks) == std::size(kExpressions));

// Eased from key to key.
struct WeightAndSlope {
    double weight = 0, slope_per_s = 0;
};
WeightAndSlope weight_at(std::span<const Key> keys, double time_s) {
    if (time_s <= keys.front().time_s) return {keys.front().weight, 0};
    for (size_t i = 1; i < keys.size(); ++i)
        if (const Key& from = keys[i - 1], &to = keys[i]; time_s < to.time_s) {
            const double length_s = to.time_s - from.time_s, part = (time_s - from.time_s) / length_s;
            return {mix(from.weight, to.weight, smooth_step(from.time_s, to.time_s, time_s)),
                    (to.weight - from.weight) * 30 * part * part * (1 - part) * (1 - part) / length_s};
        }
    return {keys.back().weight, 0};
}

// Cubic splines between so many places are within 0.0002 of the weights.
WeightKeys all_keys() {
    constexpr int kPlacesPerS = 60;
    std::set<double> times_s;
    for (int i = 0; i <= kClipS * kPlacesPerS; ++i) times_s.insert(double(i) / kPlacesPerS);
    for (const std::span<const Key> track : kTracks)
        for (const Key& key : track) times_s.insert(key.time_s);
    WeightKeys all;
    for (const double time_s : times_s) {
        all.times_s.push_back(float(time_s));
        for (const bool is_weight : {false, true, false})
            for (const std::span<const Key> track : kTracks) {
                const WeightAndSlope at = weight_at(track, time_s);
                all.values.push_back(float(is_weight ? at.weight : at.slope_per_s));
            }
    }
    return all;
}

}  // namespace

Point expression_move(Point p, Point normal, const ExpressionWeights& weights) {
    const bool left = p.x >= 0;
    const Point q = left ? p : mirrored(p), n = left ? normal : mirrored(normal);
    Point move = smile(q, n) * weights[0] + jaw_open(q) * weights[1] + brows_up(q, n) * weights[2];
    if (const double weight = weights[left ? 3 : 4]; weight != 0) move = move + squint(q, n) * weight;
    return left ? move : mirrored(move);
}

Motion bust_motion() {
    Motion motion;
    motion.clips.push_back(
        {.name = "greet", .length_s = kClipS, .channels = std::size(kTracks), .weights = all_keys()});
    for (const std::string_view name : kExpressions) motion.targets.emplace_back(name);
    return motion;
}

ExpressionWeights expression_weights(const Pose& pose) {
    ExpressionWeights weights = {};
    const double time_s = pose.loop ? std::fmod(pose.time_s, kClipS) : pose.time_s;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (!pose.clip.empty()) weights[i] = weight_at(kTracks[i], time_s).weight;
        for (const std::string& name : {std::string(kExpressions[i]), numbered_name(i)})
            if (const auto given = pose.morph.find(name); given != pose.morph.end())
                weights[i] = double(given->second);
    }
    return weights;
}

}  // namespace dermis::bust
