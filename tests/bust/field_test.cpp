#include <gtest/gtest.h>

#include <cmath>

#include "bust/standard_bust.h"

namespace dermis {
namespace {

using bust::Point;

/// Where a ray from far outside first meets the surface; the distance is only first-order, so steps are
/// cautious.
Point first_hit(const BustField& field, Point from, Point direction) {
    for (double t = 0; t < 600;) {
        const Point p = from + direction * t;
        const double d = field.distance_mm(p);
        if (d < 1e-3) return p;
        t += std::max(0.3 * std::min(d, 20.0), 5e-4);
    }
    return {NAN, NAN, NAN};
}

TEST(BustField, HasTheProportionsOfAnAverageAdult) {
    const BustField field{BustParams{.asymmetry = 0}};
    const double crown = first_hit(field, {0, 300, 5}, {0, -1, 0}).y;
    const double chin = first_hit(field, {0, -86, 300}, {0, 0, -1}).z;
    EXPECT_GT(chin, 90);                                            // there is a chin at that height ...
    EXPECT_LT(first_hit(field, {0, -100, 300}, {0, 0, -1}).z, 70);  // ... and none below it
    EXPECT_NEAR(crown + 93, 230, 6);                                // crown to the underside of the chin
    const double breadth = 2 * first_hit(field, {300, 45, -5}, {-1, 0, 0}).x;
    EXPECT_NEAR(breadth, 155, 5);
    const double brow = first_hit(field, {0, 47, 300}, {0, 0, -1}).z,
                 nape = first_hit(field, {0, 45, -300}, {0, 0, 1}).z;
    EXPECT_NEAR(brow - nape, 195, 6);
    // The tip of the nose lies 15 mm in front of its base.
    const double tip = first_hit(field, {0, -9, 300}, {0, 0, -1}).z,
                 base = first_hit(field, {0, -24, 300}, {0, 0, -1}).z;
    EXPECT_NEAR(tip, 130, 3);
    EXPECT_NEAR(tip - base, 15, 4);
}

TEST(BustField, EarIsAsLongAsAskedAndThin) {
    for (const double length_mm : {55.0, 63.0, 72.0}) {
        const BustField field{BustParams{.ear_length_mm = length_mm, .asymmetry = 0}};
        // Along the ear from its middle, through the plate's thickness, until the skin ends: up to the helix,
        // down to the lobe.
        const auto end = [&](double back, double v, double step) {
            for (;; v += step) {
                double nearest = 1e9;
                for (double out = v > 0 ? -1.5 : -6; out <= 3; out += 0.5)
                    nearest = std::min(nearest, field.distance_mm(field.ear().to_head({back, v, out})));
                if (nearest > 0 || std::abs(v) > 60) return v * length_mm / 63;
            }
        };
        const double top = end(12, 20, 0.25), bottom = end(4, -20, -0.25);
        EXPECT_NEAR(top - bottom, length_mm, 4);
        const Point rim = field.ear().to_head({25, 9, 12});
        const Point inward = bust::unit(field.ear().to_head({25, 9, -12}) - rim);
        const Point front = first_hit(field, rim, inward);
        const double thickness = field.thickness_mm(field.project(front, 3), 20);
        EXPECT_GT(thickness, 2.5 * length_mm / 63);
        EXPECT_LT(thickness, 7.5 * length_mm / 63);
    }
}

TEST(BustField, HeadWidthAndJawWidthAreMeasuredOnTheHead) {
    for (const double width_mm : {142.0, 155.0, 170.0}) {
        const BustField field{BustParams{.head_width_mm = width_mm, .asymmetry = 0}};
        EXPECT_NEAR(2 * first_hit(field, {300, 50, -5}, {-1, 0, 0}).x, width_mm, 5);
    }
    const auto jaw = [](double width_mm) {
        const BustField field{BustParams{.jaw_width_mm = width_mm, .asymmetry = 0}};
        return 2 * first_hit(field, {300, -52, 25}, {-1, 0, 0}).x;
    };
    EXPECT_NEAR(jaw(125) / jaw(112), 125.0 / 112, 0.03);
}

TEST(BustField, IsSymmetricWithoutAsymmetryAndWithinTwoMillimetresWithIt) {
    const BustField even{BustParams{.asymmetry = 0}}, natural{BustParams{}};
    double most_mm = 0;
    for (int i = 0; i < 200; ++i) {
        const Point p = {10 + 0.4 * i, -90 + 0.9 * i, 60};
        EXPECT_NEAR(even.distance_mm(p), even.distance_mm(bust::mirrored(p)), 1e-9);
        most_mm =
            std::max(most_mm, std::abs(natural.distance_mm(p) - natural.distance_mm(bust::mirrored(p))));
    }
    EXPECT_GT(most_mm, 0.3);
    EXPECT_LT(most_mm, 6);  // two such shifts, on slopes
}

TEST(BustField, CurvatureOfTheSmoothCrownIsThatOfASphereOfItsSize) {
    const BustField& field = standard_field();
    const Point crown = field.project({10, 130, -20}, 6);
    const double curvature = field.mean_curvature_per_mm(crown, 0.5);
    EXPECT_GT(curvature, 1.0 / 130);
    EXPECT_LT(curvature, 1.0 / 60);
}

TEST(BustField, StepOfTheCurvatureStencilHardlyMattersOnSmoothSkin) {
    const BustField& field = standard_field();
    for (const Point at : {Point{0, 90, 90}, Point{60, 20, 60}, Point{0, -40, -60}}) {
        const Point p = field.project(at, 8);
        EXPECT_NEAR(field.mean_curvature_per_mm(p, 0.1), field.mean_curvature_per_mm(p, 0.4), 2e-3);
    }
}

}  // namespace
}  // namespace dermis
