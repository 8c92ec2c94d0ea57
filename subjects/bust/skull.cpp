#include "subjects/bust/skull.h"

#include <Eigen/Dense>
#include <array>
#include <numbers>
#include <span>

namespace dermis::bust {
namespace {

using std::numbers::pi;

constexpr Point kCenter = {0, 20, 5};
constexpr int kPolar = 20;    // spans from pole to pole
constexpr int kAzimuth = 24;  // spans around; half of them are mirror images
constexpr int kHalf = kAzimuth / 2 + 1;
constexpr int kUnknowns = (kPolar + 1) * kHalf;

// Radius in mm around the axis (x 0, z 10) at angles from the front (0) to the back (180 degrees) of an
// average adult head, without nose, eyes, lips, ears and neck, which are parts of their own. Height is above
// the ear axis.
constexpr std::array<double, 11> kAngles = {0, 15, 30, 45, 60, 75, 90, 112, 135, 157, 180};
struct Section {
    double y;
    std::array<double, 11> radius;
};
constexpr Section kSections[] = {
    {115, {57, 56, 53, 50, 48, 49, 50, 55, 60, 64, 65}},
    {95, {79, 78.5, 76, 69.5, 66, 66, 68, 73, 79, 82, 83}},
    {75, {90, 90, 88, 79.5, 74.5, 73.5, 75.5, 81, 87, 91, 93}},
    {60, {95, 94.5, 92, 82, 76, 75, 77, 83, 90, 95, 96}},
    {45, {97, 97, 95, 84, 77, 76, 77, 83, 91, 96, 97}},
    {30, {91, 87, 89, 86, 79, 76, 77, 82, 89, 94, 96}},
    {15, {91, 87, 89, 88, 81, 76, 76.5, 79, 86, 91, 92}},
    {0, {97, 93.5, 92, 89, 82, 75, 74, 75, 80, 85, 87}},
    {-15, {104, 99.5, 94.5, 88, 80, 74, 70, 70, 74, 78, 79}},
    {-37, {106.5, 102.5, 93, 84.5, 77, 70.5, 64, 59, 60, 63, 65}},
    {-50, {103, 100, 91, 81, 73.5, 66, 59, 51, 50, 52, 55}},
    {-65, {99, 96, 87, 76, 67, 58, 49, 43, 42, 42, 42}},
    {-78, {98, 94.5, 83, 69, 55, 45, 39, 36, 36, 36, 36}},
};
// Midline of crown, forehead, chin and the underside of the jaw: y, z.
constexpr std::array<double, 2> kMidline[] = {
    {132, 18},  {126.5, 42}, {120.5, 54}, {115, 64}, {108.5, 74}, {97, 86},   {85, 94.5},
    {126, -37}, {120, -44},  {92, -74},   {86, -78}, {-85, 106},  {-90, 101}, {-93, 92},
    {-96, 78},  {-99, 60},   {-99, 40},   {-98, 10}, {-92, -20},  {132.5, 5}, {131, -12},
};
// Under the jaw, off the midline.
constexpr Point kUnderJaw[] = {{18, -91, 82}, {30, -88, 68}, {25, -96, 50}, {42, -80, 46},
                               {35, -92, 25}, {53, -67, 20}, {30, -90, 0},  {12, -92, 94}};

double basis(double t) {
    const double a = std::abs(t);
    if (a >= 2) return 0;
    return a < 1 ? (4 - 6 * a * a + 3 * a * a * a) / 6 : (2 - a) * (2 - a) * (2 - a) / 6;
}
double basis_slope(double t) {
    const double a = std::abs(t), s = t < 0 ? -1 : 1;
    if (a >= 2) return 0;
    return s * (a < 1 ? -2 * a + 1.5 * a * a : -0.5 * (2 - a) * (2 - a));
}

// The unknown that grid node (i, j) is: over a pole the grid continues on the other side of the head.
int unknown(int i, int j) {
    if (i < 0) i = -i, j += kAzimuth / 2;
    if (i > kPolar) i = 2 * kPolar - i, j += kAzimuth / 2;
    j = ((j % kAzimuth) + kAzimuth) % kAzimuth;
    if (j > kAzimuth / 2) j = kAzimuth - j;
    return i * kHalf + j;
}

struct Sample {
    Point p;
    double weight;
};

std::vector<Sample> samples() {
    std::vector<Sample> list;
    for (const Section& s : kSections)
        for (size_t k = 0; k < kAngles.size(); ++k) {
            const double angle = kAngles[k] * pi / 180;
            list.push_back({{s.radius[k] * std::sin(angle), s.y, 10 + s.radius[k] * std::cos(angle)}, 1});
        }
    for (const auto& m : kMidline) list.push_back({{0, m[0], m[1]}, 1});
    for (const Point& p : kUnderJaw) list.push_back({p, 1});
    return list;
}

struct Direction {
    double radius, polar, azimuth;
};
Direction direction(Point p) {
    const Point q = p - kCenter;
    const double r = std::max(length(q), 1e-9);
    return {r, std::acos(std::clamp(q.y / r, -1.0, 1.0)), std::atan2(q.x, q.z)};
}

}  // namespace

Skull::Skull() {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kUnknowns);
    const auto equation = [&](std::span<const std::pair<int, double>> terms, double value, double weight) {
        for (const auto& [a, wa] : terms) {
            right[a] += weight * wa * value;
            for (const auto& [b, wb] : terms) normal(a, b) += weight * wa * wb;
        }
    };
    const std::vector<Sample> data = samples();
    for (const Sample& s : data) {
        const Direction d = direction(s.p);
        const double u = d.polar / pi * kPolar, v = d.azimuth / (2 * pi) * kAzimuth;
        std::vector<std::pair<int, double>> terms;
        for (int i = int(u) - 1; i <= int(u) + 2; ++i)
            for (int j = int(std::floor(v)) - 1; j <= int(std::floor(v)) + 2; ++j)
                terms.push_back({unknown(i, j), basis(u - i) * basis(v - j)});
        equation(terms, d.radius, s.weight);
    }
    // Thin plate: second differences along both directions, weighted because the azimuth spans get narrower
    // towards the poles.
    constexpr double kSmoothness = 0.02;
    for (int i = 0; i <= kPolar; ++i) {
        const double ring = std::max(std::sin(pi * i / kPolar), 0.15);
        for (int j = 0; j < kAzimuth; ++j) {
            const std::pair<int, double> down[] = {
                {unknown(i - 1, j), 1}, {unknown(i, j), -2}, {unknown(i + 1, j), 1}};
            const std::pair<int, double> around[] = {
                {unknown(i, j - 1), 1}, {unknown(i, j), -2}, {unknown(i, j + 1), 1}};
            equation(down, 0, kSmoothness * ring);
            equation(around, 0, kSmoothness / (ring * ring * ring) * 0.7);
        }
    }
    const Eigen::VectorXd solution = normal.ldlt().solve(right);
    // One row and column of margin each side, so that evaluation needs no wrapping.
    coefficients_.resize((kPolar + 4) * (kAzimuth + 4));
    for (int i = -1; i <= kPolar + 2; ++i)
        for (int j = -1; j <= kAzimuth + 2; ++j)
            coefficients_[(i + 1) * (kAzimuth + 4) + j + 1] = solution[unknown(i, j)];
}

