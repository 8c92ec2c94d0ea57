#include "dermis/report/ratios.h"

#include <algorithm>

#include "dermis/judge/comparison.h"

namespace dermis::inline report {

bool is_cost_base(const Contestant& contestant) {
    return contestant.technique->is_baseline && contestant.settings.empty();
}

Result<std::vector<Contestant>> with_cost_base(std::vector<Contestant> contestants,
                                               std::span<const Technique> techniques) {
    if (std::ranges::any_of(contestants, is_cost_base)) return contestants;
    DERMIS_TRY_ASSIGN(const Technique* base, find_baseline(techniques));
    contestants.insert(contestants.begin(), {.technique = base, .values = ParameterValues(base->parameters)});
    return contestants;
}

Result<std::vector<double>> model_times_ms(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                           const std::vector<Contestant>& contestants, int width, int height,
                                           const Card& card) {
    const gpu::ShaderSource shaders = gpu::embedded_shaders(catalog.shaders);
    DERMIS_TRY_ASSIGN(Renderer renderer, Renderer::create(device, shaders, scene));
    std::vector<FrameWork> frames;
    for (const Contestant& contestant : contestants) {
        DERMIS_TRY_ASSIGN(FrameWork work, count_work(renderer, contestant, width, height));
        frames.push_back(std::move(work));
    }
    DERMIS_TRY_ASSIGN(const std::vector<FrameCost> costs, model_frames(frames, card, shaders));
    std::vector<double> times_ms;
    for (const FrameCost& cost : costs) times_ms.push_back(cost.model_ms());
    return times_ms;
}

Result<std::vector<double>> model_ratios(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                         const std::vector<Contestant>& contestants, int width, int height,
                                         const Card& card) {
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> with_base,
                      with_cost_base(contestants, catalog.techniques));
    DERMIS_TRY_ASSIGN(std::vector<double> ratios,
                      model_times_ms(device, catalog, scene, with_base, width, height, card));
    const auto base = std::ranges::find_if(with_base, is_cost_base);
    const double base_ms = (ratios)[size_t(base - with_base.begin())];
    for (double& value : ratios) value /= base_ms;
    if (with_base.size() > contestants.size()) ratios.erase(ratios.begin());
    return ratios;
}

Result<void> set_model_ratios(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                              std::span<ScoreRow> rows, int width, int height, const Card& card) {
    const auto has_cost = [](const ScoreRow& row) { return row.technique != kExactId; };
    std::string list;
    for (const ScoreRow& row : rows) {
        if (!has_cost(row)) continue;
        list += (list.empty() ? "" : ",") + row.technique;
        if (!row.settings.empty()) list += "[" + row.settings + "]";
    }
    if (list.empty()) return {};
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants,
                      parse_technique_list(catalog.techniques, list));
    DERMIS_TRY_ASSIGN(const std::vector<double> ratios,
                      model_ratios(device, catalog, scene, contestants, width, height, card));
    size_t next = 0;
    for (ScoreRow& row : rows)
        if (has_cost(row)) row.model_ratio = ratios[next++];
    return {};
}

}  // namespace dermis::inline report
