#include "compare_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace dermis::cli {
namespace {

std::string share_text(const CapturedShare& share) {
    char text[16] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.3f", share.share);
    return text;
}

std::string short_text(const CapturedShare& share) {
    char text[16] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.2f", share.share);
    return text;
}

// Right-aligned under its heading.
std::string cell(const std::string& text, const std::string& heading) {
    constexpr size_t kWidth = 15;
    const size_t width = std::max(kWidth, heading.size() + 1);
    return std::string(width - std::min(text.size(), width), ' ') + text;
}

// The table fits 80 columns; a longer name has a line of its own.
constexpr int kNameWidth = 24;

void print_heading(const Comparison& comparison) {
    const auto heading = [](Integrator integrator) { return "of " + std::string(judge_name(integrator)); };
    std::printf("%-*s %10s %5s %6s %6s %6s", kNameWidth, "captured share",
                heading(comparison.integrator).c_str(), "+-", "R", "G", "B");
    if (comparison.second) std::printf(" %10s %5s", heading(*comparison.second_integrator).c_str(), "+-");
    std::printf("\n");
}

std::string interval_text(const CapturedShare& share) {
    // Without an effect there is nothing to be uncertain of.
    char text[16] = "-";
    if (std::isfinite(share.error)) std::snprintf(text, sizeof text, "%.3f", share.error);
    return text;
}

void print_row(const Comparison& comparison, const Compared& row) {
    const std::string name = row.contestant.name();
    const bool fits = name.size() <= size_t(kNameWidth);
    const Captured& c = row.first.captured;
    if (!fits) std::printf("%s\n", name.c_str());
    std::printf("%-*s %10s %5s %6s %6s %6s", kNameWidth, fits ? name.c_str() : "", share_text(c.all).c_str(),
                interval_text(c.all).c_str(), short_text(c.channels[0]).c_str(),
                short_text(c.channels[1]).c_str(), short_text(c.channels[2]).c_str());
    if (comparison.second) {
        const CapturedShare& second = row.second->captured.all;
        std::printf(" %10s %5s", share_text(second).c_str(), interval_text(second).c_str());
    }
    std::printf("\n");
}

void print_effect(Integrator integrator, const EffectReference& reference, const Captured& captured) {
    const CapturedShare& all = captured.all;
    std::printf("%.*s: effect of scattering: rms %.5f (R %.5f, G %.5f, B %.5f);\n",
                int(judge_name(integrator).size()), judge_name(integrator).data(), all.effect_rms,
                captured.channels[0].effect_rms, captured.channels[1].effect_rms,
                captured.channels[2].effect_rms);
    std::printf("  noise %.5f (%.2f of the effect); %d samples a pixel, %s, %.0f s in all\n",
                all.reference_noise, all.effect_rms > 0 ? all.reference_noise / all.effect_rms : 0.0,
                reference.samples, reference.from_cache ? "from the cache" : "made now",
                reference.time_ms / 1000);
}

std::string change_text(const std::optional<ShareChange>& change) {
    char text[40] = "";
    if (change) std::snprintf(text, sizeof text, "%+.4f +-%.4f", change->change, change->error);
    return text;
}

// Rows with bakes of the rest pose: how their share differs from that with bakes of the pose.
void print_changes(const Comparison& comparison) {
    const auto has_change = [](const Compared& row) { return row.remade.has_value(); };
    if (std::ranges::none_of(comparison.rows, has_change)) return;
    std::printf("bakes of the rest pose: change of the share of %s%s%s\n",
                std::string(judge_name(comparison.integrator)).c_str(), comparison.second ? ", of " : "",
                comparison.second ? std::string(judge_name(*comparison.second_integrator)).c_str() : "");
    for (const Compared& row : comparison.rows)
        if (has_change(row))
            std::printf("  %s\n%24s %17s %17s\n", row.contestant.name().c_str(), "",
                        change_text(row.first.change).c_str(),
                        row.second ? change_text(row.second->change).c_str() : "");
}

std::string share_and_error(const CapturedShare& share) {
    char text[32] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.3f +-%.3f", share.share, share.error);
    return text;
}

// A table of one judge: a line a scene, a column a technique.
void print_shares(const std::vector<SubjectCase>& cases, const std::vector<Comparison>& comparisons,
                  Integrator integrator) {
    const std::string heading = "captured share of " + std::string(judge_name(integrator));
    size_t width = heading.size();
    for (const SubjectCase& one : cases) width = std::max(width, one.name.size());
    const std::string exact(kExactId);
    const auto is_exact = [](const Compared& row) { return row.contestant.technique->id == kExactId; };
    std::string line = cell("effect", "") + cell(exact, exact);
    for (const Compared& row : comparisons.front().rows)
        if (!is_exact(row)) line += cell(row.contestant.name(), row.contestant.name());
    std::printf("%-*s%s\n", int(width), heading.c_str(), line.c_str());
    for (size_t i = 0; i < cases.size(); ++i) {
        const std::vector<Compared>& rows = comparisons[i].rows;
        const auto share = [&](const Compared& row) -> const CapturedShare& {
            return judgement_by(integrator, comparisons[i], row)->captured.all;
        };
        char effect[16];
        std::snprintf(effect, sizeof effect, "%.5f", share(rows.front()).effect_rms);
        const auto known = std::ranges::find_if(rows, is_exact);
        line = cell(effect, "") +
               cell(known == rows.end() ? "not known" : share_and_error(share(*known)), exact);
        for (const Compared& row : rows)
            if (!is_exact(row)) line += cell(share_and_error(share(row)), row.contestant.name());
        std::printf("%-*s%s\n", int(width), cases[i].name.c_str(), line.c_str());
    }
}

nlohmann::ordered_json judge_json(Integrator integrator, const EffectReference& reference) {
    return {{"integrator", judge_name(integrator)}, {"effect_rms", reference.noise.effect_rms},
            {"noise", reference.noise.noise_rms},   {"samples", reference.samples},
            {"reached", reference.reached},         {"from_cache", reference.from_cache},
            {"time_ms", reference.time_ms}};
}

}  // namespace