Skull::Value Skull::evaluate(double polar, double azimuth) const {
    if (azimuth < 0) azimuth += 2 * pi;
    const double u = polar / pi * kPolar, v = azimuth / (2 * pi) * kAzimuth;
    const int i0 = std::min(int(u), kPolar), j0 = std::min(int(v), kAzimuth);
    Value value = {0, 0, 0};
    for (int i = i0 - 1; i <= i0 + 2; ++i) {
        double row = 0, row_slope = 0;
        for (int j = j0 - 1; j <= j0 + 2; ++j) {
            const double c = coefficients_[(i + 1) * (kAzimuth + 4) + j + 1];
            row += c * basis(v - j);
            row_slope += c * basis_slope(v - j);
        }
        value.radius += row * basis(u - i);
        value.by_polar += row * basis_slope(u - i);
        value.by_azimuth += row_slope * basis(u - i);
    }
    value.by_polar *= kPolar / pi;
    value.by_azimuth *= kAzimuth / (2 * pi);
    return value;
}

double Skull::distance_mm(Point p) const {
    const Direction d = direction(p);
    const Value v = evaluate(d.polar, d.azimuth);
    const double ring = std::max(std::sin(d.polar), 0.05);
    const double a = v.by_polar / v.radius, b = v.by_azimuth / (v.radius * ring);
    return (d.radius - v.radius) / std::sqrt(1 + a * a + b * b);
}

}  // namespace dermis::bust
