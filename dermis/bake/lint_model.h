#pragma once
// Internal to the linter: candidate curves and how well texels agree with them.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/bake/lint.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake::lint {

/// A sample of the picture, turned so that columns are N.L (in the picture's direction) and rows the other
/// axis.
struct Sample {
    std::vector<double> u, v;  ///< texel index + 1/2 over the count, ascending
    int u_count = 0, v_count = 0;
    std::vector<float> stored;  ///< [row][column][channel]

    [[nodiscard]] std::span<const float> row(size_t y) const {
        return std::span(stored).subspan(3 * u.size() * y, 3 * u.size());
    }
};
[[nodiscard]] Sample sample_of(const Image& linear_float, bool transposed);

/// N.L of the sample's columns under a hypothesis.
[[nodiscard]] std::vector<double> n_dot_l_of(const Sample& sample, const LintHypothesis& hypothesis);

/// The straight line nearest to (s, value), each point with its weight; at_1 is its value at s = 1.
struct Line {
    double at_0 = 0, at_1 = 0;
};
[[nodiscard]] Line straight_line(std::span<const double> s, std::span<const double> values,
                                 std::span<const double> weights);

/// Radii of the sample's rows; negative curvatures are clamped to 0.
[[nodiscard]] std::vector<double> radii_of(const Sample& sample, const LintHypothesis& hypothesis);

/// Cuts light to what the encoding of the hypothesis holds; light is interleaved RGB, rows of n_dot_l.
void cut(std::span<float> light, std::span<const double> n_dot_l, const LintHypothesis& hypothesis);

/// The sample as light.
[[nodiscard]] std::vector<float> decoded(const Sample& sample, const LintHypothesis& hypothesis);

/// Curves of one model at radii of equal ratio, 0.25 mm to 2 m.
inline constexpr int kRadii = 128;
[[nodiscard]] double bank_radius_mm(double index);
[[nodiscard]] double bank_index(double radius_mm);

struct Bank {
    std::vector<float> curves;  ///< [radius][column][channel]
    size_t row_values = 0;
    [[nodiscard]] std::span<const float> curve(size_t radius) const {
        return std::span(curves).subspan(radius * row_values, row_values);
    }
};
/// `profile` is the hypothesis' own, as a sum of Gaussians. Radii: kRadii, or fewer to be compared coarsely.
[[nodiscard]] Bank make_bank(const LintHypothesis& hypothesis, const Profile& profile,
                             std::span<const double> n_dot_l, int radii = kRadii);

/// Mean square over some rows with the radius of each row free, from those of the bank alone.
[[nodiscard]] double coarse_fit(const Bank& bank, std::span<const float> light);

/// Mean square over all rows with the radius of each row free; radii_mm receives them.
[[nodiscard]] double free_fit(const Bank& bank, std::span<const float> light, std::vector<double>& radii_mm);

/// Fits the axis of the hypothesis: curvature or radius, even or by a square (then from the end of the
/// picture at which rows are closest), whichever is better; ends as of texel centres. Fills rms.
void fit_axis(const Bank& bank, const Sample& sample, std::span<const float> light,
              const std::vector<double>& radii_mm, LintHypothesis& hypothesis);

/// Hypotheses about a table's origin, with construction and profile set. Profiles that are
/// not sums of Gaussians are replaced by their fit, which is exact enough to distinguish them.
struct Model {
    LintHypothesis hypothesis;
    std::shared_ptr<const Profile> profile;
};
/// Every construction and both published programs for every preset; shared by all calls.
[[nodiscard]] std::span<const Model> all_models();

/// The picture's texels that the search works on, and what explains them, best first; at least two.
struct Search {
    Sample sample;  ///< turned as the first hypothesis says
    std::vector<LintHypothesis> hypotheses;
    /// The best where each row may have any curvature; its axis is not set.
    LintHypothesis free;
    std::vector<double> free_radii_mm;
};
enum class Crops { searched, ignored };
[[nodiscard]] Search search(const Image& linear_float, Crops crops);

/// Reference of a sample: rows of the hypothesis, cut by the encoding like the file, or the
/// exact sphere of its profile.
enum class Against { its_model, the_sphere };

/// Remaining difference of the sample, read as the hypothesis says; with the place of the largest one.
struct Difference {
    double rms = 0, max = 0, n_dot_l = 0, radius_mm = 0;
};
[[nodiscard]] Result<Difference> difference(const Sample& sample, const LintHypothesis& hypothesis,
                                            Against against);

/// The reason why a picture cannot be a table of skin: negative, flat, grey. Empty: it may be one.
[[nodiscard]] std::string refusal_of_picture(const Image& linear_float);

/// How light differs from row to row and colour to colour at the same N.L.
struct Scattering {
    double rms = 0;
    double rows = 0;  ///< the largest difference of two rows
    double fall = 0;  ///< the most by which light falls towards the lit side
};
[[nodiscard]] Scattering scattering_of(const Sample& sample, const LintHypothesis& hypothesis);

/// The same as refusal_of_picture, by the light that a hypothesis sees, which leaves `rms` of it.
[[nodiscard]] std::string refusal_of_light(const Scattering& light, double rms);

/// Whether a fit that leaves `rms` is as good as one that leaves `best` but for rounding to 8 bits.
[[nodiscard]] bool is_as_good(double rms, double best);

/// A report with `hypothesis` as the best explanation, without text. Errors as of difference().
[[nodiscard]] Result<LintReport> measured(const Sample& sample, const LintHypothesis& hypothesis,
                                          const LintHypothesis& runner_up);

/// The number with the fewest digits that the fit does not distinguish from `value`.
[[nodiscard]] double without_noise(double value, const TableAxis& axis);

/// A file as a picture of a table. What texel i, j of a CSV holds is line 1 + j width + i.
struct TablePicture {
    Image image;
    std::string coordinates;    ///< of a CSV: "n_dot_l -0.98 to 0.98 across, ..."
    bool flagged_srgb = false;  ///< a PNG's own word
    bool holds_light = false;   ///< decoded already, whatever a convention says of pictures: CSV
};
/// Errors: as read_image; of CSV as parse_csv_picture.
[[nodiscard]] Result<TablePicture> read_picture(const std::filesystem::path& path);

/// A line "u,v,red,green,blue" for each texel of a grid, u or v changing faster, with or without a line of
/// names before them. Errors name `place` and the line.
[[nodiscard]] Result<TablePicture> parse_csv_picture(std::string_view text, std::string_view place);

/// Three digits.
[[nodiscard]] std::string rounded(double value);

/// Describes rows of unknown spacing and clears `explained`; false
/// if the spacing is known.
[[nodiscard]] bool explain_rows(LintReport& report, const Search& found, const Image& image);

/// A table of another kind than diffuse; `rms` and `max` are what its convention leaves.
struct OtherTable {
    Convention convention;
    double rms = 0, max = 0;
};
/// Beckmann, zonal harmonics or shadow, if the numbers are those of one: rms below .006.
[[nodiscard]] std::optional<OtherTable> other_table_of(const Image& linear_float);
void explain_other(LintReport& report, const OtherTable& found, const Image& image);

/// Findings and advice for a picture that is refused.
void explain_refusal(LintReport& report);

/// Fills findings and advice from the numbers of the report.
void explain(LintReport& report, const Image& image);

}  // namespace dermis::inline bake::lint
