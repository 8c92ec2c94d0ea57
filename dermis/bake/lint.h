#pragma once
// Analysis of a table from another tool: what it is, and of a pre-integrated diffuse table the convention
// that explains it best, its error against the exact function, and what to change.
//
// Beckmann, zonal and shadow tables are recognised by marks that no diffuse table has: grey; two or three
// rows; light at p and 1 - p that sums to 1. They are then fitted with an even axis, or none is named.
//
// The search compares every candidate model (construction x profile, and the published taps) with a sample of
// the texels, for each orientation and encoding of the picture; the radius of each row is free at first,
// which needs no guess about the axis. The best few are then fitted with a straight axis in curvature or in
// radius.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/image/image.h"

namespace dermis::inline bake {

/// How stored numbers become light.
enum class StoredAs {
    linear,         ///< light as it is
    srgb,           ///< sRGB-encoded light
    encoded_twice,  ///< sRGB-encoded light that was encoded again by mistake
    decoded_twice,  ///< linear light that was decoded from sRGB by mistake
    difference      ///< 2 (light - max(0, N.L)) + 1/2, FaceWorks
};

/// One explanation of a picture.
struct LintHypothesis {
    Preintegration how = {};
    Integration integration = Integration::exact;
    std::string profile;
    StoredAs stored_as = StoredAs::linear;
    bool transposed = false;                         ///< N.L runs down the picture, not across
    bool n_dot_l_mirrored = false;                   ///< the lit side comes first
    bool bgr = false;                                ///< blue is the picture's first channel
    TexelSampling sampling = TexelSampling::centre;  ///< of N.L
    /// N.L at the outer edges, dark and lit; another range than -1 to 1 is a cropped picture.
    double n_dot_l_min = -1, n_dot_l_max = 1;
    TableAxis axis;  ///< of the other direction, row 0 where v_origin says
    VOrigin v_origin = VOrigin::top;
    double rms = 0, max = 0;  ///< the remaining difference, in light
};

struct LintReport {
    LintHypothesis best;
    /// The best one of another construction or profile.
    LintHypothesis runner_up;
    /// The table, read as `best` says, against the exact sphere of the same profile and axis.
    double error_rms = 0, error_max = 0, error_max_n_dot_l = 0, error_max_radius_mm = 0;
    /// Share of the variance between rows and colours at the same N.L, which scattering causes, that `best`
    /// explains. 0 where nothing differs; below 0 `best` makes it worse.
    double explained_share = 0;
    /// The reason why the picture cannot be a table of skin: flat, negative, grey, ... Empty: it may be one.
    std::string refusal;
    /// The convention of a Beckmann, zonal or shadow table. When it is set, only rms and max of `best` are.
    std::optional<Convention> other;
    /// `best` leaves an rms under 0.01, and nothing refuses the picture.
    bool explained = false;
    std::vector<std::string> findings;  ///< one line each, for the user
    std::vector<std::string> advice;
};

/// Takes about a second, some more where nothing explains the picture. Errors: a picture smaller than 8 x 2
/// texels or without colour. `own`, if any, is the first explanation that is tried; where it holds for N.L
/// from -1 to 1 no picture is refused.
[[nodiscard]] Result<LintReport> lint_table(const Image& image, const LintHypothesis* own = nullptr);

/// Reads the file: a picture, or CSV with a line "n_dot_l,curvature_per_mm,r,g,b" (or radius_mm; numbers in
/// light) for each texel. A convention inside or beside it is the first explanation that is tried; what it
/// and a PNG's sRGB flag say is compared with the numbers. Errors as read_image and above.
[[nodiscard]] Result<LintReport> lint_file(const std::filesystem::path& path);

/// The best explanation as a convention. Errors: nothing explains the picture, or it is refused; a form that
/// no reader here takes (turned by 90 degrees, decoded or encoded twice, blue first).
[[nodiscard]] Result<Convention> convention_of(const LintReport& report);

/// Writes it as FILE.json, so that read_table takes the file; returns that name. Error: also a file that has
/// a convention.
[[nodiscard]] Result<std::filesystem::path> write_sidecar(const std::filesystem::path& path,
                                                          const LintReport& report);

/// "ring from -90 to 90 degrees, GPU Gems 3 ..., sRGB, ..." on one line.
[[nodiscard]] std::string describe(const LintHypothesis& hypothesis);

}  // namespace dermis::inline bake