void print_table(const Comparison& comparison) {
    print_heading(comparison);
    for (const Compared& row : comparison.rows) print_row(comparison, row);
    print_changes(comparison);
    print_effect(comparison.integrator, comparison.reference, comparison.rows.front().first.captured);
    if (comparison.second)
        print_effect(*comparison.second_integrator, *comparison.second,
                     comparison.rows.front().second->captured);
}

void print_set_table(const std::vector<SubjectCase>& cases, const std::vector<Comparison>& comparisons) {
    print_shares(cases, comparisons, comparisons.front().integrator);
    if (const auto second = comparisons.front().second_integrator) print_shares(cases, comparisons, *second);
}

void print_clip_table(const std::vector<ClipFrame>& frames) {
    constexpr size_t kShownFrames = 8;
    const bool short_clip = frames.size() <= kShownFrames;
    for (const Integrator integrator : kClipJudges) {
        bool headed = false;
        for (const ClipRow& row : clip_rows(frames)) {
            const std::optional<ClipShare> share = clip_share(frames, row, integrator);
            if (!share) continue;
            if (!std::exchange(headed, true)) {
                std::printf("captured share of %s\n  mean   +-  worst motion   +-",
                            std::string(judge_name(integrator)).c_str());
                for (const ClipFrame& frame : frames)
                    if (short_clip) std::printf(" %4.2f s", frame.time_s);
                std::printf("\n");
            }
            std::printf("%s\n%6.3f %.3f ", row.name().c_str(), share->mean, share->error);
            if (std::isfinite(share->worst))
                std::printf("%5.2f ", share->worst);
            else
                std::printf("noise ");
            if (share->motion)
                std::printf("%6.2f %.2f", *share->motion, share->motion_error);
            else
                std::printf("%11s", "");
            for (const ClipFrame& frame : frames)
                if (const ScoreRow* found = row_of(frame, row); short_clip && found)
                    std::printf(" %6s", short_text(captured_by(integrator, *found)->all).c_str());
            if (share->change)
                std::printf("\n  change by bakes of the rest pose %s, worst %+.4f",
                            change_text(share->change).c_str(), share->worst_change);
            std::printf("\n");
        }
    }
}

nlohmann::ordered_json clip_json(const std::string& clip, const std::vector<ClipFrame>& frames,
                                 const nlohmann::ordered_json& of_frames) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ClipRow& row : clip_rows(frames)) {
        nlohmann::ordered_json entry = {{"technique", row.technique}, {"settings", row.settings}};
        for (const Integrator integrator : kClipJudges) {
            const std::optional<ClipShare> share = clip_share(frames, row, integrator);
            if (!share) continue;
            entry[std::string(judge_name(integrator))] = {
                {"mean", share->mean},
                {"mean_error", share->error},
                {"worst", std::isfinite(share->worst) ? nlohmann::ordered_json(share->worst) : nullptr},
                {"worst_time_s", share->worst_time_s}};
            if (share->motion)
                entry[std::string(judge_name(integrator))].update(
                    {{"motion", *share->motion}, {"motion_error", share->motion_error}});
            if (share->change)
                entry[std::string(judge_name(integrator))].update({{"change", share->change->change},
                                                                   {"change_error", share->change->error},
                                                                   {"worst_change", share->worst_change}});
        }
        rows.push_back(std::move(entry));
    }
    return {{"clip", clip}, {"rows", rows}, {"frames", of_frames}};
}

nlohmann::ordered_json to_json(const std::string& output, const SubjectCase& one,
                               const Comparison& comparison) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ScoreRow& row : score_rows(one.name, comparison)) {
        nlohmann::ordered_json entry = {{"technique", row.technique}, {"settings", row.settings}};
        for (const ScoreColumn& column : score_columns()) {
            const std::optional<double> value = column.get(row);
            entry[std::string(column.name)] =
                value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nullptr;
        }
        for (const auto& [name, change] :
             {std::pair("walk_change", row.walk_change), std::pair("change", row.surface_change)})
            if (change) entry[name] = {{"change", change->change}, {"error", change->error}};
        rows.push_back(std::move(entry));
    }
    auto judges = nlohmann::ordered_json::array({judge_json(comparison.integrator, comparison.reference)});
    if (comparison.second) judges.push_back(judge_json(*comparison.second_integrator, *comparison.second));
    return {{"scene", one.scene.name},
            {"output", output},
            {"judges", judges},
            {"reference_samples", comparison.reference.samples},
            {"reference_reached", comparison.reference.reached},
            {"reference_from_cache", comparison.reference.from_cache},
            {"reference_time_ms", comparison.reference.time_ms},
            {"rows", rows},
            {"credit", one.scene.credit}};
}

}  // namespace dermis::cli
