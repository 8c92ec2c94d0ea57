#include "comparison_progress.h"

#include <fmt/core.h>
#include <algorithm>

#include "stop_on_signals.h"

namespace dermis::cli {
namespace {

// Half the 95 % interval below which a share says something.
constexpr double kTelling = 0.3;
// Shares so far are printed where the final ones take longer than this.
constexpr double kLongS = 2;

double widest(const std::vector<JudgedShares>& judged) {
    double most = 0;
    for (const JudgedShares& of : judged)
        for (const CapturedShare& share : of.shares) most = std::max(most, share.error);
    return most;
}

std::string cells(const CapturedShare& share) {
    if (share.error < kTelling) return fmt::format(" {:>10.2f} {:>5.2f}", share.share, share.error);
    return fmt::format(" {:>10} {:>5}", "noise", "");
}

}  // namespace

std::vector<std::string> shares_so_far(const std::vector<Compared>& rows,
                                       const std::vector<JudgedShares>& judged) {
    constexpr size_t kNameColumns = 43;
    std::string heading = fmt::format("{:<{}}", "captured share so far", kNameColumns);
    for (const JudgedShares& of : judged)
        heading += fmt::format(" {:>10} {:>5}", "of " + std::string(judge_name(of.integrator)), "+-");
    std::vector<std::string> lines = {heading};
    for (size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].contestant.technique->is_baseline) continue;
        std::string name = rows[i].contestant.name();
        if (name.size() > kNameColumns) name = name.substr(0, kNameColumns - 3) + "...";
        std::string line = fmt::format("{:<{}}", name, kNameColumns);
        for (const JudgedShares& of : judged) line += cells(of.shares[i]);
        lines.push_back(std::move(line));
    }
    return lines;
}

ComparisonHooks ComparisonProgress::hooks() {
    return {.progress = [this](double done, const std::string& name) { show(done, name + best_); },
            .shares =
                [this](Integrator integrator, const std::vector<Compared>& rows,
                       const std::vector<CapturedShare>& shares) {
                    keep({integrator, shares}, rows);
                },
            .stop = &stop_requested()};
}

void ComparisonProgress::show(double done, const std::string& text) {
    if (stop_requested() && !says_stopped_) {
        says_stopped_ = true;
        line_.print({"stopped: what there is is judged and reported (again: ends at once)"});
    }
    line_.set((double(turn_.index) + done) / double(turn_.count), turn_.what + text);
}

void ComparisonProgress::keep(JudgedShares now, const std::vector<Compared>& rows) {
    const auto best = std::ranges::max_element(now.shares, {}, &CapturedShare::share);
    best_ =
        fmt::format(": {} {:.2f} +-{:.2f}", rows[size_t(best - now.shares.begin())].contestant.technique->id,
                    best->share, best->error);
    const auto before = std::ranges::find(judged_, now.integrator, &JudgedShares::integrator);
    if (before == judged_.end())
        judged_.push_back(std::move(now));
    else
        *before = std::move(now);
    const double interval = widest(judged_);
    if (turn_.count > 1 || interval > (printed_judges_ == judged_.size() ? printed_ / 2 : kTelling)) return;
    if (line_.left_s().value_or(0) < kLongS) return;
    printed_judges_ = judged_.size();
    printed_ = interval;
    line_.print(shares_so_far(rows, judged_));
}

}  // namespace dermis::cli
