#include "dermis/optics/tissue/layered_albedo.h"

#include <Eigen/Dense>
#include <cmath>

#include "dermis/optics/fresnel.h"
#include "dermis/optics/preintegration/quadrature.h"

namespace dermis::inline optics::tissue {
namespace {

constexpr int kHalf = 4, kDirections = 2 * kHalf;
using Matrix = Eigen::Matrix<double, kDirections, kDirections>;
using Vector = Eigen::Matrix<double, kDirections, 1>;

// Directions by the cosine to the normal, with one Gauss rule on either side of total internal reflection.
struct Directions {
    Vector cosine, weight;
    Vector reflected;  // by the boundary, from inside
};

Directions directions_of(double eta) {
    static const preintegration::GaussLegendre<kHalf> kRule;
    const double border = eta > 1.001 ? std::sqrt(1 - 1 / (eta * eta)) : 0.5;
    Directions d;
    for (int i = 0; i < kHalf; ++i) {
        const double node = kRule.node(size_t(i)), weight = kRule.weight(size_t(i));
        d.cosine[i] = border * node;
        d.weight[i] = border * weight;
        d.cosine[kHalf + i] = border + (1 - border) * node;
        d.weight[kHalf + i] = (1 - border) * weight;
    }
    for (int i = 0; i < kDirections; ++i) d.reflected[i] = fresnel_dielectric(d.cosine[i], 1 / eta);
    return d;
}

struct Slab {
    Matrix reflection, transmission;
};

// A medium after Wiscombe's delta-M scaling: the share g^kOrder of the scattered light that goes nearly
// straight on counts as not scattered, the rest is a sum of kOrder Legendre polynomials.
struct Medium {
    double sigma_t_per_mm, albedo;
    Matrix forward,
        backward;  // what scatters into a direction from the directions of its own side, and of the other
};

double legendre(int l, double x) {
    return l == 0 ? 1 : l == 1 ? x : l == 2 ? 1.5 * x * x - 0.5 : 2.5 * x * x * x - 1.5 * x;
}

Medium medium_of(const Directions& d, const TissueLayer& layer, double g) {
    constexpr int kOrder = 4;  // the Gauss rules integrate its products exactly
    const double straight = std::pow(g, kOrder), sigma_s = layer.sigma_s_per_mm * (1 - straight) / (1 - g);
    Medium m{.sigma_t_per_mm = sigma_s + layer.sigma_a_per_mm,
             .forward = Matrix::Zero(),
             .backward = Matrix::Zero()};
    m.albedo = sigma_s / m.sigma_t_per_mm;
    for (int l = 0; l < kOrder; ++l) {
        const double part = m.albedo / 2 * (2 * l + 1) * (std::pow(g, l) - straight) / (1 - straight);
        const Vector p = d.cosine.unaryExpr([l](double x) { return legendre(l, x); });
        const Matrix product = part * p * p.cwiseProduct(d.weight).transpose();
        m.forward += product;
        m.backward += l % 2 == 0 ? product : Matrix(-product);
    }
    return m;
}

// A layer of optical depth `depth` < the smallest cosine, by the midpoint rule across it: the sum and the
// difference of both directions of travel are known on one side from the other.
Slab thin_slab(const Directions& d, const Medium& medium, double depth) {
    const Vector half = depth / 2 * d.cosine.cwiseInverse();
    const Matrix one = Matrix::Identity();
    const auto across = [&](const Matrix& scatter) {
        const Matrix lost = half.asDiagonal() * (one - scatter);
        return Matrix((one + lost).partialPivLu().solve(one - lost));
    };
    const Matrix sum = across(medium.forward + medium.backward);
    const Matrix difference = across(medium.forward - medium.backward);
    return {.reflection = 0.5 * (sum - difference), .transmission = 0.5 * (sum + difference)};
}

// Light that bounces between a slab and what lies below it: (1 - R below)^-1 T.
Matrix between(const Slab& slab, const Matrix& below) {
    return (Matrix::Identity() - slab.reflection * below).partialPivLu().solve(slab.transmission);
}

Slab doubled(const Slab& slab) {
    const Matrix inside = between(slab, slab.reflection);
    return {.reflection = slab.reflection + slab.transmission * slab.reflection * inside,
            .transmission = slab.transmission * inside};
}

// Largest optical depth of a slab before it is doubled, over the smallest cosine of the quadrature.
constexpr double kThinnest = 0.5;

Slab slab_of(const Directions& d, const Medium& medium, double depth) {
    const int doublings = std::max(0, int(std::ceil(std::log2(depth / (kThinnest * d.cosine[0])))));
    Slab slab = thin_slab(d, medium, std::ldexp(depth, -doublings));
    for (int i = 0; i < doublings; ++i) slab = doubled(slab);
    return slab;
}

// A slab that is doubled until nothing passes, or, in a medium that hardly absorbs, 40 times.
Matrix half_space_reflection(const Directions& d, const Medium& medium) {
    Slab slab = thin_slab(d, medium, kThinnest * d.cosine[0]);
    for (int i = 0; i < 40 && slab.transmission.maxCoeff() > 1e-4; ++i) slab = doubled(slab);
    return slab.reflection;
}

// Both layers as one, below the boundary: the share of diffuse light that leaves again.
double leaving(const Directions& d, const Matrix& r) {
    // Diffuse light from outside fills the cone that the boundary passes.
    const Vector passed = Vector::Ones() - d.reflected;
    const Matrix inner = Matrix::Identity() - r * d.reflected.asDiagonal();
    const Vector up = inner.partialPivLu().solve(r * passed);
    const Vector flux = d.weight.cwiseProduct(d.cosine).cwiseProduct(passed);
    return flux.dot(up) / flux.sum();
}

Matrix on_top(const Slab& slab, const Matrix& below) {
    return slab.reflection + slab.transmission * below * between(slab, below);
}

Slab upper_slab(const Directions& d, const TissueLayer& layer, double thickness_mm, double g) {
    if (thickness_mm <= 0) return {.reflection = Matrix::Zero(), .transmission = Matrix::Identity()};
    const Medium medium = medium_of(d, layer, g);
    return slab_of(d, medium, thickness_mm * medium.sigma_t_per_mm);
}

}  // namespace

double layered_albedo(const TissueLayer& upper, double thickness_mm, const TissueLayer& lower, double g,
                      double eta) {
    const Directions d = directions_of(eta);
    const Matrix below = half_space_reflection(d, medium_of(d, lower, g));
    return leaving(d, on_top(upper_slab(d, upper, thickness_mm, g), below));
}

std::vector<double> layered_albedos(std::span<const TissueLayer> uppers, double thickness_mm,
                                    std::span<const TissueLayer> lowers, double g, double eta) {
    const Directions d = directions_of(eta);
    std::vector<Slab> slabs;
    for (const TissueLayer& upper : uppers) slabs.push_back(upper_slab(d, upper, thickness_mm, g));
    std::vector<double> albedos;
    for (const TissueLayer& lower : lowers) {
        const Matrix below = half_space_reflection(d, medium_of(d, lower, g));
        for (const Slab& slab : slabs) albedos.push_back(leaving(d, on_top(slab, below)));
    }
    return albedos;
}

}  // namespace dermis::inline optics::tissue
