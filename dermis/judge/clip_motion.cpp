#include "dermis/judge/clip_motion.h"

#include <algorithm>

namespace dermis::inline judge {
namespace {

Image common_skin(const Image& before, const Image& now) {
    Image common = now;
    for (size_t i = 0; i < common.pixel_count(); ++i)
        if (before.floats()[i] <= 0) common.floats()[i] = 0;
    return common;
}

}  // namespace

ClipEffects clip_effects(const Comparison& comparison) {
    ClipEffects kept{.skin = comparison.masks.skin};
    for (size_t judge = 0; judge < std::size(kClipJudges); ++judge) {
        if (kClipJudges[judge] == comparison.integrator) kept.references[judge] = comparison.reference.effect;
        if (kClipJudges[judge] == comparison.second_integrator)
            kept.references[judge] = comparison.second->effect;
    }
    for (const Compared& row : comparison.rows) {
        ClipEffects::Row own{.row = {row.contestant.technique->id, row.contestant.settings}, .effects = {}};
        for (size_t judge = 0; judge < std::size(kClipJudges); ++judge)
            if (const Image* effect = judged_effect(kClipJudges[judge], comparison, row))
                own.effects[judge] = *effect;
        kept.rows.push_back(std::move(own));
    }
    return kept;
}

Result<void> set_motion_shares(const ClipEffects& before, const ClipEffects& now,
                               std::vector<ScoreRow>& rows) {
    const Image skin = common_skin(before.skin, now.skin);
    if (std::ranges::none_of(skin.floats(), [](float inside) { return inside > 0; })) return {};
    for (size_t judge = 0; judge < std::size(kClipJudges); ++judge) {
        if (!before.references[judge] || !now.references[judge]) continue;
        const EffectHalves moved{difference(now.references[judge]->a, before.references[judge]->a),
                                 difference(now.references[judge]->b, before.references[judge]->b)};
        for (size_t i = 0; i < now.rows.size(); ++i) {
            const auto same = std::ranges::find(before.rows, now.rows[i].row, &ClipEffects::Row::row);
            if (same == before.rows.end()) continue;
            Result<Captured> share =
                captured(difference(now.rows[i].effects[judge], same->effects[judge]), moved, skin);
            if (!share) return share.error().within(now.rows[i].row.name());
            (kClipJudges[judge] == Integrator::walk ? rows[i].walk_motion : rows[i].surface_motion) =
                std::move(*share);
        }
    }
    return {};
}

Result<void> ComparedFrames::add(const std::string& name, double time_s, const Comparison& comparison) {
    all.push_back({.time_s = time_s, .rows = score_rows(name, comparison)});
    ClipEffects effects = clip_effects(comparison);
    if (last) DERMIS_TRY(set_motion_shares(*last, effects, all.back().rows));
    last = std::move(effects);
    return {};
}

}  // namespace dermis::inline judge
