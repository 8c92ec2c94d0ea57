#include "dermis/image/metrics.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

Image offset_by(Image image, float offset) {
    for (float& value : image.floats()) value += offset;
    return image;
}

Image constant(int width, int height, Vec3 c) {
    Image image(width, height, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        image.floats()[3 * i] = c.x;
        image.floats()[3 * i + 1] = c.y;
        image.floats()[3 * i + 2] = c.z;
    }
    return image;
}

using Metric = std::function<Result<double>(const Image&, const Image&, const Image&)>;
const std::vector<std::pair<const char*, Metric>> kMetrics = {
    {"max", max_abs_error},
    {"rmse", rmse},
    {"relmse", rel_mse},
    {"psnr", psnr_db},
    {"ssim", ssim},
    {"ciede2000", mean_ciede2000},
    {"flip", [](const Image& a, const Image& b, const Image& m) { return mean_flip(a, b, m, 20); }}};

}  // namespace

TEST(Metrics, equal_images_have_no_error) {
    for (int channels = 1; channels <= 4; ++channels) {
        const Image image = test_pattern(24, 17, channels);
        for (const auto& [name, metric] : kMetrics) {
            const Result<double> error = metric(image, image, {});
            ASSERT_TRUE(error) << name << ": " << error.error().message;
            const std::string_view which = name;
            if (which == "psnr")
                EXPECT_EQ(*error, std::numeric_limits<double>::infinity());
            else
                EXPECT_NEAR(*error, which == "ssim" ? 1 : 0, which == "ssim" ? 1e-6 : 0) << name;
        }
    }
}

TEST(Metrics, a_known_offset_has_the_known_error) {
    const Image reference = constant(16, 8, {0.2f, 0.2f, 0.2f}), image = offset_by(reference, 0.1f);
    EXPECT_NEAR(*max_abs_error(image, reference), 0.1, 1e-6);
    EXPECT_NEAR(*rmse(image, reference), 0.1, 1e-6);
    EXPECT_NEAR(*rel_mse(image, reference), 0.01 / (0.04 + 0.01), 1e-6);
    const double step = srgb_encode(0.3f) - srgb_encode(0.2f);
    EXPECT_NEAR(*psnr_db(image, reference), -20 * std::log10(step), 1e-4);
}

TEST(Metrics, one_wrong_texel_counts_by_its_share) {
    const Image reference = constant(10, 10, {0.5f, 0.5f, 0.5f});
    Image image = reference;
    image.set(3, 4, 1, 0.9f);
    EXPECT_NEAR(*max_abs_error(image, reference), 0.4, 1e-6);
    EXPECT_NEAR(*rmse(image, reference), 0.4 / std::sqrt(300.0), 1e-7);
    EXPECT_NEAR(abs_difference_map(image, reference)->at(3, 4, 0), 0.4f, 1e-6f);
    EXPECT_EQ(abs_difference_map(image, reference)->at(4, 3, 0), 0.0f);
}

TEST(Metrics, a_mask_restricts_every_metric) {
    const Image reference = constant(32, 16, {0.3f, 0.4f, 0.5f});
    Image image = reference, left(32, 16, 1, PixelFormat::u8), right = left;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
            if (x < 16) image.set(x, y, 0, 0.6f);
            (x < 8 ? left : right).set(x, y, 0, x < 8 || x >= 24 ? 1.0f : 0.0f);
        }
    for (const auto& [name, metric] : kMetrics) {
        const double inside = *metric(image, reference, left), outside = *metric(image, reference, right);
        const double best = *metric(reference, reference, {});
        EXPECT_GT(std::abs(inside - best), 0.003) << name;
        // FLIP's filters reach across 7 texels here, SSIM's across 5.
        EXPECT_TRUE(outside == best || std::abs(outside - best) < 1e-5) << name << ' ' << outside;
    }
}

TEST(Metrics, bad_pairs_are_refused_with_the_reason) {
    const Image image = test_pattern(8, 8, 3);
    Image nan = image, infinite = image;
    nan.set(5, 2, 1, std::numeric_limits<float>::quiet_NaN());
    infinite.set(0, 0, 0, HUGE_VALF);
    const Image covers_nothing(8, 8, 1), too_small(4, 8, 1), three_channels(8, 8, 3);
    for (const auto& [name, metric] : kMetrics) {
        EXPECT_NE(metric(nan, image, {}).error().message.find("NaN at texel (5, 2)"), std::string::npos)
            << name;
        EXPECT_NE(metric(image, infinite, {}).error().message.find("reference holds infinity"),
                  std::string::npos);
        EXPECT_FALSE(metric(image, test_pattern(8, 9, 3), {})) << name;
        EXPECT_FALSE(metric(image, test_pattern(8, 8, 4), {})) << name;
        EXPECT_FALSE(metric(Image(), Image(), {})) << name;
        for (const Image& mask : {covers_nothing, too_small, three_channels})
            EXPECT_FALSE(metric(image, image, mask)) << name;
    }
    EXPECT_FALSE(mean_flip(image, image, {}, 0));
    EXPECT_FALSE(mean_flip(image, image, {}, NAN));
}

