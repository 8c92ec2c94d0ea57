#pragma once
// The shadow of a straight edge, for the bakers of its scattering and for the unit scenes' exact answers.

namespace dermis::inline optics {

/// Share of a normal distribution below `z` standard deviations: a step that a Gaussian blurs.
[[nodiscard]] double normal_cdf(double z);

/// Share of a disk on the lit side of a straight edge that lies `t` radii, -1 to 1, behind its middle; 0 and
/// 1 past these.
[[nodiscard]] double disk_share(double t);

/// Its inverse: within 1e-9, and -1 or 1 past 0 and 1.
[[nodiscard]] double disk_offset(double share);

}  // namespace dermis::inline optics
