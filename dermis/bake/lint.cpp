#include "dermis/bake/lint.h"

#include <cmath>
#include <optional>

#include "dermis/bake/lint_model.h"

namespace dermis::inline bake {
namespace {

constexpr double kExplained = 0.01;

bool same_model(const LintHypothesis& a, const LintHypothesis& b) {
    return a.profile == b.profile && a.how.construction == b.how.construction &&
           a.integration == b.integration && a.how.ring_weights == b.how.ring_weights;
}

Result<void> check(const Image& image) {
    if (image.width < 8 || image.height < 2)
        return Error{"the picture is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                     " texels; a table has at least 8 x 2"};
    if (image.channels < 3)
        return Error{"the picture has no colour; a table of skin has red, green and blue"};
    return {};
}

Result<void> check_finite(const Image& image) {
    for (float value : image.floats())
        if (!std::isfinite(value)) return Error{"the picture has values that are not finite"};
    return {};
}

}  // namespace

Result<LintReport> lint::measured(const Sample& sample, const LintHypothesis& hypothesis,
                                  const LintHypothesis& runner_up) {
    LintReport report{.best = hypothesis, .runner_up = runner_up};
    DERMIS_TRY_ASSIGN(const Difference own, difference(sample, hypothesis, Against::its_model));
    report.best.rms = own.rms;
    report.best.max = own.max;
    const lint::Scattering light = lint::scattering_of(sample, hypothesis);
    if (light.rms > 0) report.explained_share = 1 - own.rms * own.rms / (light.rms * light.rms);
    report.refusal = lint::refusal_of_light(light, own.rms);
    report.explained = own.rms < kExplained;
    DERMIS_TRY_ASSIGN(const Difference exact, difference(sample, hypothesis, Against::the_sphere));
    report.error_rms = exact.rms;
    report.error_max = exact.max;
    report.error_max_n_dot_l = exact.n_dot_l;
    report.error_max_radius_mm = exact.radius_mm;
    return report;
}

Result<LintReport> lint_table(const Image& image, const LintHypothesis* own) {
    const Image stored = to_linear_float(Image{image});
    DERMIS_TRY(check_finite(stored));
    if (const std::optional<lint::OtherTable> other = own ? std::nullopt : lint::other_table_of(stored)) {
        LintReport report;
        lint::explain_other(report, *other, stored);
        return report;
    }
    DERMIS_TRY(check(stored));
    // The file's own convention is tried first. A profile that is not here, or a path, cannot be compared.
    std::optional<Result<LintReport>> claimed;
    if (own) claimed = lint::measured(lint::sample_of(stored, false), *own, *own);
    const bool holds = claimed && *claimed && (*claimed)->explained;
    // From night to day light rises from 0 to 1: numbers that follow it are a table, whatever its skin.
    const bool is_certain = holds && own->n_dot_l_min == -1 && own->n_dot_l_max == 1;
    if (std::string refusal = lint::refusal_of_picture(stored); !is_certain && !refusal.empty()) {
        LintReport refused{.refusal = std::move(refusal)};
        lint::explain_refusal(refused);
        return refused;
    }
    const lint::Search found = lint::search(stored, holds ? lint::Crops::ignored : lint::Crops::searched);
    const std::vector<LintHypothesis>& all = found.hypotheses;
    Result<LintReport> report = lint::measured(found.sample, all.front(), all.back());
    if (!report) return report;
    std::string differs;
    if (claimed && !*claimed)
        differs = "its own convention was not compared: " + claimed->error().message;
    else if (holds && lint::is_as_good((*claimed)->best.rms, report->best.rms))
        report = *claimed;
    else if (claimed)
        differs = "its own convention does not describe these numbers: they differ from it by rms " +
                  lint::rounded((*claimed)->best.rms) + ", largest " + lint::rounded((*claimed)->best.max);
    for (const LintHypothesis& other : all)
        if (!same_model(other, report->best)) {
            report->runner_up = other;
            break;
        }
    if (is_certain) report->refusal.clear();
    if (!report->refusal.empty())
        lint::explain_refusal(*report);
    else if (!lint::explain_rows(*report, found, image))
        lint::explain(*report, image);
    if (!differs.empty()) report->findings.push_back(differs);
    return report;
}

}  // namespace dermis::inline bake