TEST(Metrics, results_do_not_depend_on_threads_formats_or_alpha) {
    const Image a = test_pattern(50, 40, 3), b = offset_by(a, 0.03f);
    for (const auto& [name, metric] : kMetrics) {
        const double all = *metric(a, b, {});
        set_thread_limit(1);
        EXPECT_EQ(*metric(a, b, {}), all) << name;
        set_thread_limit(0);
    }
    Image a4(50, 40, 4), b4 = a4;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 50; ++x)
            for (int c = 0; c < 4; ++c) {
                a4.set(x, y, c, c < 3 ? a.at(x, y, c) : 0.0f);
                b4.set(x, y, c, c < 3 ? b.at(x, y, c) : 1.0f);
            }
    for (const auto& [name, metric] : kMetrics) EXPECT_EQ(*metric(a4, b4, {}), *metric(a, b, {})) << name;
    const Image code = convert(a, PixelFormat::u8, Encoding::srgb);
    EXPECT_EQ(*rmse(code, to_linear_float(code)), 0);
}

TEST(Ssim, of_two_flat_pictures_is_the_luminance_term) {
    const double a = 0.25, b = 0.75, c1 = 1e-4;
    const auto shown = [](double code) {
        const float linear = srgb_decode(float(code));
        return constant(20, 20, {linear, linear, linear});
    };
    EXPECT_NEAR(*ssim(shown(a), shown(b)), (2 * a * b + c1) / (a * a + b * b + c1), 1e-4);
}

TEST(Ssim, of_a_picture_and_its_negative_is_below_zero) {
    Image a(32, 32, 1), b(32, 32, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            a.set(x, y, 0, srgb_decode((x + y) % 2 ? 0.9f : 0.1f));
            b.set(x, y, 0, srgb_decode((x + y) % 2 ? 0.1f : 0.9f));
        }
    EXPECT_LT(*ssim(a, b), -0.9);
}

// Equations 13 to 16 of Wang et al. 2004 straight from the window, around one texel.
TEST(Ssim, agrees_with_its_definition) {
    Image a(21, 21, 1), b(21, 21, 1);
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 21; ++x) {
            a.set(x, y, 0, srgb_decode(0.5f + 0.4f * std::sin(0.9f * float(x) + 0.2f * float(y))));
            b.set(x, y, 0, srgb_decode(0.45f + 0.3f * std::sin(0.8f * float(x) + 0.3f * float(y))));
        }
    double weight = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (int dy = -5; dy <= 5; ++dy)
        for (int dx = -5; dx <= 5; ++dx) {
            const double w = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
            const double va = srgb_encode(a.at(9 + dx, 11 + dy, 0)),
                         vb = srgb_encode(b.at(9 + dx, 11 + dy, 0));
            weight += w;
            ma += w * va, mb += w * vb;
            aa += w * va * va, bb += w * vb * vb, ab += w * va * vb;
        }
    ma /= weight, mb /= weight;
    const double var_a = aa / weight - ma * ma, var_b = bb / weight - mb * mb, cov = ab / weight - ma * mb;
    const double expected =
        (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (var_a + var_b + 9e-4));
    EXPECT_NEAR(ssim_map(a, b)->at(9, 11, 0), expected, 2e-5);
}

