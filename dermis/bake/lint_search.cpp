// The search for what explains a table: coarse for every model and view of the picture, fine for the best,
// then with an axis. A picture that no full range of N.L explains is searched again as a cropped one.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "dermis/bake/lint_model.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

namespace dermis::inline bake::lint {
namespace {

constexpr size_t kFinalists = 16;
constexpr size_t kViewsOfModel = 4;  // that are compared finely
// A full range that leaves less is not cropped; 8 bits and published taps leave 0.002.
constexpr double kFullRangeRms = 0.004;

// A possible orientation and encoding of the picture, with the light that it then shows.
struct View {
    LintHypothesis hypothesis;
    std::vector<float> light;
};

// Both samples of the picture, as it is and turned, and all views of them.
struct Views {
    std::array<Sample, 2> samples;
    std::vector<View> all;

    [[nodiscard]] const Sample& sample(const LintHypothesis& hypothesis) const {
        return samples[hypothesis.transposed ? 1 : 0];
    }
};

struct Range {
    double min = -1, max = 1;  // of N.L
};

struct Candidate {
    LintHypothesis hypothesis;
    std::shared_ptr<const Profile> profile;
    double mean_square = 0;
};

// `range` matters to the encoding as a difference from N.L.
Views all_views(const std::array<Sample, 2>& samples, Range range) {
    Views views{samples, {}};
    for (const bool transposed : {false, true})
        for (const bool mirrored : {false, true})
            for (const bool bgr : {false, true})
                for (StoredAs stored_as : {StoredAs::linear, StoredAs::srgb, StoredAs::encoded_twice,
                                           StoredAs::decoded_twice, StoredAs::difference}) {
                    View view{.hypothesis = {.stored_as = stored_as,
                                             .transposed = transposed,
                                             .n_dot_l_mirrored = mirrored,
                                             .bgr = bgr,
                                             .n_dot_l_min = range.min,
                                             .n_dot_l_max = range.max},
                              .light = {}};
                    view.light = decoded(views.sample(view.hypothesis), view.hypothesis);
                    views.all.push_back(std::move(view));
                }
    return views;
}

LintHypothesis combined(const LintHypothesis& model, const LintHypothesis& view) {
    LintHypothesis both = view;
    both.how = model.how;
    both.integration = model.integration;
    both.profile = model.profile;
    return both;
}

// Banks of one model that views share: two sizes of the picture, two directions, cut by the encoding or not.
class Banks {
  public:
    Banks(const Model& model, const Views& views, int radii) : model_(model), views_(views), radii_(radii) {}

    const Bank& of(const LintHypothesis& both) {
        std::optional<Bank>& bank = banks_[size_t(both.transposed) * 4 + size_t(both.n_dot_l_mirrored) * 2 +
                                           size_t(both.stored_as == StoredAs::difference)];
        if (!bank) bank = make_bank(both, *model_.profile, n_dot_l_of(views_.sample(both), both), radii_);
        return *bank;
    }

