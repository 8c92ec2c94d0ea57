#pragma once
// What `dermis compare` shows while it works: a line with the best share so far, and the shares of all
// techniques each time that their intervals have halved.

#include <optional>
#include <string>
#include <vector>

#include "dermis/base/progress.h"
#include "dermis/judge/comparison.h"

namespace dermis::cli {

/// Which of several comparisons runs; `what` is its text, "frame 3/8: ".
struct ComparisonTurn {
    std::string what;
    size_t index = 0, count = 1;
};

/// Shares of all rows by one reference.
struct JudgedShares {
    Integrator integrator;
    std::vector<CapturedShare> shares;
};

class ComparisonProgress {
  public:
    /// Of several comparisons in turn, the line shows how much of all is done, and shares are not printed.
    explicit ComparisonProgress(ComparisonTurn turn) : turn_(std::move(turn)), line_(turn_.what, 0) {}

    /// Valid as long as this object.
    [[nodiscard]] ComparisonHooks hooks();

  private:
    void show(double done, const std::string& text);
    void keep(JudgedShares now, const std::vector<Compared>& rows);

    ComparisonTurn turn_;
    std::string best_;
    Progress line_;
    std::vector<JudgedShares> judged_;  ///< the latest of each reference
    size_t printed_judges_ = 0;         ///< references whose shares were last printed
    double printed_ = 0;                ///< their widest interval then
    bool says_stopped_ = false;
};

/// A heading with the references, then a line a technique that scatters, at most 79 columns wide.
[[nodiscard]] std::vector<std::string> shares_so_far(const std::vector<Compared>& rows,
                                                     const std::vector<JudgedShares>& judged);

}  // namespace dermis::cli
