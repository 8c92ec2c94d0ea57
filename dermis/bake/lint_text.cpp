// The linter's numbers as advice.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dermis/bake/lint_model.h"

namespace dermis::inline bake {
namespace {

// A fit ends within this share of the axis's length of the number that was meant.
constexpr double kFitted = 0.004;

constexpr const char* kBakeAdvice = "bake a table with a known convention: dermis bake lut -o skin.exr";

// Digits until what is missing to all of it shows, down to a hundredth of a percent.
std::string share_explained_text(double share) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.4g", 100 * std::clamp(share, 0.0, 0.9999));
    return std::string(share > 0.9999 ? "more than " : "") + percent +
           " % of how its rows and colours differ is explained";
}

std::string construction_text(const LintHypothesis& h) {
    if (h.integration == Integration::unity_taps)
        return "ring by taps of 0.05 rad from -90 to 90 degrees (Unity, 2011)";
    if (h.integration == Integration::faceworks_taps) return "ring by 200 taps of arc length (FaceWorks)";
    std::string text = h.how.construction == Construction::sphere      ? "sphere"
                       : h.how.construction == Construction::full_ring ? "full ring"
                                                                       : "ring from -90 to 90 degrees";
    if (h.how.construction != Construction::sphere && h.how.ring_weights == RingWeights::area)
        text += " with Gaussians normalised by area";
    return text;
}

std::string stored_text(StoredAs stored_as) {
    switch (stored_as) {
        case StoredAs::linear:
            return "linear numbers";
        case StoredAs::srgb:
            return "sRGB-encoded numbers";
        case StoredAs::encoded_twice:
            return "numbers that were sRGB-encoded twice";
        case StoredAs::decoded_twice:
            return "linear numbers that were decoded from sRGB by mistake";
        case StoredAs::difference:
            return "differences from max(0, N.L), FaceWorks' encoding";
    }
    return {};
}

std::string axis_text(const TableAxis& axis) {
    const double min = lint::without_noise(axis.min, axis), max = lint::without_noise(axis.max, axis);
    return axis.name + " " + lint::rounded(min) + " to " + lint::rounded(max) +
           (axis.warp == AxisWarp::squared ? ", squared" : "");
}

std::string sampling_text(TexelSampling sampling) {
    return sampling == TexelSampling::low_edge    ? " (texel i at i/n)"
           : sampling == TexelSampling::high_edge ? " (texel i at (i+1)/n)"
                                                  : "";
}

TableAxis scaled_axis(TableAxis axis, double factor) {
    axis.min *= factor;
    axis.max *= factor;
    return axis;
}

bool is_cropped(const LintHypothesis& h) {
    return h.n_dot_l_min > -1 || h.n_dot_l_max < 1;
}

// "(VALUE - MIN) / LENGTH" without what is 0 or 1; a mirrored axis is "(MIN - VALUE) / LENGTH".
std::string share_text(const std::string& value, double min, double max) {
    const double length = std::abs(max - min);
    std::string text = value;
    if (max < min)
        text = "(" + lint::rounded(min) + " - " + value + ")";
    else if (min != 0)
        text = "(" + value + (min > 0 ? " - " : " + ") + lint::rounded(std::abs(min)) + ")";
    return length == 1 ? text : text + " / " + lint::rounded(length);
}

// The offset of a lookup at which the filter finds the texels where they were evaluated.
std::string offset_text(TexelSampling sampling, bool mirrored, int texels) {
    if (sampling == TexelSampling::centre) return {};
    const bool add = (sampling == TexelSampling::low_edge) != mirrored;
    return std::string(add ? " + " : " - ") + "0.5 / " + std::to_string(texels);
}

// Texture coordinates of a lookup, (0, 0) being the first texel of the file.
std::string lookup_text(const LintHypothesis& h, int columns, int rows) {
    std::string cosine = h.n_dot_l_mirrored ? "0.5 - 0.5 * n_dot_l" : "0.5 + 0.5 * n_dot_l";
    if (is_cropped(h))
        cosine = h.n_dot_l_mirrored ? share_text("n_dot_l", h.n_dot_l_max, h.n_dot_l_min)
                                    : share_text("n_dot_l", h.n_dot_l_min, h.n_dot_l_max);
    cosine += offset_text(h.sampling, h.n_dot_l_mirrored, columns);
    const bool bottom = h.v_origin == VOrigin::bottom;
    std::string other = share_text(h.axis.name, lint::without_noise(h.axis.min, h.axis),
                                   lint::without_noise(h.axis.max, h.axis));
    if (h.axis.warp == AxisWarp::squared) other = "sqrt(" + other + ")";
    other = (bottom ? "1 - " : "") + other + offset_text(h.axis.sampling, bottom, rows);
    return h.transposed ? "vec2(" + other + ", " + cosine + ")" : "vec2(" + cosine + ", " + other + ")";
}

std::string rebake_text(const LintHypothesis& h, int columns, int rows) {
    const bool radius = h.axis.name == "radius_mm";
    const double min = lint::without_noise(h.axis.min, h.axis), max = lint::without_noise(h.axis.max, h.axis);
    const double low = std::max(radius ? 0.001 : 0.0, std::min(min, max));
    return "dermis bake lut --profile " + h.profile + " --axis " + (radius ? "radius" : "curvature") +
           " --range " + lint::rounded(low) + "," + lint::rounded(std::max(min, max)) + " --size " +
           std::to_string(columns) + "x" + std::to_string(rows) +
           (h.axis.warp == AxisWarp::squared ? " --warp squared" : "") + " -o better.exr";
}

// All but the rows.
std::string describe_columns(const LintHypothesis& h) {
    std::string text = construction_text(h) + ", profile " + h.profile + ", " + stored_text(h.stored_as);
    if (h.bgr) text += ", blue first";
    const std::string dark = lint::rounded(h.n_dot_l_min), lit = lint::rounded(h.n_dot_l_max);
    return text + ", N.L " + (h.n_dot_l_mirrored ? lit + " to " + dark : dark + " to " + lit) +
           (h.transposed ? " down" : " across") + sampling_text(h.sampling);
}

// Parts of the function that the picture does not have.
void find_crops(LintReport& report) {
    constexpr double kLargestFlatRadius_mm = 20;
    const LintHypothesis& h = report.best;
    if (is_cropped(h))
        report.findings.push_back("cropped: it has N.L from " + lint::rounded(h.n_dot_l_min) + " to " +
                                  lint::rounded(h.n_dot_l_max) +
                                  " only; scattering lights what N.L from -1 to 0 sees");
    const double a = h.axis.min, b = h.axis.max;
    const double largest_mm =
        h.axis.name == "radius_mm" ? std::max(a, b) : 1 / std::max(1e-6, std::min(a, b));
    if (largest_mm < kLargestFlatRadius_mm)
        report.findings.push_back("cropped: nothing in it is flatter than a radius of " +
                                  lint::rounded(largest_mm) + " mm; most of a head is");
}

void advise_on_storage(LintReport& report, const Image& image) {
    switch (report.best.stored_as) {
        case StoredAs::linear:
            report.advice.push_back("sample it as data: no sRGB flag, no colour management");
            if (image.format == PixelFormat::u8)
                report.findings.push_back(
                    "8-bit linear numbers: the dark side has steps of 0.004, visible as bands");
            break;
        case StoredAs::srgb:
            report.advice.push_back(
                "sample it as an sRGB texture (or decode it in the shader), never as data");
            break;
        case StoredAs::encoded_twice:
            report.findings.push_back("encoded twice: an sRGB texture of it is brighter than the light");
            report.advice.push_back("encode it once: light = srgb_decode(srgb_decode(texel))");
            break;
        case StoredAs::decoded_twice:
            report.findings.push_back("decoded twice: the light in it is darker than it was");
            report.advice.push_back(
                "import it without sRGB decoding, or encode it once: light = srgb_encode(texel)");
            break;
        case StoredAs::difference:
            report.advice.push_back("sample it as data; light = (texel - 0.5) / 2 + max(0, N.L)");
            break;
    }
}

void advise_on_construction(LintReport& report, int columns, int rows) {
    const LintHypothesis& best = report.best;
    const double scale = best.how.variance_scale;
    if (scale != 1)
        report.findings.push_back("all variances x " + lint::rounded(scale) +
                                  ": without the factor it would be " +
                                  axis_text(scaled_axis(best.axis, std::sqrt(scale))));
    else if (best.how.construction == Construction::half_ring && best.axis.name == "curvature_per_mm")
        report.findings.push_back("the same as " + axis_text(scaled_axis(best.axis, 1 / std::sqrt(1.414))) +
                                  " with all variances x 1.414, as in widely copied code");
    if (report.error_max < 0.01) {
        report.advice.push_back("no change: it is the exact table within " + lint::rounded(report.error_max));
        return;
    }
    if (best.how.construction != Construction::sphere)
        report.advice.push_back(
            "a ring is not a closed surface and does not conserve energy where it is strongly curved; use "
            "the sphere");
    report.advice.push_back("bake the exact table over the same axis: " + rebake_text(best, columns, rows));
}

}  // namespace

