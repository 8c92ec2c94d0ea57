#pragma once
// Modelled frames as multiples of the technique that all costs are stated in.

#include <vector>

#include "dermis/judge/scores.h"
#include "dermis/render/catalog.h"
#include "dermis/report/model.h"

namespace dermis::inline report {

/// Costs are stated as a multiple of the baseline's with its defaults.
[[nodiscard]] bool is_cost_base(const Contestant& contestant);

/// Prepends the cost base if it is missing.
[[nodiscard]] Result<std::vector<Contestant>> with_cost_base(std::vector<Contestant> contestants,
                                                             std::span<const Technique> techniques);

/// Milliseconds by the model of a frame of each contestant, whose fragments `device` counts. The scene must
/// be complete (complete_scene). Errors: as Renderer, count_work() and model_frames().
[[nodiscard]] Result<std::vector<double>> model_times_ms(gpu::Device& device, const Catalog& catalog,
                                                         const Scene& scene,
                                                         const std::vector<Contestant>& contestants,
                                                         int width, int height, const Card& card);

/// The same over the base's, which need not be among the contestants.
[[nodiscard]] Result<std::vector<double>> model_ratios(gpu::Device& device, const Catalog& catalog,
                                                       const Scene& scene,
                                                       const std::vector<Contestant>& contestants, int width,
                                                       int height, const Card& card);

/// ScoreRow::model_ratio of the rows of one scene; rows without a technique (kExactId) have none. Errors: as
/// model_ratios(), and a row whose settings its technique does not have.
[[nodiscard]] Result<void> set_model_ratios(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                            std::span<ScoreRow> rows, int width, int height,
                                            const Card& card);

}  // namespace dermis::inline report