  private:
    const Model& model_;
    const Views& views_;
    int radii_;
    std::array<std::optional<Bank>, 8> banks_;
};

// The model's best views with free radii: a lower bound of what an axis can reach.
std::vector<Candidate> candidates_of(const Model& model, const Views& views) {
    constexpr int kCoarseRadii = 24;
    Banks coarse_banks(model, views, kCoarseRadii), banks(model, views, kRadii);
    std::vector<Candidate> all;
    for (const View& view : views.all) {
        const LintHypothesis both = combined(model.hypothesis, view.hypothesis);
        all.push_back({both, model.profile, coarse_fit(coarse_banks.of(both), view.light)});
    }
    std::vector<size_t> order(all.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](size_t i) { return all[i].mean_square; });
    order.resize(std::min(order.size(), kViewsOfModel));
    std::vector<Candidate> best;
    std::vector<double> radii_mm;
    for (size_t i : order) {
        best.push_back(all[i]);
        best.back().mean_square = free_fit(banks.of(all[i].hypothesis), views.all[i].light, radii_mm);
    }
    return best;
}

// The best of all models, best first.
std::vector<Candidate> best_candidates(std::span<const Model> models, const Views& views, size_t count) {
    std::vector<std::vector<Candidate>> found(models.size());
    parallel_for(models.size(), 1, [&](size_t begin, size_t end) {
        for (size_t m = begin; m < end; ++m) found[m] = candidates_of(models[m], views);
    });
    std::vector<Candidate> all;
    for (const std::vector<Candidate>& some : found) all.insert(all.end(), some.begin(), some.end());
    std::ranges::stable_sort(all, {}, &Candidate::mean_square);
    all.resize(std::min(all.size(), count));
    return all;
}

double free_mean_square(const Candidate& candidate, const Sample& sample) {
    const LintHypothesis& h = candidate.hypothesis;
    std::vector<double> radii_mm;
    return free_fit(make_bank(h, *candidate.profile, n_dot_l_of(sample, h)), decoded(sample, h), radii_mm);
}

// Moves both ends of N.L, within -1 to 1, until no step is better.
void refine_range(Candidate& candidate, const Sample& sample) {
    candidate.mean_square = free_mean_square(candidate, sample);
    for (double step = 0.1; step > 5e-4;) {
        bool better = false;
        for (const auto& [low, high] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            Candidate moved = candidate;
            LintHypothesis& h = moved.hypothesis;
            h.n_dot_l_min = std::clamp(h.n_dot_l_min + low * step, -1.0, 0.9);
            h.n_dot_l_max = std::clamp(h.n_dot_l_max + high * step, h.n_dot_l_min + 0.1, 1.0);
            moved.mean_square = free_mean_square(moved, sample);
            if (moved.mean_square >= candidate.mean_square) continue;
            candidate = moved;
            better = true;
        }
        if (!better) step /= 2;
    }
}

// The range of N.L that a cropped picture may have, from two models that resemble all others.
Range likely_range(const std::array<Sample, 2>& samples, std::span<const Model> all) {
    constexpr size_t kRefined = 3;
    std::vector<Model> models;
    for (const Model& model : all)
        if (model.hypothesis.profile == "gpu_gems_3" &&
            model.hypothesis.how.ring_weights == RingWeights::line &&
            model.hypothesis.how.construction != Construction::full_ring)
            models.push_back(model);
    std::vector<Candidate> best;
    for (const double min : {-1.0, -0.75, -0.5, -0.25, 0.0, 0.25})
        for (const double max : {0.25, 0.5, 0.75, 1.0}) {
            if (max - min < 0.4 || max - min > 1.9) continue;
            const auto some = best_candidates(models, all_views(samples, {min, max}), 1);
            best.insert(best.end(), some.begin(), some.end());
        }
    std::ranges::stable_sort(best, {}, &Candidate::mean_square);
    best.resize(std::min(best.size(), kRefined));
    parallel_for(best.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            refine_range(best[i], samples[best[i].hypothesis.transposed ? 1 : 0]);
    });
    const LintHypothesis& first = std::ranges::min_element(best, {}, &Candidate::mean_square)->hypothesis;
    return {first.n_dot_l_min, first.n_dot_l_max};
}

// Fits the candidate's axis, for the texel sampling with the smallest error.
LintHypothesis fitted(const Candidate& candidate, const Sample& sample) {
    LintHypothesis best;
    best.rms = std::numeric_limits<double>::infinity();
    for (TexelSampling sampling : {TexelSampling::centre, TexelSampling::low_edge}) {
        LintHypothesis hypothesis = candidate.hypothesis;
        hypothesis.sampling = sampling;
        const Bank bank = make_bank(hypothesis, *candidate.profile, n_dot_l_of(sample, hypothesis));
        const std::vector<float> light = decoded(sample, hypothesis);
        std::vector<double> radii_mm;
        (void)free_fit(bank, light, radii_mm);
        fit_axis(bank, sample, light, radii_mm, hypothesis);
        if (hypothesis.rms < best.rms) best = hypothesis;
    }
    return best;
}

std::vector<LintHypothesis> fitted_finalists(const Views& views, const std::vector<Candidate>& candidates) {
    std::vector<LintHypothesis> finalists(candidates.size());
    parallel_for(finalists.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            finalists[i] = fitted(candidates[i], views.sample(candidates[i].hypothesis));
    });
    std::ranges::stable_sort(finalists, {}, &LintHypothesis::rms);
    return finalists;
}

