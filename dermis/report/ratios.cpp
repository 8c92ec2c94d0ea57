#include "dermis/report/ratios.h"

#include <algorithm>

#include "dermis/judge/comparison.h"

namespace dermis {

Result<std::vector<Contestant>> with_cost_base(std::vector<Contestant> contestants,
                                               std::span<const Technique> techniques) {
    const bool has_base =
        std::ranges::any_of(contestants, [](const Contestant& one) { return one.name() == kCostBase; });
    if (has_base) return contestants;
    const Result<const Technique*> base = find_technique(techniques, kCostBase);
    if (!base) return base.error();
    contestants.insert(contestants.begin(),
                       {.technique = *base, .values = ParameterValues((*base)->parameters)});
    return contestants;
}

Result<std::vector<double>> model_times_ms(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                           const std::vector<Contestant>& contestants, int width, int height,
                                           const Card& card) {
    const gpu::ShaderSource shaders = gpu::embedded_shaders(catalog.shaders);
    Result<Renderer> renderer = Renderer::create(device, shaders, scene);
    if (!renderer) return renderer.error();
    std::vector<FrameWork> frames;
    for (const Contestant& contestant : contestants) {
        Result<FrameWork> work = count_work(*renderer, contestant, width, height);
        if (!work) return work.error();
        frames.push_back(std::move(*work));
    }
    const Result<std::vector<FrameCost>> costs = model_frames(frames, card, shaders);
    if (!costs) return costs.error();
    std::vector<double> times_ms;
    for (const FrameCost& cost : *costs) times_ms.push_back(cost.model_ms());
    return times_ms;
}

Result<std::vector<double>> model_ratios(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                         const std::vector<Contestant>& contestants, int width, int height,
                                         const Card& card) {
    const Result<std::vector<Contestant>> with_base = with_cost_base(contestants, catalog.techniques);
    if (!with_base) return with_base.error();
    Result<std::vector<double>> ratios =
        model_times_ms(device, catalog, scene, *with_base, width, height, card);
    if (!ratios) return ratios;
    const auto base =
        std::ranges::find_if(*with_base, [](const Contestant& one) { return one.name() == kCostBase; });
    const double base_ms = (*ratios)[size_t(base - with_base->begin())];
    for (double& value : *ratios) value /= base_ms;
    if (with_base->size() > contestants.size()) ratios->erase(ratios->begin());
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
    const Result<std::vector<Contestant>> contestants = parse_technique_list(catalog.techniques, list);
    if (!contestants) return contestants.error();
    const Result<std::vector<double>> ratios =
        model_ratios(device, catalog, scene, *contestants, width, height, card);
    if (!ratios) return ratios.error();
    size_t next = 0;
    for (ScoreRow& row : rows)
        if (has_cost(row)) row.model_ratio = (*ratios)[next++];
    return {};
}

}  // namespace dermis
