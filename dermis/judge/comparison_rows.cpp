// What others read of the rows of a comparison.

#include "dermis/judge/comparison.h"

namespace dermis::inline judge {

const Judgement* judgement_by(Integrator integrator, const Comparison& comparison, const Compared& row) {
    if (comparison.integrator == integrator) return &row.first;
    return comparison.second_integrator == integrator && row.second ? &*row.second : nullptr;
}

const Image* judged_effect(Integrator integrator, const Comparison& comparison, const Compared& row) {
    if (comparison.integrator == integrator) return &row.effect;
    return comparison.second_integrator == integrator ? &row.effect_of_second() : nullptr;
}

std::string_view judge_name(Integrator integrator) {
    return integrator == Integrator::walk ? "walk" : "surface";
}

std::vector<ScoreRow> score_rows(const std::string& scene, const Comparison& comparison) {
    std::vector<ScoreRow> rows;
    const auto share_by = [&](Integrator integrator, const Compared& row) {
        const Judgement* found = judgement_by(integrator, comparison, row);
        return found ? std::optional(found->captured) : std::nullopt;
    };
    const auto change_by = [&](Integrator integrator, const Compared& row) {
        const Judgement* found = judgement_by(integrator, comparison, row);
        return found ? found->change : std::nullopt;
    };
    for (const Compared& row : comparison.rows)
        rows.push_back({.scene = scene,
                        .technique = row.contestant.technique->id,
                        .settings = row.contestant.settings,
                        .walk = share_by(Integrator::walk, row),
                        .surface = share_by(Integrator::surface, row),
                        .scores = row.scores,
                        .time_ms = row.cost.time_ms,
                        .bytes = row.cost.bytes(),
                        .time_ratio = row.cost.time_ratio,
                        .reference_rmse = comparison.reference_rmse,
                        .walk_change = change_by(Integrator::walk, row),
                        .surface_change = change_by(Integrator::surface, row)});
    return rows;
}

}  // namespace dermis::inline judge
