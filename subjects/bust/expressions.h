#pragma once
// Expressions of the bust: fields of displacement over the standard head, as strong as their weights. The
// lids are closed and the mouth has no inside, so there is no blink; jawOpen parts the lips over a cavity of
// skin.

#include <array>
#include <string_view>

#include "dermis/mesh/pose.h"
#include "subjects/bust/point.h"

namespace dermis::bust {

inline constexpr std::string_view kExpressions[] = {"smile", "jawOpen", "browsUp", "squintL", "squintR"};
/// 0 none, 1 the full expression; in the order of kExpressions.
using ExpressionWeights = std::array<double, std::size(kExpressions)>;

/// How far a point of the surface at rest moves, mm; both in the standard head. `normal`: there, outward.
[[nodiscard]] Point expression_move(Point p, Point normal, const ExpressionWeights& weights);

/// The expressions as targets, and the clip "greet".
[[nodiscard]] Motion bust_motion();
/// Weights of a pose.
[[nodiscard]] ExpressionWeights expression_weights(const Pose& pose);

}  // namespace dermis::bust
