// The baker against the loop it replaces: 512 x 512 texels, three channels, six Gaussians, one thread, CPU
// time, and the largest error of both against adaptive quadrature of the definition at the same texels. The
// loop is written as published code has it: for every texel, taps over the ring, and for every tap all
// Gaussians.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <vector>

#include "../tests/optics/adaptive_quadrature.h"
#include "dermis/bake/lut.h"
#include "dermis/base/parallel.h"

using namespace dermis;

namespace {

constexpr int kSide = 512, kTaps = 200;
constexpr double kPi = std::numbers::pi;

double milliseconds_since(std::clock_t start) {
    return 1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Measured {
    double time_ms = 1e300;
    Table table;
};

LutOptions options_of(Construction construction) {
    LutOptions options = *lut_options("dermis");
    options.width = options.height = kSide;
    options.convention.how.construction = construction;
    return options;
}

// The best of several runs: the first also makes the tables of constants.
Measured run_baker(Construction construction) {
    Measured best;
    for (int run = 0; run < 12; ++run) {
        const LutOptions options = options_of(construction);
        const std::clock_t start = std::clock();
        Result<Table> table = bake_lut(options);
        const double time_ms = milliseconds_since(start);
        if (!table) std::exit((std::fprintf(stderr, "%s\n", table.error().message.c_str()), 1));
        if (time_ms < best.time_ms) best = {time_ms, std::move(*table)};
    }
    return best;
}

float gaussian(float variance, float distance) {
    return 1.0f / std::sqrt(2.0f * float(kPi) * variance) * std::exp(-(distance * distance) / (2 * variance));
}

void straightforward_texel(const GaussianSum& skin, float n_dot_l, float radius_mm, float* rgb) {
    const float theta = std::acos(n_dot_l), step = 2 * float(kPi) / kTaps;
    float light[3] = {}, total[3] = {};
    for (int tap = 0; tap < kTaps; ++tap) {
        const float a = -float(kPi) + (float(tap) + 0.5f) * step;
        const float diffuse = std::max(0.0f, std::cos(theta + a));
        const float distance_mm = std::abs(2.0f * radius_mm * std::sin(a * 0.5f));
        for (const GaussianTerm& term : skin.terms) {
            const float value = gaussian(float(term.variance_mm2), distance_mm);
            for (size_t c = 0; c < 3; ++c) {
                total[c] += float(term.weight[c]) * value;
                light[c] += float(term.weight[c]) * value * diffuse;
            }
        }
    }
    for (size_t c = 0; c < 3; ++c) rgb[c] = light[c] / total[c];
}

Measured run_loop() {
    Measured measured;
    const GaussianSum skin = gpu_gems_3_skin();
    measured.table = {
        .width = kSide, .height = kSide, .convention = options_of(Construction::full_ring).convention};
    measured.table.data.resize(size_t(kSide) * kSide * 3);
    const std::clock_t start = std::clock();
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            straightforward_texel(skin, float(measured.table.u_value(x)),
                                  float(1 / measured.table.v_value(y)),
                                  measured.table.data.data() + 3 * (size_t(y) * kSide + size_t(x)));
    measured.time_ms = milliseconds_since(start);
    return measured;
}

// Every 37th texel of every 31st row, red and blue.
double largest_error(const Table& table, Construction construction) {
    double worst = 0;
    for (size_t c : {0u, 2u}) {
        const auto profile = [&](double d) {
            double sum = 0;
            for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
                const double v = term.variance_mm2;
                const double norm = construction == Construction::sphere ? v : std::sqrt(v);
                sum += term.weight[c] * std::exp(-d * d / (2 * v)) / norm;
            }
            return sum;
        };
        for (int y = 0; y < kSide; y += 31)
            for (int x = 0; x < kSide; x += 37) {
                const double t = table.u_value(x), radius_mm = 1 / table.v_value(y);
                const double exact = construction == Construction::sphere
                                         ? test::sphere_integral(profile, 0.03, t, radius_mm)
                                         : test::ring_integral(profile, 0.03, t, radius_mm, kPi);
                worst = std::max(worst, std::abs(table.at(x, y, int(c)) - exact));
            }
    }
    return worst;
}

}  // namespace

int main() {
    set_thread_limit(1);
    const Measured sphere = run_baker(Construction::sphere);
    const Measured ring = run_baker(Construction::full_ring);
    const Measured loop = run_loop();
    const double sphere_error = largest_error(sphere.table, Construction::sphere);
    const double ring_error = largest_error(ring.table, Construction::full_ring);
    const double loop_error = largest_error(loop.table, Construction::full_ring);
    std::printf("%-34s %10s %12s\n", "512 x 512 RGB, six Gaussians", "CPU ms", "max error");
    std::printf("%-34s %10.2f %12.2g\n", "this baker, sphere", sphere.time_ms, sphere_error);
    std::printf("%-34s %10.2f %12.2g\n", "this baker, ring", ring.time_ms, ring_error);
    std::printf("%-34s %10.2f %12.2g\n", "200 taps a texel, ring", loop.time_ms, loop_error);
    std::printf("sphere: %.0f times faster, error %.0f times smaller; ring: %.0f and %.0f\n",
                loop.time_ms / sphere.time_ms, loop_error / sphere_error, loop.time_ms / ring.time_ms,
                loop_error / ring_error);
    return 0;
}
