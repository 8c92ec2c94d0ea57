// The linter's numbers as advice.

#include <cmath>
#include <cstdio>

#include "dermis/bake/lint_model.h"

namespace dermis {
namespace {

std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", std::abs(value) < 1e-12 ? 0.0 : value);
    return text;
}

std::string construction_text(const LintHypothesis& h) {
    if (h.integration == Integration::unity_taps)
        return "ring by taps of 0.05 rad from -90 to 90 degrees (Unity, 2011)";
    if (h.integration == Integration::faceworks_taps) return "ring by 200 taps of arc length (FaceWorks)";
    std::string text = h.how.construction == Construction::sphere ? "sphere"
                       : h.how.construction == Construction::ring ? "full ring"
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
        case StoredAs::decoded_twice:
            return "linear numbers that were decoded from sRGB by mistake";
        case StoredAs::difference:
            return "differences from max(0, N.L), FaceWorks' encoding";
    }
    return {};
}

// A value that differs from zero by less than the fit's uncertainty is zero.
double snapped(double value, const TableAxis& axis) {
    return std::abs(value) < 0.004 * std::abs(axis.max - axis.min) ? 0 : value;
}

std::string axis_text(const TableAxis& axis) {
    return axis.name + " " + rounded(snapped(axis.min, axis)) + " to " + rounded(snapped(axis.max, axis));
}

TableAxis scaled_axis(TableAxis axis, double factor) {
    axis.min *= factor;
    axis.max *= factor;
    return axis;
}

// Texture coordinates of a lookup, (0, 0) being the first texel of the file.
std::string lookup_text(const LintHypothesis& h) {
    std::string cosine = h.n_dot_l_mirrored ? "0.5 - 0.5 * n_dot_l" : "0.5 + 0.5 * n_dot_l";
    const double first = snapped(h.axis.min, h.axis), length = std::abs(h.axis.max - h.axis.min);
    std::string other = h.axis.name;
    if (h.axis.max < h.axis.min)
        other = "(" + rounded(first) + " - " + other + ")";
    else if (first != 0)
        other = "(" + other + (first > 0 ? " - " : " + ") + rounded(std::abs(first)) + ")";
    other += " / " + rounded(length);
    return h.transposed ? "vec2(" + other + ", " + cosine + ")" : "vec2(" + cosine + ", " + other + ")";
}

std::string rebake_text(const LintHypothesis& h, const Image& image) {
    const bool radius = h.axis.name == "radius_mm";
    const double low = std::max(radius ? 0.001 : 0.0, snapped(std::min(h.axis.min, h.axis.max), h.axis));
    const int columns = h.transposed ? image.height : image.width,
              rows = h.transposed ? image.width : image.height;
    return "dermis bake lut --profile " + h.profile + " --axis " + (radius ? "radius" : "curvature") +
           " --range " + rounded(low) + "," + rounded(std::max(h.axis.min, h.axis.max)) + " --size " +
           std::to_string(columns) + "x" + std::to_string(rows) + " -o better.exr";
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
        case StoredAs::decoded_twice:
            report.advice.push_back(
                "import it without sRGB decoding, or encode it once: light = srgb_encode(texel)");
            break;
        case StoredAs::difference:
            report.advice.push_back("sample it as data; light = (texel - 0.5) / 2 + max(0, N.L)");
            break;
    }
}

void advise_on_construction(LintReport& report, const Image& image) {
    const LintHypothesis& best = report.best;
    if (best.how.construction == Construction::half_ring && best.axis.name == "curvature_per_mm")
        report.findings.push_back("the same as " + axis_text(scaled_axis(best.axis, 1 / std::sqrt(1.414))) +
                                  " with all variances x 1.414, as in widely copied code");
    if (report.error_max < 0.01) {
        report.advice.push_back("no change: it is the exact table within " + rounded(report.error_max));
        return;
    }
    if (best.how.construction != Construction::sphere)
        report.advice.push_back(
            "a ring is not a closed surface and does not conserve energy where it is strongly curved; use "
            "the sphere");
    report.advice.push_back("bake the exact table over the same axis: " + rebake_text(best, image));
}

}  // namespace

std::string describe(const LintHypothesis& h) {
    std::string text = construction_text(h) + ", profile " + h.profile + ", " + stored_text(h.stored_as) +
                       ", N.L " + (h.n_dot_l_mirrored ? "1 to -1 " : "-1 to 1 ") +
                       (h.transposed ? "down" : "across");
    if (h.sampling == TexelSampling::low_edge) text += " (texel i at i/n)";
    return text + ", " + axis_text(h.axis) + (h.transposed ? " across" : " down");
}

void lint::explain(LintReport& report, const Image& image) {
    report.findings.push_back("explained best by: " + describe(report.best));
    report.findings.push_back("it leaves an error of rms " + rounded(report.best.rms) + ", largest " +
                              rounded(report.best.max));
    report.findings.push_back("next best: " + describe(report.runner_up) + " (rms " +
                              rounded(report.runner_up.rms) + ")");
    if (!report.explained) {
        report.findings.push_back(
            "no good match (rms above 0.01): not a pre-integrated table of a known profile, or one that was "
            "edited");
        report.advice.push_back("bake a table with a known convention: dermis bake lut -o skin.exr");
        return;
    }
    report.findings.push_back("against the exact sphere of that profile: rms " + rounded(report.error_rms) +
                              ", largest " + rounded(report.error_max) + " at N.L " +
                              rounded(report.error_max_n_dot_l) + ", r " +
                              rounded(report.error_max_radius_mm) + " mm");
    advise_on_storage(report, image);
    report.advice.push_back("look it up at " + lookup_text(report.best) +
                            ", lengths in mm, first row of the file at 0");
    advise_on_construction(report, image);
}

}  // namespace dermis
