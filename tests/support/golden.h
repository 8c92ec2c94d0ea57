#pragma once
// Golden pictures: EXPECT_TRUE(matches_golden(picture, "sphere_lambert")) compares a picture with
// tests/golden/sphere_lambert.png. Where it does not match, the new picture, the old one and their difference
// (eight times as bright) are written below the build directory and the message names them.
// DERMIS_UPDATE_GOLDENS=1 writes the new picture over the golden instead, DERMIS_UPDATE_GOLDENS=missing only
// where there is none; look at it before committing it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "dermis/image/io.h"
#include "test_paths.h"

namespace dermis {

/// In 8-bit sRGB codes. Software rendering gives the same bytes from run to run, but not on every type of
/// CPU: rounding moves many texels by a code, and an edge here and there by many.
struct GoldenTolerance {
    double mean_codes = 0.5;
    int outlier_codes = 12;        ///< a channel further off makes its texel an outlier
    double outlier_share = 0.005;  ///< of all texels
};

struct GoldenPlace {
    std::filesystem::path goldens = DERMIS_SOURCE_DIR "/tests/golden";
    std::filesystem::path failures = DERMIS_BINARY_DIR "/golden_failures";
};

namespace golden {

struct Difference {
    double mean_codes = 0, outlier_share = 0;
    Image picture;
};

inline Difference difference_of(const Image& a, const Image& b, int outlier_codes) {
    Difference d{.picture = Image(a.width, a.height, a.channels, PixelFormat::u8, Encoding::srgb)};
    size_t outliers = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            double largest = 0;
            for (int c = 0; c < a.channels; ++c) {
                const double codes = 255.0 * std::abs(a.at(x, y, c) - b.at(x, y, c));
                d.mean_codes += codes;
                largest = std::max(largest, codes);
                d.picture.set(x, y, c, c == alpha_channel(a) ? 1.0f : float(8.0 * codes / 255.0));
            }
            outliers += largest > outlier_codes + 0.5;
        }
    d.mean_codes /= double(a.pixel_count()) * a.channels;
    d.outlier_share = double(outliers) / double(a.pixel_count());
    return d;
}

inline void write_or_say(testing::AssertionResult& result, const std::filesystem::path& path,
                         const Image& image) {
    const Result<void> written = write_image(path, image);
    result << "\n  " << (written ? path.string() : written.error().message);
}

}  // namespace golden

/// `picture` is in any format; it is compared as 8-bit sRGB.
[[nodiscard]] inline testing::AssertionResult matches_golden(const Image& picture, const std::string& name,
                                                             const GoldenTolerance& tolerance = {},
                                                             const GoldenPlace& place = {}) {
    const Image codes = convert(to_linear_float(picture), PixelFormat::u8, Encoding::srgb);
    const std::filesystem::path path = place.goldens / (name + ".png");
    const char* update = std::getenv("DERMIS_UPDATE_GOLDENS");
    const bool rewrites = update && std::string(update) == "1";
    const bool adds = update && std::string(update) == "missing" && !std::filesystem::exists(path);
    if (rewrites || adds) {
        const Result<void> written = write_image(path, codes);
        return written ? testing::AssertionSuccess() : testing::AssertionFailure() << written.error().message;
    }
    auto failure = testing::AssertionFailure() << name << ": ";
    const auto file = [&](const char* what) { return place.failures / (name + "." + what + ".png"); };
    const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) {
        failure << loaded.error().message << "; DERMIS_UPDATE_GOLDENS=1 makes it of this picture:";
        golden::write_or_say(failure, file("new"), codes);
        return failure;
    }
    const Image& old = loaded->image;
    if (old.width != codes.width || old.height != codes.height || old.channels != codes.channels) {
        failure << "the golden picture is " << old.width << "x" << old.height << "x" << old.channels
                << ", the new one " << codes.width << "x" << codes.height << "x" << codes.channels;
        golden::write_or_say(failure, file("new"), codes);
        return failure;
    }
    const golden::Difference difference = golden::difference_of(codes, old, tolerance.outlier_codes);
    if (difference.mean_codes <= tolerance.mean_codes && difference.outlier_share <= tolerance.outlier_share)
        return testing::AssertionSuccess();
    failure << "off by " << difference.mean_codes << " codes on average (at most " << tolerance.mean_codes
            << "), " << 100 * difference.outlier_share << " % of the texels by more than "
            << tolerance.outlier_codes << " (at most " << 100 * tolerance.outlier_share << " %); see";
    golden::write_or_say(failure, file("new"), codes);
    golden::write_or_say(failure, file("old"), old);
    golden::write_or_say(failure, file("difference"), difference.picture);
    return failure;
}

}  // namespace dermis
