#pragma once
// Axes of a plot: their range from the data, their ticks from the range. Internal to dermis/plot.

#include <cmath>
#include <string>
#include <vector>

#include "dermis/plot/plot.h"

namespace dermis::inline plot {

struct PlotTick {
    double value;
    std::string label;  ///< markup; empty: a thin grid line only
};

/// A resolved axis: position() maps [min, max] to [0, 1].
struct PlotAxisScale {
    PlotScale kind;
    double min, max;

    bool shows(double value) const {
        return std::isfinite(value) && (kind == PlotScale::linear || value > 0);
    }
    double position(double value) const {
        if (kind == PlotScale::linear) return (value - min) / (max - min);
        return std::log(value / min) / std::log(max / min);
    }
};

/// Range of x or of y (`values`) over all series of the panel. `rounded`: outwards to a tick.
[[nodiscard]] PlotAxisScale resolve_axis(const PlotPanel& panel, const PlotAxis& axis,
                                         std::vector<double> PlotSeries::*values, bool rounded);

[[nodiscard]] std::vector<PlotTick> axis_ticks(const PlotAxisScale& scale, double length_px);

}  // namespace dermis::inline plot