std::string lint::rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", std::abs(value) < 1e-12 ? 0.0 : value);
    return text;
}

double lint::without_noise(double value, const TableAxis& axis) {
    const double noise = kFitted * std::abs(axis.max - axis.min);
    if (std::abs(value) < noise) return 0;
    const double power = std::floor(std::log10(std::abs(value)));
    for (int digits = 0; digits < 6; ++digits) {
        const double unit = std::pow(10, power - digits), fewer = std::round(value / unit) * unit;
        if (std::abs(fewer - value) < noise) return fewer;
    }
    return value;
}

std::string describe(const LintHypothesis& h) {
    const char* way = h.v_origin == VOrigin::bottom ? (h.transposed ? " to the left" : " up")
                                                    : (h.transposed ? " across" : " down");
    return describe_columns(h) + ", " + axis_text(h.axis) + way + sampling_text(h.axis.sampling);
}

bool lint::explain_rows(LintReport& report, const Search& found, const Image& image) {
    constexpr double kEven = 0.0025;  // 8 bits and published taps leave 0.002
    constexpr size_t kNamedRows = 6;
    const LintHypothesis& free = found.free;
    if (report.best.rms < kEven || free.rms > kEven || report.best.rms < 2 * free.rms) return false;
    report.explained = false;
    const std::vector<double>& radii_mm = found.free_radii_mm;
    double least = radii_mm[0];
    std::string curvatures;
    for (size_t i = 0; i < radii_mm.size(); ++i) {
        least = std::min(least, radii_mm[i]);
        const size_t step = std::max<size_t>(1, (radii_mm.size() - 1) / (kNamedRows - 1));
        if (i % step == 0) curvatures += (i ? ", " : "") + rounded(1 / radii_mm[i]);
    }
    report.findings.push_back("explained best by: " + describe_columns(free) + "; rms " + rounded(free.rms) +
                              " with a curvature of its own for each row");
    report.findings.push_back("its rows are even neither in curvature or radius nor in the root of one: " +
                              axis_text(report.best.axis) + " leaves rms " + rounded(report.best.rms) +
                              ". Curvatures from the first row to the last: " + curvatures + " per mm");
    LintHypothesis even = free;
    even.axis = {.name = "curvature_per_mm", .unit = "1/mm", .min = 0, .max = 1 / least};
    report.advice.push_back("no reader here takes such rows; bake an even table over them: " +
                            rebake_text(even, free.transposed ? image.height : image.width,
                                        free.transposed ? image.width : image.height));
    return true;
}