std::vector<LintHypothesis> cropped_finalists(const std::array<Sample, 2>& samples) {
    constexpr size_t kCroppedFinalists = 6;
    std::vector<Model> models;  // the published taps resemble exact rings and take ten times as long
    for (const Model& model : all_models())
        if (model.hypothesis.integration == Integration::exact) models.push_back(model);
    const Views views = all_views(samples, likely_range(samples, models));
    std::vector<Candidate> candidates = best_candidates(models, views, kCroppedFinalists);
    parallel_for(candidates.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            refine_range(candidates[i], views.sample(candidates[i].hypothesis));
    });
    return fitted_finalists(views, candidates);
}

// A published program evaluates its texels at their edges. Which edge cannot be found from the numbers, as it
// moves the ends of the axis only: it is taken to be the program's.
void use_published_rows(LintHypothesis& hypothesis, int rows) {
    if (hypothesis.integration != Integration::unity_taps) return;
    const TableAxis published = lut_options("unity_2011")->convention.axes[1];
    TableAxis& axis = hypothesis.axis;
    if (axis.name != published.name || axis.warp != published.warp) return;
    if (axis.min > axis.max) {
        hypothesis.v_origin = VOrigin::bottom;
        std::swap(axis.min, axis.max);
    }
    const double half_texel = 0.5 * (axis.max - axis.min) / rows;
    axis.min -= half_texel;
    axis.max -= half_texel;
    axis.sampling = published.sampling;
}

}  // namespace

Search search(const Image& image, Crops crops) {
    const std::array<Sample, 2> samples = {sample_of(image, false), sample_of(image, true)};
    const Views views = all_views(samples, {});
    const std::vector<Candidate> candidates = best_candidates(all_models(), views, kFinalists);
    std::vector<LintHypothesis> found = fitted_finalists(views, candidates);
    if (crops == Crops::searched && found.front().rms > kFullRangeRms) {
        const std::vector<LintHypothesis> cropped = cropped_finalists(samples);
        // Two more free numbers always explain a little more.
        if (cropped.front().rms < found.front().rms / 2) found = cropped;
    }
    for (LintHypothesis& hypothesis : found) use_published_rows(hypothesis, views.sample(hypothesis).v_count);
    Search result{views.sample(found.front()), found, candidates.front().hypothesis, {}};
    const Sample& sample = views.sample(result.free);
    const Bank bank = make_bank(result.free, *candidates.front().profile, n_dot_l_of(sample, result.free));
    result.free.rms = std::sqrt(free_fit(bank, decoded(sample, result.free), result.free_radii_mm));
    return result;
}

Result<Difference> difference(const Sample& sample, const LintHypothesis& hypothesis, Against against) {
    const bool itself = against == Against::its_model;
    const Preintegration how = itself ? hypothesis.how : Preintegration{};
    DERMIS_TRY_ASSIGN(Profile profile, find_profile(hypothesis.profile));
    if (how.construction != Construction::sphere) profile.model = to_gaussian_sum(profile, 8).sum;
    const std::vector<double> n_dot_l = n_dot_l_of(sample, hypothesis);
    const std::vector<double> radii_mm = radii_of(sample, hypothesis);
    const std::vector<float> light = decoded(sample, hypothesis);
    DERMIS_TRY_ASSIGN(std::vector<float> exact,
                      integrate_model(profile, itself ? hypothesis.integration : Integration::exact, n_dot_l,
                                      radii_mm, how));
    if (itself) cut(exact, n_dot_l, hypothesis);
    Difference result;
    double squares = 0;
    for (size_t i = 0; i < light.size(); ++i) {
        const double distance = std::abs(double(light[i]) - double(exact[i]));
        squares += distance * distance;
        if (distance > result.max)
            result = {.max = distance,
                      .n_dot_l = n_dot_l[i / 3 % n_dot_l.size()],
                      .radius_mm = radii_mm[i / 3 / n_dot_l.size()]};
    }
    result.rms = std::sqrt(squares / double(light.size()));
    return result;
}

}  // namespace dermis::inline bake::lint
