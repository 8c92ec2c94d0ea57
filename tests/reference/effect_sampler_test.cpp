// The effect of scattering, sampled alone, against pictures with and without scattering.

#include "dermis/reference/effect_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reference/shapes.h"

namespace dermis {
namespace {

constexpr int kEffectSide = 12, kEffectGrid = 3, kEffectCells = kEffectGrid * kEffectGrid;

// With a terminator through its middle, where light has a penumbra.
Scene small_sphere() {
    Scene scene;
    scene.objects.push_back({.name = "sphere", .mesh = test::sphere(4, 4), .classes = {MaterialClass::skin}});
    scene.lights.push_back(
        {.intensity = 3, .to_light_world = normalize(Vec3{1, 0.5f, 0.3f}), .is_key = true});
    scene.camera = {.eye_mm = {0, 0, 32}, .vertical_fov_rad = 0.25f, .near_mm = 1, .far_mm = 80};
    scene.environment.kind = EnvironmentKind::none;
    return scene;
}

ReferenceSettings effect_settings(Integrator integrator, uint32_t seed = 1) {
    ReferenceSettings settings{.integrator = integrator,
                               .width = kEffectSide,
                               .height = kEffectSide,
                               .samples = kEffectCells,
                               .seed = seed,
                               .probes = integrator == Integrator::surface ? 16 : 4,
                               .filter = PixelFilter::grid,
                               .grid = kEffectGrid,
                               .entry = LightEntry::all};
    settings.lighting = {.ambient = AmbientModel::renderer, .specular = SpecularReflection::none};
    settings.lighting.penumbra_mm = 2;
    return settings;
}

EffectSamples samples_of(const Scene& scene, const ReferenceSettings& settings,
                         std::initializer_list<uint32_t> steps) {
    auto sampler = EffectSampler::create(scene, settings);
    EXPECT_TRUE(sampler) << sampler.error().message;
    EffectSamples samples(settings.width, settings.height);
    for (const uint32_t count : steps)
        EXPECT_TRUE(sampler->raise(std::vector<uint32_t>(samples.counts.size(), count), samples));
    return samples;
}

// Weights that no symmetry of the scene makes vanish.
double pattern(const Image& image, size_t channel, int which) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += image.at(x, y, int(channel)) * (which == 0    ? 1
                                                   : which == 1  ? x - 3
                                                   : (x + y) % 2 ? 1
                                                                 : -1);
    return sum;
}

struct Moments {
    double sum = 0, squares = 0;
    int count = 0;
    void add(double value) { sum += value, squares += value * value, ++count; }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double variance_of_mean() const {
        return (squares - sum * sum / count) / (count - 1.0) / count;
    }
};

}  // namespace

// A part of a round over the cells, by the effect alone, against whole rounds of both pictures.
TEST(EffectSampler, has_the_mean_of_the_pictures_with_and_without_scattering) {
    const Scene scene = small_sphere();
    for (const Integrator integrator : {Integrator::surface, Integrator::walk}) {
        Moments alone[9], pictures[9];
        for (uint32_t seed = 1; seed <= 40; ++seed) {
            ReferenceSettings settings = effect_settings(integrator, seed);
            const EffectSamples samples = samples_of(scene, settings, {4});
            const auto with = render_reference(scene, settings);
            settings.integrator = Integrator::lambert;
            const auto without = render_reference(scene, settings);
            ASSERT_TRUE(with && without);
            for (int i = 0; i < 9; ++i) {
                const size_t channel = size_t(i) % 3;
                alone[i].add(pattern(samples.a, channel, i / 3));
                alone[i].add(pattern(samples.b, channel, i / 3));
                pictures[i].add(pattern(with->diffuse, channel, i / 3) -
                                pattern(without->diffuse, channel, i / 3));
            }
        }
        for (int i = 0; i < 9; ++i) {
            const double error = std::sqrt(alone[i].variance_of_mean() + pictures[i].variance_of_mean());
            EXPECT_LT(std::abs(alone[i].mean() - pictures[i].mean()), 3.5 * error)
                << int(integrator) << ", " << i << ": " << alone[i].mean() << ", " << pictures[i].mean();
            if (i == 3) EXPECT_LT(error, 0.1 * std::abs(pictures[3].mean())) << "the test can tell";
        }
    }
}

TEST(EffectSampler, steps_add_up_and_a_pixel_keeps_what_it_has) {
    const Scene scene = small_sphere();
    const ReferenceSettings settings = effect_settings(Integrator::surface);
    const EffectSamples once = samples_of(scene, settings, {11}),
                        steps = samples_of(scene, settings, {2, 3, 11, 5});
    EXPECT_EQ(once.counts, steps.counts);
    EXPECT_EQ(steps.counts.front(), 11u);
    double largest = 0;
    for (size_t i = 0; i < once.a.floats().size(); ++i)
        largest = std::max<double>(largest, std::abs(once.a.floats()[i] - steps.a.floats()[i]));
    EXPECT_LT(largest, 1e-6);
    EXPECT_NE(once.a.bytes, once.b.bytes);
}

TEST(EffectSampler, stopped_it_keeps_whole_rows_and_says_so) {
    const Scene scene = small_sphere();
    const ReferenceSettings settings = effect_settings(Integrator::surface);
    const auto sampler = EffectSampler::create(scene, settings);
    ASSERT_TRUE(sampler);
    EffectSamples samples(settings.width, settings.height);
    std::atomic<bool> stop = false;
    const std::vector<uint32_t> counts(samples.counts.size(), 2);
    EXPECT_FALSE(sampler->raise(
        counts, samples, [&](double) { stop = true; }, &stop));
    for (size_t row = 0; row < size_t(kEffectSide); ++row)
        for (size_t x = 1; x < size_t(kEffectSide); ++x)
            EXPECT_EQ(samples.counts[row * kEffectSide + x], samples.counts[row * kEffectSide]);
    stop = false;
    EXPECT_TRUE(sampler->raise(counts, samples, {}, &stop));
    const EffectSamples once = samples_of(scene, settings, {2});
    EXPECT_EQ(once.a.bytes, samples.a.bytes);
    EXPECT_EQ(once.b.bytes, samples.b.bytes);
}

}  // namespace dermis