TEST(Ciede2000, agrees_with_the_published_pairs) {
    struct Pair {
        Vec3 a, b;
        double difference;
    };
    // Sharma, Wu and Dalal 2005, table 1.
    const Pair pairs[] = {{{50.0000f, 2.6772f, -79.7751f}, {50.0000f, 0.0000f, -82.7485f}, 2.0425},
                          {{50.0000f, 3.1571f, -77.2803f}, {50.0000f, 0.0000f, -82.7485f}, 2.8615},
                          {{50.0000f, 2.8361f, -74.0200f}, {50.0000f, 0.0000f, -82.7485f}, 3.4412},
                          {{50.0000f, -1.3802f, -84.2814f}, {50.0000f, 0.0000f, -82.7485f}, 1.0000},
                          {{50.0000f, -1.1848f, -84.8006f}, {50.0000f, 0.0000f, -82.7485f}, 1.0000},
                          {{50.0000f, -0.9009f, -85.5211f}, {50.0000f, 0.0000f, -82.7485f}, 1.0000},
                          {{50.0000f, 0.0000f, 0.0000f}, {50.0000f, -1.0000f, 2.0000f}, 2.3669},
                          {{50.0000f, -1.0000f, 2.0000f}, {50.0000f, 0.0000f, 0.0000f}, 2.3669},
                          {{50.0000f, 2.4900f, -0.0010f}, {50.0000f, -2.4900f, 0.0009f}, 7.1792},
                          {{50.0000f, 2.4900f, -0.0010f}, {50.0000f, -2.4900f, 0.0010f}, 7.1792},
                          {{50.0000f, 2.4900f, -0.0010f}, {50.0000f, -2.4900f, 0.0011f}, 7.2195},
                          {{50.0000f, 2.4900f, -0.0010f}, {50.0000f, -2.4900f, 0.0012f}, 7.2195},
                          {{50.0000f, -0.0010f, 2.4900f}, {50.0000f, 0.0009f, -2.4900f}, 4.8045},
                          {{50.0000f, -0.0010f, 2.4900f}, {50.0000f, 0.0010f, -2.4900f}, 4.8045},
                          {{50.0000f, -0.0010f, 2.4900f}, {50.0000f, 0.0011f, -2.4900f}, 4.7461},
                          {{50.0000f, 2.5000f, 0.0000f}, {50.0000f, 0.0000f, -2.5000f}, 4.3065},
                          {{50.0000f, 2.5000f, 0.0000f}, {73.0000f, 25.0000f, -18.0000f}, 27.1492},
                          {{50.0000f, 2.5000f, 0.0000f}, {61.0000f, -5.0000f, 29.0000f}, 22.8977},
                          {{50.0000f, 2.5000f, 0.0000f}, {56.0000f, -27.0000f, -3.0000f}, 31.9030},
                          {{50.0000f, 2.5000f, 0.0000f}, {58.0000f, 24.0000f, 15.0000f}, 19.4535},
                          {{50.0000f, 2.5000f, 0.0000f}, {50.0000f, 3.1736f, 0.5854f}, 1.0000},
                          {{50.0000f, 2.5000f, 0.0000f}, {50.0000f, 3.2972f, 0.0000f}, 1.0000},
                          {{50.0000f, 2.5000f, 0.0000f}, {50.0000f, 1.8634f, 0.5757f}, 1.0000},
                          {{50.0000f, 2.5000f, 0.0000f}, {50.0000f, 3.2592f, 0.3350f}, 1.0000},
                          {{60.2574f, -34.0099f, 36.2677f}, {60.4626f, -34.1751f, 39.4387f}, 1.2644},
                          {{63.0109f, -31.0961f, -5.8663f}, {62.8187f, -29.7946f, -4.0864f}, 1.2630},
                          {{61.2901f, 3.7196f, -5.3901f}, {61.4292f, 2.2480f, -4.9620f}, 1.8731},
                          {{35.0831f, -44.1164f, 3.7933f}, {35.0232f, -40.0716f, 1.5901f}, 1.8645},
                          {{22.7233f, 20.0904f, -46.6940f}, {23.0331f, 14.9730f, -42.5619f}, 2.0373},
                          {{36.4612f, 47.8580f, 18.3852f}, {36.2715f, 50.5065f, 21.2231f}, 1.4146},
                          {{90.8027f, -2.0831f, 1.4410f}, {91.1528f, -1.6435f, 0.0447f}, 1.4441},
                          {{90.9257f, -0.5406f, -0.9208f}, {88.6381f, -0.8985f, -0.7239f}, 1.5381},
                          {{6.7747f, -0.2908f, -2.4247f}, {5.8714f, -0.0985f, -2.2286f}, 0.6377},
                          {{2.0776f, 0.0795f, -1.1350f}, {0.9033f, -0.0636f, -0.5514f}, 0.9082}};
    for (const auto& [a, b, difference] : pairs) {
        EXPECT_NEAR(ciede2000(a, b), difference, 6e-5) << a.x << ' ' << a.y << ' ' << a.z;
        EXPECT_NEAR(ciede2000(b, a), difference, 6e-5) << "the other way round";
    }
}

TEST(Ciede2000, of_pictures_is_that_of_their_colours) {
    const Image a = constant(5, 5, {0.5f, 0.3f, 0.2f}), b = constant(5, 5, {0.45f, 0.32f, 0.2f});
    EXPECT_NEAR(*mean_ciede2000(a, b),
                ciede2000(lab_from_linear({0.5f, 0.3f, 0.2f}), lab_from_linear({0.45f, 0.32f, 0.2f})), 1e-3);
    EXPECT_NEAR(*mean_ciede2000(constant(5, 5, {}), constant(5, 5, {1, 1, 1})), 100, 1e-3);
}