void lint::explain_refusal(LintReport& report) {
    report.explained = false;
    report.findings.push_back("no table of skin: " + report.refusal);
    report.advice.push_back(kBakeAdvice);
}

void lint::explain(LintReport& report, const Image& image) {
    report.findings.push_back("explained best by: " + describe(report.best));
    report.findings.push_back("it leaves an error of rms " + rounded(report.best.rms) + ", largest " +
                              rounded(report.best.max) + "; " + share_explained_text(report.explained_share));
    report.findings.push_back(
        "next best: " + describe(report.runner_up) + " (rms " + rounded(report.runner_up.rms) +
        (is_as_good(report.runner_up.rms, report.best.rms) ? "; these numbers do not tell it from the best)"
                                                           : ")"));
    if (!report.explained) {
        report.findings.push_back(
            "no good match (rms above 0.01): not a pre-integrated table of a known profile, or one that was "
            "edited");
        report.advice.push_back(kBakeAdvice);
        return;
    }
    report.findings.push_back("against the exact sphere of that profile: rms " + rounded(report.error_rms) +
                              ", largest " + rounded(report.error_max) + " at N.L " +
                              rounded(report.error_max_n_dot_l) + ", r " +
                              rounded(report.error_max_radius_mm) + " mm");
    const LintHypothesis& best = report.best;
    const int columns = best.transposed ? image.height : image.width,
              rows = best.transposed ? image.width : image.height;
    if (best.bgr) {
        report.findings.push_back("blue first (BGR): red scatters farthest in skin, here it is blue");
        report.advice.push_back("swap red and blue");
    }
    find_crops(report);
    advise_on_storage(report, image);
    report.advice.push_back("look it up at " + lookup_text(best, columns, rows) +
                            ", lengths in mm, first row of the file at 0");
    advise_on_construction(report, columns, rows);
}

}  // namespace dermis::inline bake
