#pragma once
// The error of a table in its file: a bilinear lookup compared with the exact function; as
// numbers and as a plot.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"
#include "dermis/plot/plot.h"

namespace dermis::inline bake {

/// The exact function of the table's convention (construction, variance scale; taps count as error) at many u
/// for one v, as axis values.
using ExactFunction = std::function<Result<std::vector<Rgb>>(std::span<const double> u, double v)>;

/// `profile` is the one the table was baked from; it is not used for Beckmann tables and must outlive the
/// result.
[[nodiscard]] ExactFunction exact_function(const Table& table, const Profile& profile);

struct LookupError {
    double max = 0, rms = 0;
    double u = 0, v = 0;  ///< axis values of the largest error
};

/// Over 257 x 65 positions between and on texel centres, from the first to the last centre; all channels.
/// Takes 65 rows of the exact function.
[[nodiscard]] Result<LookupError> lookup_error(const Table& table, const ExactFunction& exact);

/// Curves at four rows (radii or widths of 2, 4, 8, 16 mm, roughness 0.1 to 0.6, orders 0 to 2) per channel,
/// and the error of a lookup in the quantised table. A table that is not the sphere's also shows the sphere,
/// dashed.
[[nodiscard]] Result<Plot> table_plot(const Table& table, const Profile& profile, TableStorage storage);

/// "256 x 256 diffuse, sphere, gpu_gems_3, n_dot_l -1..1, curvature_per_mm 0..0.5, linear"
[[nodiscard]] std::string describe(const Table& table);

}  // namespace dermis::inline bake
