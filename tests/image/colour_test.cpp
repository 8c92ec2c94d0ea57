#include "dermis/image/colour.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

using namespace dermis;

namespace {

using Chromaticity = Eigen::Vector2d;

Eigen::Vector3d xyz_of(Chromaticity c) {
    return {c.x() / c.y(), 1.0, (1.0 - c.x() - c.y()) / c.y()};
}

// RGB to XYZ from primaries and white: SMPTE RP 177-1993, equations 3.3.1 to 3.3.6.
Eigen::Matrix3d xyz_from_rgb(Chromaticity red, Chromaticity green, Chromaticity blue, Chromaticity white) {
    Eigen::Matrix3d primaries;
    primaries << xyz_of(red), xyz_of(green), xyz_of(blue);
    const Eigen::Vector3d scale = primaries.inverse() * xyz_of(white);
    return primaries * scale.asDiagonal();
}

const Chromaticity kD65(0.3127, 0.3290), kD60(0.32168, 0.33767);

Eigen::Matrix3d srgb() {
    return xyz_from_rgb({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65);
}

void expect_matrix(const Mat3& actual, const Eigen::Matrix3d& expected) {
    for (int r = 0; r < 3; ++r) {
        EXPECT_NEAR(actual.row[r].x, expected(r, 0), 2e-6);
        EXPECT_NEAR(actual.row[r].y, expected(r, 1), 2e-6);
        EXPECT_NEAR(actual.row[r].z, expected(r, 2), 2e-6);
    }
}

}  // namespace

TEST(Colour, srgb_has_its_published_values_and_inverts) {
    EXPECT_FLOAT_EQ(srgb_decode(0.5f), 0.21404114f);
    EXPECT_FLOAT_EQ(srgb_decode(0.04f), 0.04f / 12.92f);
    EXPECT_FLOAT_EQ(srgb_encode(1.0f), 1.0f);
    for (float x = -0.5f; x < 4.0f; x += 0.01f) EXPECT_NEAR(srgb_decode(srgb_encode(x)), x, 2e-6f * (1 + x));
}

TEST(Colour, xyz_follows_from_the_primaries_of_bt709) {
    expect_matrix(kXyzFromLinear, srgb());
    expect_matrix(kLinearFromXyz, srgb().inverse());
}

TEST(Colour, acescg_follows_from_its_primaries_and_the_bradford_adaptation) {
    const Eigen::Matrix3d aces = xyz_from_rgb({0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, kD60);
    Eigen::Matrix3d bradford;
    bradford << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
    const Eigen::Vector3d to = bradford * xyz_of(kD65), from = bradford * xyz_of(kD60);
    const Eigen::Matrix3d adapt = bradford.inverse() * to.cwiseQuotient(from).asDiagonal() * bradford;
    expect_matrix(kLinearFromAcesCg, srgb().inverse() * adapt * aces);
}

TEST(Colour, lab_of_white_grey_and_red) {
    const Vec3 white = lab_from_linear({1, 1, 1});
    EXPECT_NEAR(white.x, 100, 1e-3);
    EXPECT_NEAR(white.y, 0, 1e-3);
    EXPECT_NEAR(white.z, 0, 1e-3);
    EXPECT_NEAR(lab_from_linear({0.18418651f, 0.18418651f, 0.18418651f}).x, 50, 1e-3);
    const Vec3 red = lab_from_linear({1, 0, 0});
    EXPECT_NEAR(red.x, 53.24, 0.02);
    EXPECT_NEAR(red.y, 80.09, 0.05);
    EXPECT_NEAR(red.z, 67.20, 0.05);
    EXPECT_NEAR(lab_from_linear({1e-4f, 1e-4f, 1e-4f}).x, 0.0903, 1e-3);
}

TEST(Colour, luminance_is_the_y_of_xyz) {
    const Vec3 c = {0.2f, 0.5f, 0.9f};
    EXPECT_NEAR(luminance(c), (kXyzFromLinear * c).y, 1e-4);
}
