#include "compare_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dermis::cli {
namespace {

std::string share_text(const CapturedShare& share) {
    char text[16] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.3f", share.share);
    return text;
}

// Right-aligned under its heading.
std::string cell(const std::string& text, const std::string& heading) {
    constexpr size_t kWidth = 15;
    const size_t width = std::max(kWidth, heading.size() + 1);
    return std::string(width - std::min(text.size(), width), ' ') + text;
}

std::string share_and_error(const CapturedShare& share) {
    char text[32] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.3f +-%.3f", share.share, share.error);
    return text;
}

}  // namespace

void print_table(const Comparison& comparison) {
    std::printf("%-48s %8s %6s %7s %7s %7s %9s %7s %7s %9s\n", "technique", "captured", "+-", "R", "G", "B",
                "rmse", "flip", "dE2000", "ms");
    for (const Compared& row : comparison.rows) {
        const Captured& c = row.captured;
        // Without an effect there is nothing to be uncertain of.
        char error[16] = "-";
        if (std::isfinite(c.all.error)) std::snprintf(error, sizeof error, "%.3f", c.all.error);
        std::printf("%-48s %8s %6s %7s %7s %7s %9.5f %7.4f %7.3f %9.2f\n", row.contestant.name().c_str(),
                    share_text(c.all).c_str(), error, share_text(c.channels[0]).c_str(),
                    share_text(c.channels[1]).c_str(), share_text(c.channels[2]).c_str(), row.scores.rmse,
                    row.scores.flip, row.scores.delta_e_2000, row.cost.time_ms);
    }
    const CapturedShare& all = comparison.rows.front().captured.all;
    std::printf("effect of scattering: rms %.5f (R %.5f, G %.5f, B %.5f)\n", all.effect_rms,
                comparison.rows.front().captured.channels[0].effect_rms,
                comparison.rows.front().captured.channels[1].effect_rms,
                comparison.rows.front().captured.channels[2].effect_rms);
    std::printf(
        "the reference's noise: rms %.5f in the effect (%.2f of it), %.5f in the picture; %d samples a "
        "pixel, %s\n",
        all.reference_noise, all.effect_rms > 0 ? all.reference_noise / all.effect_rms : 0.0,
        comparison.reference_rmse, comparison.reference.samples,
        comparison.reference.from_cache ? "from the cache" : "made now");
}

void print_set_table(const std::vector<SubjectCase>& cases, const std::vector<Comparison>& comparisons) {
    constexpr std::string_view kHeading = "captured share";
    size_t width = kHeading.size();
    for (const SubjectCase& one : cases) width = std::max(width, one.name.size());
    const std::string exact(kExactId);
    const auto is_exact = [](const Compared& row) { return row.contestant.technique->id == kExactId; };
    std::string line = cell("effect", "") + cell(exact, exact);
    for (const Compared& row : comparisons.front().rows)
        if (!is_exact(row)) line += cell(row.contestant.name(), row.contestant.name());
    std::printf("%-*s%s\n", int(width), kHeading.data(), line.c_str());
    for (size_t i = 0; i < cases.size(); ++i) {
        const std::vector<Compared>& rows = comparisons[i].rows;
        char effect[16];
        std::snprintf(effect, sizeof effect, "%.5f", rows.front().captured.all.effect_rms);
        const auto known = std::ranges::find_if(rows, is_exact);
        line = cell(effect, "") +
               cell(known == rows.end() ? "not known" : share_and_error(known->captured.all), exact);
        for (const Compared& row : rows)
            if (!is_exact(row)) line += cell(share_and_error(row.captured.all), row.contestant.name());
        std::printf("%-*s%s\n", int(width), cases[i].name.c_str(), line.c_str());
    }
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
        rows.push_back(std::move(entry));
    }
    return {{"scene", one.scene.name},
            {"output", output},
            {"reference_samples", comparison.reference.samples},
            {"reference_reached", comparison.reference.reached},
            {"reference_from_cache", comparison.reference.from_cache},
            {"reference_time_ms", comparison.reference.time_ms},
            {"rows", rows},
            {"credit", one.scene.credit}};
}

}  // namespace dermis::cli
