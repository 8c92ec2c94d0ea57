#pragma once
// The bust cut into discs for texturing: the head opened along the back (with the backs of the ears), the
// front of each ear, the underside.

#include "subjects/bust/field.h"
#include "subjects/bust/surface.h"

namespace dermis::bust {

enum class ChartKind { head, left_ear, right_ear, underside };
inline constexpr int kChartCount = 4;

/// A piece of the surface with its own vertices: those on a seam appear once a side.
struct Chart {
    ChartKind kind = ChartKind::head;
    Surface mesh;
    std::vector<int> corners;  ///< boundary vertices that hold the chart's shape: one or two, see flatten.h
};

/// One chart per kind, each in one piece.
[[nodiscard]] std::vector<Chart> cut_charts(Surface surface, const BustField& field);

/// The boundaries of a surface as loops of vertices, inside on the left, longest first.
[[nodiscard]] std::vector<std::vector<int>> boundary_loops(const Surface& surface);

}  // namespace dermis::bust
