#pragma once
// What `dermis compare` shows while it works: one line at a time, with the best share so far.

#include <optional>
#include <string>

#include "dermis/base/progress.h"
#include "dermis/judge/comparison.h"

namespace dermis::cli {

/// Which of several comparisons runs; `what` is its text, "frame 3/8: ".
struct ComparisonTurn {
    std::string what;
    size_t index = 0, count = 1;
};

/// The steps are the references' first samples, the techniques, the rest of the references.
class ComparisonProgress {
  public:
    /// Of several comparisons in turn, the line shows how much of all is done.
    explicit ComparisonProgress(ComparisonTurn turn) : turn_(std::move(turn)) {}

    /// Valid as long as this object.
    [[nodiscard]] ComparisonHooks hooks();

  private:
    void show(int step, double done, const std::string& text);
    void keep_best(const std::vector<Compared>& rows, const std::vector<CapturedShare>& shares);

    ComparisonTurn turn_;
    std::string best_;
    std::optional<Progress> line_;
    int step_ = 0;
    bool drawn_ = false;
};

}  // namespace dermis::cli
