#include "dermis/judge/technique_cost.h"

#include <algorithm>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

namespace dermis::inline judge {
namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

Result<void> measure_bytes(const Scene& scene, const Contestant& contestant, int width, int height,
                           TechniqueCost& cost) {
    const Technique& technique = *contestant.technique;
    const PassList list = technique.build(contestant.values, {});
    for (const ImageDeclaration& image : list.images)
        cost.image_bytes += bytes_in_frame(image, width, height);
    if (!technique.tables) return {};
    const Result<Profile> profile = find_profile(scene.skin.profile);
    if (!profile) return profile.error();
    DERMIS_TRY_ASSIGN(const auto tables,
                      technique.tables(contestant.values, {.profile = *profile,
                                                           .gaussians = to_gaussian_sum(*profile).sum,
                                                           .diffuse_table = scene.skin.diffuse_table,
                                                           .zonal_table = scene.skin.zonal_table,
                                                           .beckmann_table = scene.skin.beckmann_table}));
    for (const TableImage& table : tables) cost.table_bytes += table.bytes.size();
    return {};
}

}  // namespace

Result<std::vector<TechniqueCost>> measure_costs(
    Renderer& renderer, const Scene& scene, const std::vector<Contestant>& contestants, int width, int height,
    int frames, const std::function<void(double done, const std::string& name)>& progress,
    const std::atomic<bool>* stop) {
    std::vector<TechniqueCost> costs(contestants.size());
    for (size_t i = 0; i < costs.size(); ++i)
        DERMIS_TRY(measure_bytes(scene, contestants[i], width, height, costs[i]));
    if (frames == 0) return costs;
    std::vector<std::vector<double>> times(costs.size());
    for (int frame = 0; frame <= frames && !(stop && stop->load()); ++frame)
        for (size_t i = 0; i < costs.size(); ++i) {
            const Contestant& contestant = contestants[i];
            const double all = double(frames + 1) * double(costs.size());
            if (progress)
                progress((double(frame) * double(costs.size()) + double(i)) / all, contestant.name());
            const auto drawn =
                renderer.draw(*contestant.technique, contestant.values, {.width = width, .height = height});
            if (!drawn) return Error{contestant.name() + ": " + drawn.error().message};
            if (frame > 0) times[i].push_back(drawn->frame_ms);
        }
    const auto baseline = std::ranges::find_if(
        contestants, [](const Contestant& contestant) { return contestant.technique->is_baseline; });
    for (size_t i = 0; i < costs.size(); ++i) {
        costs[i].time_ms = median(times[i]);
        if (baseline == contestants.end()) continue;
        std::vector<double> ratios;
        const std::vector<double>& base = times[size_t(baseline - contestants.begin())];
        for (size_t frame = 0; frame < base.size(); ++frame) ratios.push_back(times[i][frame] / base[frame]);
        costs[i].time_ratio = median(ratios);
    }
    return costs;
}

}  // namespace dermis::inline judge
