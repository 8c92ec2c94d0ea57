// Recognises Beckmann, zonal and shadow tables by their numbers. The numbers do not determine the scale of a
// profile: the same profile at twice the size over twice the lengths makes the same table.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/lint_model.h"
#include "dermis/bake/rows.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/table_report.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"

namespace dermis::inline bake::lint {
namespace {

constexpr double kSame = 0.006;  // rms that 8 bits, a fit of five Gaussians and an axis' rounding leave
constexpr int kLooks = 48;       // texels a side that are compared

struct Misfit {
    double squares = 0, max = 0;
    size_t count = 0;
    void add(double difference) {
        squares += difference * difference;
        max = std::max(max, std::abs(difference));
        ++count;
    }
    [[nodiscard]] double rms() const { return count ? std::sqrt(squares / double(count)) : 0; }
};

// At most kLooks indices, evenly from the first to the last.
std::vector<int> looks(int count) {
    std::vector<int> indices;
    const int steps = std::min(count, kLooks);
    for (int i = 0; i < steps; ++i) indices.push_back(steps == 1 ? 0 : i * (count - 1) / (steps - 1));
    return indices;
}

void keep_better(std::optional<OtherTable>& best, OtherTable found) {
    if (found.rms < kSame && (!best || found.rms < best->rms)) best = std::move(found);
}

std::optional<OtherTable> beckmann_of(const Image& image) {
    constexpr float kGrey = 1.5f / 255;
    if (image.height < 2 || !is_grey(image, kGrey)) return {};
    std::optional<OtherTable> best;
    for (const BeckmannLayout layout : {BeckmannLayout::linear, BeckmannLayout::gems_8_bit})
        for (const VOrigin origin : {VOrigin::top, VOrigin::bottom})
            for (const TexelSampling sampling : {TexelSampling::centre, TexelSampling::low_edge}) {
                Convention convention =
                    bake_beckmann({.width = 2, .height = 2, .layout = layout})->convention;
                convention.v_origin = origin;
                for (TableAxis& axis : convention.axes) axis.sampling = sampling;
                // The largest storable value. Unbounded values are compared by their ratio above 1.
                const double most = convention.encoding == TableEncoding::linear ? 60000 : 1;
                Misfit misfit;
                for (const int y : looks(image.height))
                    for (const int x : looks(image.width)) {
                        const int row = origin == VOrigin::bottom ? image.height - 1 - y : y;
                        const double value = beckmann(convention.axes[0].value(x, image.width),
                                                      convention.axes[1].value(row, image.height));
                        const double expected = std::min(encode_value(convention, value, 0), most);
                        const double stored = std::min(double(image.at(x, y, 0)), most);
                        misfit.add((stored - expected) / std::max(1.0, expected));
                    }
                keep_better(best, {std::move(convention), misfit.rms(), misfit.max});
            }
    return best;
}

// The line as an axis, its ends rounded within the error of the fit.
TableAxis rounded_axis(std::string name, std::string unit, Line line) {
    TableAxis axis{.name = std::move(name), .unit = std::move(unit), .min = line.at_0, .max = line.at_1};
    const TableAxis fitted = axis;
    axis.min = std::max(0.0, without_noise(fitted.min, fitted));
    axis.max = std::max(0.0, without_noise(fitted.max, fitted));
    return axis;
}

using Column = std::array<double, 9>;  // three orders of red, green, blue

Column column_of(const std::array<Rgb, 3>& zonal) {
    Column column;
    for (size_t l = 0; l < 3; ++l)
        for (size_t c = 0; c < 3; ++c) column[3 * l + c] = zonal[l][c];
    return column;
}

// The index, with a fraction, at which curves through `bank` come closest to the column.
double nearest_index(std::span<const Column> bank, const Column& column, size_t values) {
    double nearest = 0, least = 1e30;
    for (size_t i = 0; i + 1 < bank.size(); ++i) {
        double along = 0, length = 0;
        for (size_t k = 0; k < values; ++k) {
            const double step = bank[i + 1][k] - bank[i][k];
            along += step * (column[k] - bank[i][k]);
            length += step * step;
        }
        const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
        double squares = 0;
        for (size_t k = 0; k < values; ++k) {
            const double d = bank[i][k] + t * (bank[i + 1][k] - bank[i][k]) - column[k];
            squares += d * d;
        }
        if (squares < least) least = squares, nearest = double(i) + t;
    }
    return nearest;
}

struct ZonalPicture {
    std::vector<double> s;  // position of each compared column: 0 at the left edge, 1 at the right
    std::vector<Column> columns;
    size_t values = 0;  // that a column has: three an order
};

ZonalPicture zonal_picture(const Image& image, const Convention& convention) {
    ZonalPicture picture{.values = 3 * size_t(image.height)};
    for (const int x : looks(image.width)) {
        picture.s.push_back((x + 0.5) / image.width);
        Column column = {};
        for (int l = 0; l < image.height; ++l)
            for (int c = 0; c < 3; ++c)
                column[size_t(3 * l + c)] = decode_value(convention, image.at(x, l, c), 0);
        picture.columns.push_back(column);
    }
    return picture;
}

// The model's harmonics over an even axis of curvature or of radius, whichever is nearer.
void fit_zonal(const ZonalPicture& picture, const Model& model, const Convention& encoding,
               std::optional<OtherTable>& best) {
    const Preintegration& how = model.hypothesis.how;
    std::vector<Column> bank;
    for (int i = 0; i < kRadii; ++i)
        bank.push_back(column_of(zonal_harmonics_at(*model.profile, bank_radius_mm(i), how)));
    std::vector<double> radii, curvatures, equal(picture.s.size(), 1), by_radius;
    for (const Column& column : picture.columns) {
        radii.push_back(bank_radius_mm(nearest_index(bank, column, picture.values)));
        curvatures.push_back(1 / radii.back());
        by_radius.push_back(1 / (radii.back() * radii.back()));  // errors grow with the radius
    }
    for (const TableAxis& axis :
         {rounded_axis("curvature_per_mm", "1/mm", straight_line(picture.s, curvatures, equal)),
          rounded_axis("radius_mm", "mm", straight_line(picture.s, radii, by_radius))}) {
        if (axis.min == axis.max || !check_curvature_axis(axis)) continue;
        Misfit misfit;
        for (size_t i = 0; i < picture.s.size(); ++i) {
            const double value = axis.min + (axis.max - axis.min) * picture.s[i];
            const Column exact = column_of(zonal_harmonics_at(*model.profile, radius_of(axis, value), how));
            for (size_t k = 0; k < picture.values; ++k) misfit.add(picture.columns[i][k] - exact[k]);
        }
        Convention convention = encoding;
        convention.axes[0] = axis;
        convention.how = how;
        convention.profile = model.hypothesis.profile;
        keep_better(best, {std::move(convention), misfit.rms(), misfit.max});
    }
}

std::optional<OtherTable> zonal_of(const Image& image) {
    constexpr double kAlike = 0.01;
    if (image.channels < 3 || image.height < 2 || image.height > 3 || image.width < 8) return {};
    Convention convention =
        bake_zonal_harmonics(
            {.profile = *all_models()[0].profile,
             .width = 2,
             .layout = image.height == 2 ? ZonalLayout::two_rows_remapped_8 : ZonalLayout::three_rows})
            ->convention;
    const ZonalPicture picture = zonal_picture(image, convention);
    const auto [low, high] = std::ranges::minmax(picture.columns, {}, [](const Column& c) { return c[3]; });
    if (high[3] - low[3] < kAlike) return {};  // no curvature in it
    std::optional<OtherTable> best;
    for (const Model& model : all_models())
        if (model.hypothesis.integration == Integration::exact && model.hypothesis.how.variance_scale == 1 &&
            model.hypothesis.how.ring_weights == RingWeights::line)
            fit_zonal(picture, model, convention, best);
    return best;
}

struct ShadowPicture {
    std::vector<double>
        position;           // of each compared column: 0 in the shadow, 1 in the light; the left half alone
    std::vector<double> s;  // of each compared row: 0 at the top edge, 1 at the bottom
    std::vector<std::vector<Rgb>> light;  // [row][column]
};

// Empty if the picture is not a shadow table: the edge is symmetric, so light at p and at 1 - p sums to 1.
std::optional<ShadowPicture> shadow_picture(const Image& image, TableEncoding encoding) {
    constexpr double kSum = 0.01, kRise = 0.1;
    ShadowPicture picture;
    const std::vector<int> columns = looks((image.width + 1) / 2);
    for (const int x : columns) picture.position.push_back((x + 0.5) / image.width);
    double rise = 0;
    for (const int y : looks(image.height)) {
        picture.s.push_back((y + 0.5) / image.height);
        std::vector<Rgb>& row = picture.light.emplace_back();
        for (const int x : columns) {
            Rgb light;
            for (int c = 0; c < 3; ++c) {
                const auto value = [&](int at) {
                    return encoding == TableEncoding::srgb ? double(srgb_decode(image.at(at, y, c)))
                                                           : double(image.at(at, y, c));
                };
                light[size_t(c)] = value(x);
                if (std::abs(value(x) + value(image.width - 1 - x) - 1) > kSum) return {};
            }
            row.push_back(light);
        }
        rise = std::max(rise, row.back()[0] - row.front()[0]);
    }
    if (rise < kRise) return {};
    return picture;
}

std::vector<Rgb> shadow_row(const GaussianSum& sum, std::span<const double> position, double width_mm,
                            double sharpening) {
    Rgb total = {};
    std::vector<Rgb> row(position.size());
    for (const GaussianTerm& term : sum.terms) {
        const double sigma = std::sqrt(term.variance_mm2) / width_mm;
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
        for (size_t i = 0; i < position.size(); ++i) {
            const double lit = blurred_smoothstep(position[i], sigma, sharpening);
            for (size_t c = 0; c < 3; ++c) row[i][c] += term.weight[c] * lit;
        }
    }
    for (Rgb& light : row)
        for (size_t c = 0; c < 3; ++c) light[c] /= total[c];
    return row;
}

double mean_square(std::span<const Rgb> a, std::span<const Rgb> b) {
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t c = 0; c < 3; ++c) squares += (a[i][c] - b[i][c]) * (a[i][c] - b[i][c]);
    return squares / double(3 * a.size());
}

constexpr int kWidths = 96;
double bank_width_mm(double index) {
    return 0.1 * std::pow(10000.0, index / (kWidths - 1));
}

// The nearest width of each row, by a parabola through the three best of the bank.
std::vector<double> free_widths(const ShadowPicture& picture, std::span<const std::vector<Rgb>> bank) {
    std::vector<double> widths;
    for (const std::vector<Rgb>& row : picture.light) {
        std::array<double, kWidths> error;
        for (size_t i = 0; i < kWidths; ++i) error[i] = mean_square(bank[i], row);
        const auto best = size_t(
            std::clamp<std::ptrdiff_t>(std::ranges::min_element(error) - error.begin(), 1, kWidths - 2));
        const double below = error[best - 1], above = error[best + 1];
        const double bend = below + above - 2 * error[best];
        const double shift = bend > 0 ? std::clamp((below - above) / (2 * bend), -1.0, 1.0) : 0;
        widths.push_back(bank_width_mm(double(best) + shift));
    }
    return widths;
}

OtherTable fit_shadow(const ShadowPicture& picture, const Model& model, double sharpening,
                      TableEncoding encoding) {
    const auto& sum = std::get<GaussianSum>(model.profile->model);
    std::vector<std::vector<Rgb>> bank;
    for (int i = 0; i < kWidths; ++i)
        bank.push_back(shadow_row(sum, picture.position, bank_width_mm(i), sharpening));
    const std::vector<double> widths = free_widths(picture, bank);
    std::vector<double> weights;  // a relative error counts alike
    for (const double width : widths) weights.push_back(1 / (width * width));
    OtherTable found;
    found.rms = 1e30;
    for (const AxisWarp warp : {AxisWarp::linear, AxisWarp::squared}) {
        std::vector<double> s = picture.s;
        if (warp == AxisWarp::squared)
            for (double& at : s) at *= at;
        TableAxis axis = rounded_axis("penumbra_width_mm", "mm", straight_line(s, widths, weights));
        axis.warp = warp;
        if (!check_axis(axis, 0.01, 10000)) continue;
        Misfit misfit;
        for (size_t i = 0; i < s.size(); ++i) {
            const std::vector<Rgb> row =
                shadow_row(sum, picture.position, axis.min + (axis.max - axis.min) * s[i], sharpening);
            for (size_t x = 0; x < row.size(); ++x)
                for (size_t c = 0; c < 3; ++c) misfit.add(row[x][c] - picture.light[i][x][c]);
        }
        if (misfit.rms() >= found.rms) continue;
        found = {.convention = {.kind = TableKind::shadow,
                                .axes = {TableAxis{"penumbra_position", "1", 0, 1}, axis},
                                .encoding = encoding,
                                .shadow_sharpening = sharpening,
                                .profile = model.hypothesis.profile},
                 .rms = misfit.rms(),
                 .max = misfit.max};
    }
    return found;
}

// Every profile at a few sharpenings; the best profile's sharpening then by golden section.
std::optional<OtherTable> shadow_of(const Image& image) {
    constexpr double kSharpenings[] = {1, 1.5, 2, 3, 4.5, 6.5, 10, 15, 25};
    constexpr double kGolden = 0.618034;
    if (image.channels < 3 || image.height < 4 || image.width < 8) return {};
    for (const TableEncoding encoding : {TableEncoding::linear, TableEncoding::srgb}) {
        const std::optional<ShadowPicture> picture = shadow_picture(image, encoding);
        if (!picture) continue;
        std::vector<Model> models;
        for (const Model& model : all_models())
            if (models.empty() || models.back().hypothesis.profile != model.hypothesis.profile)
                models.push_back(model);
        std::vector<OtherTable> all(models.size() * std::size(kSharpenings));
        parallel_for(all.size(), 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                all[i] = fit_shadow(*picture, models[i / std::size(kSharpenings)],
                                    kSharpenings[i % std::size(kSharpenings)], encoding);
        });
        const auto best = size_t(std::ranges::min_element(all, {}, &OtherTable::rms) - all.begin());
        const Model& model = models[best / std::size(kSharpenings)];
        const size_t at = best % std::size(kSharpenings);
        double low = std::log(kSharpenings[at ? at - 1 : 0]),
               high = std::log(kSharpenings[std::min(at + 1, std::size(kSharpenings) - 1)]);
        const auto fit = [&](double logarithm) {
            return fit_shadow(*picture, model, std::exp(logarithm), encoding);
        };
        for (int i = 0; i < 12; ++i) {
            const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
            if (fit(a).rms < fit(b).rms)
                high = b;
            else
                low = a;
        }
        std::optional<OtherTable> found;
        keep_better(found, all[best]);
        OtherTable refined = fit(0.5 * (low + high));
        if (!found || refined.rms < 0.5 * found->rms) keep_better(found, std::move(refined));
        if (found) return found;
    }
    return {};
}

}  // namespace

