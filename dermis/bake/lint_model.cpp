#include "dermis/bake/lint_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dermis/bake/lut.h"
#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

namespace dermis::inline bake::lint {
namespace {

constexpr size_t kMostColumns = 40, kMostRows = 20;
constexpr double kLeastRadius_mm = 0.25, kMostRadius_mm = 2000;

std::vector<int> spread(int count, size_t most) {
    const int picks = int(std::min<size_t>(most, size_t(count)));
    std::vector<int> texels;
    for (int i = 0; i < picks; ++i) texels.push_back(int((i + 0.5) * count / picks));
    return texels;
}

double squared_distance(std::span<const float> a, std::span<const float> b) {
    float sum = 0;  // a few hundred terms of about 1e-3: float is enough, and vectorises
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

// s: 0 at the top of the picture, 1 at its bottom. A fitted axis may begin slightly below zero; such a
// curvature counts as 0.
double radius_at(const TableAxis& axis, double s, int rows, VOrigin origin = VOrigin::top) {
    const double value = axis.value((origin == VOrigin::top ? s : 1 - s) * rows - 0.5, rows);
    return radius_of(axis,
                     axis.name == "radius_mm" ? std::max(kLeastRadius_mm, value) : std::max(0.0, value));
}

// Interpolates the bank's curves linearly in the logarithm of the radius.
double squared_distance_at(const Bank& bank, double radius_mm, std::span<const float> light) {
    const double index = std::clamp(bank_index(radius_mm), 0.0, kRadii - 1.001);
    const size_t low = size_t(index);
    const float weight = float(index - double(low));
    const std::span<const float> a = bank.curve(low), b = bank.curve(low + 1);
    float sum = 0;
    for (size_t i = 0; i < light.size(); ++i) {
        const float difference = a[i] + weight * (b[i] - a[i]) - light[i];
        sum += difference * difference;
    }
    return sum;
}

// How rows may be spaced: an axis and the end of the picture at which it begins.
struct Spacing {
    TableAxis axis;
    VOrigin origin = VOrigin::top;
};

double mean_square(const Bank& bank, const Sample& sample, std::span<const float> light,
                   const Spacing& spacing) {
    double sum = 0;
    for (size_t y = 0; y < sample.v.size(); ++y)
        sum += squared_distance_at(bank, radius_at(spacing.axis, sample.v[y], sample.v_count, spacing.origin),
                                   light.subspan(y * bank.row_values, bank.row_values));
    return sum / double(light.size());
}

// The start of the search: a weighted straight line through (s, value), or (s^2, value).
void regress(const Sample& sample, std::span<const double> values, std::span<const double> weights,
             Spacing& spacing) {
    std::vector<double> at;
    for (const double v : sample.v) {
        const double from = spacing.origin == VOrigin::top ? v : 1 - v;
        at.push_back(spacing.axis.warp == AxisWarp::squared ? from * from : from);
    }
    const Line line = straight_line(at, values, weights);
    spacing.axis.min = line.at_0;
    spacing.axis.max = line.at_1;
}

// Pattern search on the axis' two ends, steps relative to its length.
double refine(const Bank& bank, const Sample& sample, std::span<const float> light, Spacing& spacing) {
    TableAxis& axis = spacing.axis;
    double best = mean_square(bank, sample, light, spacing);
    double step = 0.1 * std::max({std::abs(axis.max - axis.min), 0.1 * std::abs(axis.max), 1e-4});
    for (int round = 0; round < 120 && step > 1e-7; ++round) {
        bool better = false;
        constexpr std::array<std::array<int, 2>, 8> kMoves = {
            {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
        for (const auto& [low, high] : kMoves) {
            Spacing moved = spacing;
            moved.axis.min += low * step;
            moved.axis.max += high * step;
            const double value = mean_square(bank, sample, light, moved);
            if (value >= best) continue;
            best = value;
            spacing = moved;
            better = true;
        }
        step *= better ? 1.0 : 0.5;
    }
    return best;
}

}  // namespace

double bank_radius_mm(double index) {
    return kLeastRadius_mm * std::pow(kMostRadius_mm / kLeastRadius_mm, index / (kRadii - 1));
}

double bank_index(double radius_mm) {
    return (kRadii - 1) * std::log(radius_mm / kLeastRadius_mm) / std::log(kMostRadius_mm / kLeastRadius_mm);
}

Sample sample_of(const Image& image, bool transposed) {
    const int u_count = transposed ? image.height : image.width;
    const int v_count = transposed ? image.width : image.height;
    Sample sample{.u_count = u_count, .v_count = v_count};
    const std::vector<int> columns = spread(u_count, kMostColumns), rows = spread(v_count, kMostRows);
    for (int x : columns) sample.u.push_back((x + 0.5) / u_count);
    for (int y : rows) sample.v.push_back((y + 0.5) / v_count);
    for (int y : rows)
        for (int x : columns)
            for (int c = 0; c < 3; ++c)
                sample.stored.push_back(transposed ? image.at(y, x, c) : image.at(x, y, c));
    return sample;
}

std::vector<double> n_dot_l_of(const Sample& sample, const LintHypothesis& hypothesis) {
    const double half_texel = 0.5 / sample.u_count;
    std::vector<double> n_dot_l;
    for (double u : sample.u) {
        double s = hypothesis.n_dot_l_mirrored ? 1 - u : u;
        if (hypothesis.sampling == TexelSampling::low_edge) s -= half_texel;
        if (hypothesis.sampling == TexelSampling::high_edge) s += half_texel;
        const double value = hypothesis.n_dot_l_min + (hypothesis.n_dot_l_max - hypothesis.n_dot_l_min) * s;
        n_dot_l.push_back(std::clamp(value, -1.0, 1.0));
    }
    return n_dot_l;
}

std::vector<double> radii_of(const Sample& sample, const LintHypothesis& hypothesis) {
    std::vector<double> radii_mm;
    for (double s : sample.v)
        radii_mm.push_back(radius_at(hypothesis.axis, s, sample.v_count, hypothesis.v_origin));
    return radii_mm;
}

std::vector<float> decoded(const Sample& sample, const LintHypothesis& hypothesis) {
    std::vector<float> light = sample.stored;
    if (hypothesis.bgr)
        for (size_t i = 0; i < light.size(); i += 3) std::swap(light[i], light[i + 2]);
    const std::vector<double> n_dot_l = n_dot_l_of(sample, hypothesis);
    for (size_t i = 0; i < light.size(); ++i) {
        const float cosine = float(std::max(0.0, n_dot_l[i / 3 % n_dot_l.size()]));
        switch (hypothesis.stored_as) {
            case StoredAs::linear:
                break;
            case StoredAs::srgb:
                light[i] = srgb_decode(light[i]);
                break;
            case StoredAs::encoded_twice:
                light[i] = srgb_decode(srgb_decode(light[i]));
                break;
            case StoredAs::decoded_twice:
                light[i] = srgb_encode(light[i]);
                break;
            case StoredAs::difference:
                light[i] = 0.5f * (light[i] - 0.5f) + cosine;
                break;
        }
    }
    return light;
}

void cut(std::span<float> light, std::span<const double> n_dot_l, const LintHypothesis& hypothesis) {
    if (hypothesis.stored_as != StoredAs::difference) return;
    for (size_t i = 0; i < light.size(); ++i) {
        const double cosine = std::max(0.0, n_dot_l[i / 3 % n_dot_l.size()]);
        light[i] = std::clamp(light[i], float(cosine - kMostDifference), float(cosine + kMostDifference));
    }
}

Bank make_bank(const LintHypothesis& hypothesis, const Profile& profile, std::span<const double> n_dot_l,
               int radii) {
    std::vector<double> radii_mm;
    for (int i = 0; i < radii; ++i)
        radii_mm.push_back(bank_radius_mm(double(i) * (kRadii - 1) / (radii - 1)));
    Result<std::vector<float>> curves =
        integrate_model(profile, hypothesis.integration, n_dot_l, radii_mm, hypothesis.how);
    // Presets are preintegrable (a test asserts it).
    cut(*curves, n_dot_l, hypothesis);
    return {std::move(curves).value(), 3 * n_dot_l.size()};
}

double coarse_fit(const Bank& bank, std::span<const float> light) {
    constexpr size_t kEveryRow = 4;
    const size_t radii = bank.curves.size() / bank.row_values;
    const size_t rows = light.size() / bank.row_values;
    double total = 0;
    size_t used = 0;
    for (size_t y = rows > kEveryRow ? kEveryRow / 2 : 0; y < rows; y += kEveryRow, ++used) {
        double least = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < radii; ++i)
            least = std::min(
                least, squared_distance(bank.curve(i), light.subspan(y * bank.row_values, bank.row_values)));
        total += least;
    }
    return total / double(used * bank.row_values);
}

double free_fit(const Bank& bank, std::span<const float> light, std::vector<double>& radii_mm) {
    const size_t rows = light.size() / bank.row_values;
    radii_mm.assign(rows, 0);
    double total = 0;
    for (size_t y = 0; y < rows; ++y) {
        const std::span<const float> row = light.subspan(y * bank.row_values, bank.row_values);
        size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < kRadii; ++i) {
            const double distance = squared_distance(bank.curve(i), row);
            if (distance < least) least = distance, best = i;
        }
        // Refines between the curves: the better of the midpoints on both sides, twice.
        double index = double(best);
        for (double step : {0.5, 0.25, 0.125})
            for (double candidate : {index - step, index + step}) {
                const double distance = squared_distance_at(bank, bank_radius_mm(candidate), row);
                if (distance < least) least = distance, index = candidate;
            }
        radii_mm[y] = bank_radius_mm(index);
        total += least;
    }
    return total / double(light.size());
}

Line straight_line(std::span<const double> s, std::span<const double> values,
                   std::span<const double> weights) {
    double w = 0, ws = 0, wss = 0, wv = 0, wsv = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        w += weights[i];
        ws += weights[i] * s[i];
        wss += weights[i] * s[i] * s[i];
        wv += weights[i] * values[i];
        wsv += weights[i] * s[i] * values[i];
    }
    const double determinant = w * wss - ws * ws;
    const double slope = std::abs(determinant) > 1e-12 ? (w * wsv - ws * wv) / determinant : 0;
    const double at_0 = (wv - slope * ws) / w;
    return {at_0, at_0 + slope};
}

void fit_axis(const Bank& bank, const Sample& sample, std::span<const float> light,
              const std::vector<double>& radii_mm, LintHypothesis& hypothesis) {
    // Errors of the fitted radii are even in curvature; in radius they grow with its square.
    std::vector<double> curvatures, even(radii_mm.size(), 1), by_radius;
    for (double radius_mm : radii_mm) {
        curvatures.push_back(1 / radius_mm);
        by_radius.push_back(1 / std::pow(radius_mm, 4));
    }
    const TableAxis curvature{.name = "curvature_per_mm", .unit = "1/mm"},
        radius{.name = "radius_mm", .unit = "mm"};
    double best = std::numeric_limits<double>::infinity();
    // Replaces the best spacing only if the residual falls by the factor `needed`.
    const auto offer = [&](Spacing spacing, AxisWarp warp, double needed) {
        const bool in_curvature = spacing.axis.name == curvature.name;
        spacing.axis.warp = warp;
        regress(sample, in_curvature ? std::span<const double>(curvatures) : radii_mm,
                in_curvature ? even : by_radius, spacing);
        const double remains = refine(bank, sample, light, spacing);
        if (remains * needed >= best) return;
        best = remains;
        hypothesis.axis = spacing.axis;
        hypothesis.v_origin = spacing.origin;
    };
    for (const TableAxis& axis : {curvature, radius}) offer({axis}, AxisWarp::linear, 1);
    for (const TableAxis& axis : {curvature, radius})
        for (const VOrigin origin : {VOrigin::top, VOrigin::bottom})
            offer({axis, origin}, AxisWarp::squared, 1.5);
    hypothesis.rms = std::sqrt(best);
}

namespace {

std::vector<Model> made_models() {
    const Convention unity = lut_options("unity_2011")->convention,
                     faceworks = lut_options("faceworks")->convention;
    struct Way {
        Preintegration how;
        Integration integration = Integration::exact;
    };
    const Way ways[] = {
        {{.construction = Construction::sphere}},
        {{.construction = Construction::full_ring}},
        {{.construction = Construction::half_ring}},
        {{.construction = Construction::full_ring, .ring_weights = RingWeights::area}},
        {{.construction = Construction::half_ring, .ring_weights = RingWeights::area}},
        {unity.how, unity.integration},
        {faceworks.how, faceworks.integration},
    };
    constexpr int kTerms = 5;
    const std::vector<std::string> names = profile_names();
    std::vector<std::shared_ptr<const Profile>> profiles(names.size());
    parallel_for(names.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Profile profile = *find_profile(names[i]);
            profile.model = to_gaussian_sum(profile, kTerms).sum;
            profiles[i] = std::make_shared<const Profile>(std::move(profile));
        }
    });
    std::vector<Model> models;
    for (size_t i = 0; i < names.size(); ++i)
        for (const Way& way : ways)
            models.push_back(
                {{.how = way.how, .integration = way.integration, .profile = names[i]}, profiles[i]});
    return models;
}

}  // namespace

std::span<const Model> all_models() {
    static const std::vector<Model> models = made_models();
    return models;
}

}  // namespace dermis::inline bake::lint
