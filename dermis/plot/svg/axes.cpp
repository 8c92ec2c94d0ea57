#include "dermis/plot/svg/axes.h"

#include <algorithm>
#include <limits>

#include "dermis/base/text.h"

namespace dermis::inline plot {
namespace {

constexpr double kMaxAutomaticDecades = 8;

// The step of 1, 2 or 5 times a power of ten that gives about `count` ticks.
double nice_step(double range, double count) {
    const double rough = range / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double lead = rough / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

std::string linear_label(double value, double step) {
    // Rounded to the step's own digits: 0.30000000000000004 is 0.3.
    const double digits = std::pow(10.0, std::max(0.0, 1 - std::floor(std::log10(step))));
    const double rounded = digits < 1e12 ? std::round(value * digits) / digits : value;
    return to_text(rounded == 0 ? 0.0 : rounded);
}

std::string power_label(int mantissa, int exponent) {
    if (exponent >= -3 && exponent <= 4) return to_text(mantissa * std::pow(10.0, exponent));
    const std::string lead = mantissa == 1 ? "" : std::to_string(mantissa) + "·";
    return lead + "10<tspan dy=\"-4\" font-size=\"9\">" + std::to_string(exponent) + "</tspan>";
}

std::vector<PlotTick> logarithmic_ticks(const PlotAxisScale& scale) {
    std::vector<PlotTick> ticks;
    const double decades = std::log10(scale.max / scale.min);
    const int first = int(std::floor(std::log10(scale.min) - 1e-9));
    const int last = int(std::ceil(std::log10(scale.max) + 1e-9));
    const int stride = std::max(1, int(std::ceil(decades / 8)));
    for (int exponent = first; exponent <= last; ++exponent)
        for (int mantissa = 1; mantissa <= 9; ++mantissa) {
            const double value = mantissa * std::pow(10.0, exponent);
            if (value < scale.min * (1 - 1e-9) || value > scale.max * (1 + 1e-9)) continue;
            const bool labelled = mantissa == 1 ? (exponent - first) % stride == 0
                                                : decades < 2 && (mantissa == 2 || mantissa == 5);
            if (labelled)
                ticks.push_back({value, power_label(mantissa, exponent)});
            else if (decades < 5)
                ticks.push_back({value, ""});
        }
    return ticks;
}

// Rounding y outwards keeps curves inside the frame; x keeps the exact range of the data.
void round_outwards(PlotAxisScale& scale, const PlotAxis& axis) {
    if (scale.kind == PlotScale::logarithmic) {
        if (!axis.max) scale.max = std::pow(10.0, std::ceil(std::log10(scale.max) - 1e-9));
        if (!axis.min) scale.min = std::pow(10.0, std::floor(std::log10(scale.min) + 1e-9));
        if (!axis.min) scale.min = std::max(scale.min, scale.max * std::pow(10.0, -kMaxAutomaticDecades));
        return;
    }
    const double step = nice_step(scale.max - scale.min, 5);
    if (!axis.max) scale.max = step * std::ceil(scale.max / step - 1e-9);
    if (!axis.min) scale.min = step * std::floor(scale.min / step + 1e-9);
}

}  // namespace

std::vector<PlotTick> axis_ticks(const PlotAxisScale& scale, double length_px) {
    if (scale.kind == PlotScale::logarithmic) return logarithmic_ticks(scale);
    std::vector<PlotTick> ticks;
    const double step = nice_step(scale.max - scale.min, std::max(2.0, length_px / 55));
    const double first = std::ceil(scale.min / step - 1e-9), last = std::floor(scale.max / step + 1e-9);
    for (double i = first; i <= last; ++i) ticks.push_back({i * step, linear_label(i * step, step)});
    return ticks;
}

PlotAxisScale resolve_axis(const PlotPanel& panel, const PlotAxis& axis,
                           std::vector<double> PlotSeries::*values, bool rounded) {
    PlotAxisScale scale{axis.scale, std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
    for (const PlotSeries& series : panel.series)
        for (const double value : series.*values)
            if (scale.shows(value)) {
                scale.min = std::min(scale.min, value);
                scale.max = std::max(scale.max, value);
            }
    const bool logarithmic = axis.scale == PlotScale::logarithmic;
    if (!(scale.min <= scale.max)) scale.min = logarithmic ? 0.1 : 0, scale.max = 1;  // nothing to show
    if (axis.min && scale.shows(*axis.min)) scale.min = *axis.min;
    if (axis.max && scale.shows(*axis.max)) scale.max = *axis.max;
    if (!(scale.min < scale.max)) {  // one value: widen the range
        if (logarithmic)
            scale.max = scale.min * 10;
        else
            scale.max = scale.min + std::max(1e-6, std::abs(scale.min) * 0.1);
    }
    if (rounded) round_outwards(scale, axis);
    return scale;
}

}  // namespace dermis::inline plot