std::optional<OtherTable> other_table_of(const Image& linear_float) {
    std::optional<OtherTable> found = beckmann_of(linear_float);
    if (!found) found = zonal_of(linear_float);
    if (!found) found = shadow_of(linear_float);
    if (found) found->convention.tool = "dermis lint, " + tool_version();
    return found;
}

void explain_other(LintReport& report, const OtherTable& found, const Image& image) {
    report.other = found.convention;
    report.explained = true;
    report.best.rms = found.rms;
    report.best.max = found.max;
    report.findings.push_back(
        "explained best by: " +
        describe(Table{.width = image.width, .height = image.height, .convention = found.convention}));
    if (found.convention.kind == TableKind::shadow)
        report.findings.push_back("sharpening " + rounded(found.convention.shadow_sharpening));
    report.findings.push_back("it leaves an error of rms " + rounded(found.rms) + ", largest " +
                              rounded(found.max));
    if (found.convention.kind != TableKind::beckmann)
        report.findings.push_back(
            "a profile twice as wide over lengths twice as long is the same table: the numbers do not tell "
            "them apart");
    report.advice.push_back(found.convention.encoding == TableEncoding::srgb
                                ? "sample it as an sRGB texture, clamped, without mips"
                                : "sample it as data: no sRGB flag, clamped, without mips");
}

}  // namespace dermis::inline bake::lint
