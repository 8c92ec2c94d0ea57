#pragma once
// The judge of the skin model: random walks through its two layers, written without any of its code. A walk
// enters diffusely below a smooth boundary, scatters by Henyey and Greenstein with the whole (not the
// reduced) coefficients, and ends where the boundary lets it out.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace dermis {

struct WalkedLayer {
    double reduced_sigma_s_per_mm, sigma_a_per_mm;
};

struct WalkedLayers {
    WalkedLayer upper, lower;
    double thickness_mm;  // of the upper layer
    double eta = 1.4, g = 0.8;
};

/// What one walk brings back; 0 where it was absorbed.
struct WalkReturn {
    double light = 0, radius_mm = 0;
};

class LayeredWalk {
  public:
    LayeredWalk(const WalkedLayers& layers, unsigned seed) : layers_(layers), random_(seed) {}

    WalkReturn one() {
        double cosine;
        do cosine = std::sqrt(uniform());
        while (uniform() < reflectance(cosine));
        const double angle = 2 * std::numbers::pi * uniform(), sine = std::sqrt(1 - cosine * cosine);
        x_ = y_ = z_ = 0;
        direction_[0] = sine * std::cos(angle), direction_[1] = sine * std::sin(angle);
        direction_[2] = cosine;  // z is the depth
        upper_ = layers_.thickness_mm > 0;
        light_ = 1;
        while (light_ > 0) {
            if (!fly()) return {light_, std::hypot(x_, y_)};
        }
        return {};
    }

  private:
    double uniform() { return std::uniform_real_distribution<double>()(random_); }

    // Fresnel from inside.
    double reflectance(double cosine) const {
        const double sine = layers_.eta * std::sqrt(1 - cosine * cosine);
        if (sine >= 1) return 1;
        const double out = std::sqrt(1 - sine * sine);
        const double s = (layers_.eta * cosine - out) / (layers_.eta * cosine + out);
        const double p = (layers_.eta * out - cosine) / (layers_.eta * out + cosine);
        return (s * s + p * p) / 2;
    }

    void move(double distance) {
        const WalkedLayer& layer = upper_ ? layers_.upper : layers_.lower;
        light_ *= std::exp(-layer.sigma_a_per_mm * distance);
        x_ += direction_[0] * distance, y_ += direction_[1] * distance, z_ += direction_[2] * distance;
    }

    // To the next collision, through borders of layers; false when the walk leaves.
    bool fly() {
        double depth = -std::log(1 - uniform());  // optical, of scattering alone: absorption is a weight
        for (;;) {
            const WalkedLayer& layer = upper_ ? layers_.upper : layers_.lower;
            const double sigma_s = layer.reduced_sigma_s_per_mm / (1 - layers_.g), up = direction_[2];
            double border = 1e300;
            if (upper_ && up > 0) border = (layers_.thickness_mm - z_) / up;
            if (up < 0) border = (z_ - (upper_ ? 0 : layers_.thickness_mm)) / -up;
            if (depth / sigma_s < border) {
                move(depth / sigma_s);
                break;
            }
            move(border);
            depth -= border * sigma_s;
            const bool surface = up < 0 && (upper_ || layers_.thickness_mm <= 0);
            if (!surface) {
                upper_ = !upper_;
                z_ = layers_.thickness_mm;
                continue;
            }
            z_ = 0;
            if (uniform() >= reflectance(-up)) return false;
            direction_[2] = -up;
        }
        scatter();
        if (light_ < 0.05) light_ = uniform() < 0.2 ? light_ * 5 : 0;
        return true;
    }

    void scatter() {
        const double g = layers_.g, u = uniform(), angle = 2 * std::numbers::pi * uniform();
        double cosine = 2 * u - 1;
        if (g != 0) {
            const double part = (1 - g * g) / (1 - g + 2 * g * u);
            cosine = (1 + g * g - part * part) / (2 * g);
        }
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double a = sine * std::cos(angle), b = sine * std::sin(angle);
        const double dx = direction_[0], dy = direction_[1], dz = direction_[2];
        const double across = std::sqrt(std::max(1e-300, 1 - dz * dz));
        if (across < 1e-6) {
            direction_[0] = a, direction_[1] = b, direction_[2] = dz > 0 ? cosine : -cosine;
        } else {
            direction_[0] = a * dx * dz / across - b * dy / across + cosine * dx;
            direction_[1] = a * dy * dz / across + b * dx / across + cosine * dy;
            direction_[2] = -a * across + cosine * dz;
        }
        const double length = std::hypot(direction_[0], direction_[1], direction_[2]);
        for (double& d : direction_) d /= length;
    }

    WalkedLayers layers_;
    std::mt19937_64 random_;
    double x_ = 0, y_ = 0, z_ = 0, direction_[3] = {}, light_ = 1;
    bool upper_ = true;
};

}  // namespace dermis
