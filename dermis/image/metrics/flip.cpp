// LDR FLIP, Andersson et al. 2020. Two differences per texel, each as an observer would see it:
//   colour: both pictures are blurred by the eye's contrast sensitivity in an opponent space, then compared
//   in L*a*b*
//     with Hunt's adjustment by the HyAB distance (section 4.1);
//   feature: strength of edges and points in luminance (section 4.2);
// and their combination dE_c^(1 - dE_f) (section 4.3). All filters are separable and applied as such.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/image/metrics/metric_input.h"

namespace dermis::inline image {
namespace {

using metrics::Plane;
using Planes = std::array<Plane, 3>;

constexpr float kColourExponent = 0.7f;                  // q_c
constexpr float kColourKnee = 0.4f, kKneeError = 0.95f;  // p_c, p_t: where errors are compressed, and to what
constexpr double kFeatureWidthDegrees = 0.082;           // w
constexpr float kFeatureExponent = 0.5f;                 // q_f

// Table 1: contrast sensitivity as sums of two Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees; the
// second one of the achromatic and red-green channels has no weight.
struct Gaussian {
    double a, b;
};
constexpr double kWidestB = 0.04;
constexpr Gaussian kAchromatic[] = {{1.0, 0.0047}};
constexpr Gaussian kRedGreen[] = {{1.0, 0.0053}};
constexpr Gaussian kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};

// A linearised L*a*b* (section 4.1): Y = 116 y - 16, Cx = 500 (x - y), Cz = 200 (y - z) with x, y, z relative
// to white.
Vec3 opponent_from_linear(Vec3 c_linear) {
    const Vec3 xyz = kXyzFromLinear * c_linear;
    const float x = xyz.x / kWhiteXyz.x, y = xyz.y / kWhiteXyz.y, z = xyz.z / kWhiteXyz.z;
    return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

Vec3 linear_from_opponent(Vec3 o) {
    const float y = (o.x + 16.0f) / 116.0f, x = y + o.y / 500.0f, z = y - o.z / 200.0f;
    return kLinearFromXyz * Vec3{x * kWhiteXyz.x, y * kWhiteXyz.y, z * kWhiteXyz.z};
}

// Calls body(texel) -> Vec3 for all texels and stores the three numbers.
template <class Body>
Planes map_planes(const Planes& in, Body body) {
    const Plane blank(in[0].width, in[0].height);
    Planes out = {blank, blank, blank};
    parallel_for(blank.values.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3 v = body(Vec3{in[0].values[i], in[1].values[i], in[2].values[i]});
            out[0].values[i] = v.x, out[1].values[i] = v.y, out[2].values[i] = v.z;
        }
    });
    return out;
}

// A sum of Gaussians is not separable, but each Gaussian is. The sum is normalised over the
// square of texels that the widest one needs (three standard deviations).
Plane contrast_filter(const Plane& plane, std::span<const Gaussian> gaussians, double pixels_per_degree) {
    constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
    const int reach = int(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi2)) * pixels_per_degree));
    std::vector<std::vector<double>> kernels;
    double total = 0;
    for (const auto& [a, b] : gaussians) {
        std::vector<double> kernel;
        double sum = 0;
        for (int i = -reach; i <= reach; ++i) {
            const double x = i / pixels_per_degree;
            kernel.push_back(std::sqrt(a * std::sqrt(std::numbers::pi / b)) * std::exp(-kPi2 * x * x / b));
            sum += kernel.back();
        }
        total += sum * sum;
        kernels.push_back(kernel);
    }
    Plane out(plane.width, plane.height);
    for (const std::vector<double>& kernel : kernels) {
        std::vector<float> weights;
        for (const double value : kernel) weights.push_back(float(value / std::sqrt(total)));
        const Plane part = filter_columns(filter_rows(plane, weights), weights);
        for (size_t i = 0; i < out.values.size(); ++i) out.values[i] += part.values[i];
    }
    return out;
}

