#pragma once
// The values of the block Skin (skin.glsl): what a shader without tables computes with.

#include "techniques/preintegrated/tables.h"

namespace dermis::preintegrated {

/// The expressions are fitted with `fit` only, in about 20 ms; otherwise they are 0. Errors: more Gaussians
/// than kMaxGaussians, which profiles of other forms never have; what the fits refuse.
[[nodiscard]] Result<std::vector<NamedValue>> skin_values(const TableSettings& settings,
                                                          const SkinContext& skin, bool fit);

}  // namespace dermis::preintegrated
