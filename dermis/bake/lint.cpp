#include "dermis/bake/lint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "dermis/bake/lint_model.h"
#include "dermis/bake/lut_taps.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/table_report.h"
#include "dermis/base/file.h"
#include "dermis/base/parallel.h"
#include "dermis/image/io.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

namespace dermis {
namespace {

constexpr double kExplained = 0.01;
constexpr size_t kFinalists = 16;

// A possible orientation and encoding of the picture, with the light that it then shows.
struct View {
    LintHypothesis hypothesis;
    lint::Sample sample;
    std::vector<float> light;
};

std::vector<View> all_views(const Image& image) {
    std::vector<View> views;
    for (const bool transposed : {false, true}) {
        const lint::Sample sample = lint::sample_of(image, transposed);
        for (const bool mirrored : {false, true})
            for (StoredAs stored_as :
                 {StoredAs::linear, StoredAs::srgb, StoredAs::decoded_twice, StoredAs::difference}) {
                View view{.hypothesis = {.stored_as = stored_as,
                                         .transposed = transposed,
                                         .n_dot_l_mirrored = mirrored},
                          .sample = sample};
                view.light = lint::decoded(sample, view.hypothesis);
                views.push_back(std::move(view));
            }
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

struct Candidate {
    size_t view = 0;
    LintHypothesis hypothesis;
    std::shared_ptr<const Profile> profile;
    double mean_square = 0;
};

// Every model against every view with free radii: a lower bound of what an axis can reach.
std::vector<Candidate> free_candidates(const std::vector<View>& views,
                                       const std::vector<lint::Model>& models) {
    std::vector<Candidate> all(views.size() * models.size());
    parallel_for(models.size(), 1, [&](size_t begin, size_t end) {
        std::vector<double> radii_mm;
        for (size_t m = begin; m < end; ++m) {
            // Four banks serve all views: two sizes of the picture, two directions.
            std::array<std::optional<lint::Bank>, 4> banks;
            for (size_t v = 0; v < views.size(); ++v) {
                const LintHypothesis& view = views[v].hypothesis;
                auto& bank = banks[size_t(view.transposed) * 2 + size_t(view.n_dot_l_mirrored)];
                const LintHypothesis both = combined(models[m].hypothesis, view);
                if (!bank)
                    bank = lint::make_bank(both, *models[m].profile, lint::n_dot_l_of(views[v].sample, both));
                all[m * views.size() + v] = {v, both, models[m].profile,
                                             lint::free_fit(*bank, views[v].light, radii_mm)};
            }
        }
    });
    std::ranges::sort(all, {}, &Candidate::mean_square);
    return all;
}

// Fits the candidate's axis, for the texel sampling with the smallest error.
LintHypothesis fitted(const Candidate& candidate, const View& view) {
    LintHypothesis best;
    best.rms = std::numeric_limits<double>::infinity();
    for (TexelSampling sampling : {TexelSampling::centre, TexelSampling::low_edge}) {
        LintHypothesis hypothesis = candidate.hypothesis;
        hypothesis.sampling = sampling;
        const lint::Bank bank =
            lint::make_bank(hypothesis, *candidate.profile, lint::n_dot_l_of(view.sample, hypothesis));
        const std::vector<float> light = lint::decoded(view.sample, hypothesis);
        std::vector<double> radii_mm;
        (void)lint::free_fit(bank, light, radii_mm);
        lint::fit_axis(bank, view.sample, light, radii_mm, hypothesis);
        if (hypothesis.rms < best.rms) best = hypothesis;
    }
    return best;
}

bool same_model(const LintHypothesis& a, const LintHypothesis& b) {
    return a.profile == b.profile && a.how.construction == b.how.construction &&
           a.integration == b.integration && a.how.ring_weights == b.how.ring_weights;
}

struct Difference {
    double rms = 0, max = 0, n_dot_l = 0, radius_mm = 0;
};

// All sampled texels, read as the hypothesis says, against exact rows of `how`.
Result<Difference> difference(const View& view, const LintHypothesis& hypothesis, const Preintegration& how,
                              Integration integration) {
    Result<Profile> profile = find_profile(hypothesis.profile);
    if (!profile) return profile.error();
    if (how.construction != Construction::sphere) profile->model = to_gaussian_sum(*profile, 8).sum;
    const std::vector<double> n_dot_l = lint::n_dot_l_of(view.sample, hypothesis);
    const std::vector<double> radii_mm = lint::radii_of(view.sample, hypothesis.axis);
    const std::vector<float> light = lint::decoded(view.sample, hypothesis);
    const Result<std::vector<float>> exact = integrate_model(*profile, integration, n_dot_l, radii_mm, how);
    if (!exact) return exact.error();
    Difference result;
    double squares = 0;
    for (size_t i = 0; i < light.size(); ++i) {
        const double distance = std::abs(double(light[i]) - double((*exact)[i]));
        squares += distance * distance;
        if (distance > result.max)
            result = {.max = distance,
                      .n_dot_l = n_dot_l[i / 3 % n_dot_l.size()],
                      .radius_mm = radii_mm[i / 3 / n_dot_l.size()]};
    }
    result.rms = std::sqrt(squares / double(light.size()));
    return result;
}

// Fits the finalists; the best comes first. `view` receives the best one's.
std::vector<LintHypothesis> fitted_finalists(const std::vector<View>& views,
                                             const std::vector<Candidate>& all, size_t& view) {
    const size_t count = std::min(kFinalists, all.size());
    std::vector<LintHypothesis> finalists(count);
    parallel_for(count, 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) finalists[i] = fitted(all[i], views[all[i].view]);
    });
    std::vector<size_t> order(count);
    for (size_t i = 0; i < count; ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](size_t i) { return finalists[i].rms; });
    view = all[order.front()].view;
    std::vector<LintHypothesis> sorted;
    for (size_t i : order) sorted.push_back(finalists[i]);
    return sorted;
}

Result<void> check(const Image& image) {
    if (image.width < 8 || image.height < 2)
        return Error{"the picture is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                     " texels; a table has at least 8 x 2"};
    if (image.channels < 3)
        return Error{"the picture has no colour; a table of skin has red, green and blue"};
    for (float value : image.floats())
        if (!std::isfinite(value)) return Error{"the picture has values that are not finite"};
    return {};
}

}  // namespace

Result<LintReport> lint_table(const Image& image) {
    const Image stored = to_linear_float(Image{image});
    if (Result<void> valid = check(stored); !valid) return valid.error();
    static const std::vector<lint::Model> models = lint::all_models();
    const std::vector<View> views = all_views(stored);
    size_t view = 0;
    const std::vector<LintHypothesis> finalists =
        fitted_finalists(views, free_candidates(views, models), view);

    LintReport report{.best = finalists.front(), .runner_up = finalists.back()};
    for (const LintHypothesis& other : finalists)
        if (!same_model(other, report.best)) {
            report.runner_up = other;
            break;
        }
    const Result<Difference> own =
        difference(views[view], report.best, report.best.how, report.best.integration);
    if (!own) return own.error();
    report.best.rms = own->rms;
    report.best.max = own->max;
    report.explained = own->rms < kExplained;
    const Result<Difference> exact = difference(views[view], report.best, {}, Integration::exact);
    if (!exact) return exact.error();
    report.error_rms = exact->rms;
    report.error_max = exact->max;
    report.error_max_n_dot_l = exact->n_dot_l;
    report.error_max_radius_mm = exact->radius_mm;
    lint::explain(report, image);
    return report;
}

Result<LintReport> lint_file(const std::filesystem::path& path) {
    const Result<std::vector<std::byte>> file = read_file(path);
    if (!file) return file.error();
    const Result<LoadedImage> loaded = decode_image(*file, path.string(), ImageUse::data);
    if (!loaded) return loaded.error();
    Result<LintReport> report = lint_table(loaded->image);
    if (!report) return Error{path.string() + ": " + report.error().message};
    const bool numbers_are_srgb = report->best.stored_as == StoredAs::srgb;
    if (png_is_flagged_srgb(*file) && !numbers_are_srgb && report->explained) {
        report->findings.push_back("the PNG is flagged sRGB, its numbers are not");
        report->advice.push_back("import it as data (no sRGB), against its flag");
    }
    if (const Result<Table> own = read_table(path, {}))
        report->findings.push_back("its own convention says: " + describe(*own));
    return report;
}

}  // namespace dermis