// L*a*b* with a and b scaled by lightness: colours look more saturated where it is bright.
Vec3 hunt_from_linear(Vec3 c_linear) {
    const Vec3 lab = lab_from_linear(c_linear);
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

float hyab(Vec3 a, Vec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// The perceived picture: filtered opponent channels, clamped to the gamut, in Hunt's L*a*b*.
Planes perceived(const Planes& opponent, double pixels_per_degree) {
    const Planes filtered = {contrast_filter(opponent[0], kAchromatic, pixels_per_degree),
                             contrast_filter(opponent[1], kRedGreen, pixels_per_degree),
                             contrast_filter(opponent[2], kBlueYellow, pixels_per_degree)};
    return map_planes(filtered, [](Vec3 o) {
        const Vec3 c = linear_from_opponent(o);
        const auto clamp = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
        return hunt_from_linear({clamp(c.x), clamp(c.y), clamp(c.z)});
    });
}

// HyAB^q_c, whose largest value (blue to green) is brought to 1: linear to the knee; the rare errors beyond
// it are compressed into the last twentieth.
float colour_error(Vec3 a, Vec3 b) {
    static const float kLargest =
        std::pow(hyab(hunt_from_linear({0, 1, 0}), hunt_from_linear({0, 0, 1})), kColourExponent);
    const float error = std::pow(hyab(a, b), kColourExponent), knee = kColourKnee * kLargest;
    return error < knee ? error * kKneeError / knee
                        : kKneeError + (error - knee) / (kLargest - knee) * (1.0f - kKneeError);
}

// First and second derivative of a Gaussian, positive and negative weights each scaled to sum to 1 and -1.
struct FeatureKernels {
    std::vector<float> gaussian, edge, point;
};

std::vector<float> normalised(const std::vector<double>& kernel) {
    double positive = 0, negative = 0;
    for (const double value : kernel) (value > 0 ? positive : negative) += std::abs(value);
    std::vector<float> out;
    for (const double value : kernel)
        out.push_back(float(value > 0 ? value / positive : negative > 0 ? value / negative : 0.0));
    return out;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
    const double sigma = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
    const int reach = int(std::ceil(3.0 * sigma));
    std::vector<double> gaussian, edge, point;
    for (int i = -reach; i <= reach; ++i) {
        const double g = std::exp(-i * i / (2.0 * sigma * sigma));
        gaussian.push_back(g);
        edge.push_back(-i * g);
        point.push_back((i * i / (sigma * sigma) - 1.0) * g);
    }
    return {normalised(gaussian), normalised(edge), normalised(point)};
}

// Length of the (x, y) response to a feature's kernel.
Plane feature_strength(const Plane& luminance, std::span<const float> kernel,
                       std::span<const float> gaussian) {
    Plane x = filter_columns(filter_rows(luminance, kernel), gaussian);
    const Plane y = filter_columns(filter_rows(luminance, gaussian), kernel);
    for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
}

struct Seen {
    Planes colour;
    Plane edges, points;
};

Seen look_at(const Image& linear, double pixels_per_degree) {
    const Planes opponent = map_planes(metrics::display_planes(linear), opponent_from_linear);
    Plane luminance = opponent[0];
    for (float& value : luminance.values) value = (value + 16.0f) / 116.0f;
    const FeatureKernels kernels = feature_kernels(pixels_per_degree);
    return {perceived(opponent, pixels_per_degree),
            feature_strength(luminance, kernels.edge, kernels.gaussian),
            feature_strength(luminance, kernels.point, kernels.gaussian)};
}

}  // namespace

Result<Image> flip_map(const Image& image, const Image& reference, double pixels_per_degree) {
    DERMIS_TRY_ASSIGN(const metrics::Pair pair, metrics::checked_pair(image, reference));
    if (!(pixels_per_degree > 0 && pixels_per_degree <= 1000))
        return Error{"pixels per degree must be above 0 and at most 1000"};
    const Seen a = look_at(pair.image, pixels_per_degree), b = look_at(pair.reference, pixels_per_degree);
    Image map(image.width, image.height, 1);
    parallel_for(map.pixel_count(), 4096, [&](size_t begin, size_t end) {
        const auto colour = [](const Seen& s, size_t i) {
            return Vec3{s.colour[0].values[i], s.colour[1].values[i], s.colour[2].values[i]};
        };
        for (size_t i = begin; i < end; ++i) {
            const float edges = std::abs(a.edges.values[i] - b.edges.values[i]);
            const float points = std::abs(a.points.values[i] - b.points.values[i]);
            const float feature =
                std::pow(std::max(edges, points) / std::numbers::sqrt2_v<float>, kFeatureExponent);
            map.floats()[i] = std::pow(colour_error(colour(a, i), colour(b, i)), 1.0f - feature);
        }
    });
    return map;
}

Result<double> mean_flip(const Image& image, const Image& reference, const Image& mask,
                         double pixels_per_degree) {
    DERMIS_TRY_ASSIGN(const Image map, flip_map(image, reference, pixels_per_degree));
    return mean_of(map, mask);
}

}  // namespace dermis::inline image
