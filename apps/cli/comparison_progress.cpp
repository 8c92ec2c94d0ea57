#include "comparison_progress.h"

#include <fmt/core.h>
#include <algorithm>

#include "stop_on_signals.h"

namespace dermis::cli {

ComparisonHooks ComparisonProgress::hooks() {
    return {.reference = [this](double done,
                                const std::string& name) { show(drawn_ ? 3 : 1, done, name + best_); },
            .techniques =
                [this](double done, const std::string& name) {
                    drawn_ = true;
                    show(2, done, name);
                },
            .shares = [this](Integrator, const std::vector<Compared>& rows,
                             const std::vector<CapturedShare>& shares) { keep_best(rows, shares); },
            .stop = &stop_requested()};
}

void ComparisonProgress::show(int step, double done, const std::string& text) {
    constexpr int kSteps = 3;
    const bool several = turn_.count > 1;
    if (!line_ || (!several && step != step_)) line_.emplace(turn_.what, 0);
    step_ = step;
    const double of_all = (double(turn_.index) + (step - 1 + done) / kSteps) / double(turn_.count);
    line_->set(several ? of_all : done, std::to_string(step) + "/3 " + turn_.what + text);
}

void ComparisonProgress::keep_best(const std::vector<Compared>& rows,
                                   const std::vector<CapturedShare>& shares) {
    const size_t best = size_t(std::ranges::max_element(shares, {}, &CapturedShare::share) - shares.begin());
    best_ = fmt::format(": {} {:.2f} +-{:.2f}", rows[best].contestant.technique->id, shares[best].share,
                        shares[best].error);
}

}  // namespace dermis::cli
