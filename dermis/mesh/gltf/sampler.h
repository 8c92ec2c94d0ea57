#pragma once
// Values between the keys of an animation. Internal to dermis/mesh.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dermis::inline mesh::gltf {

enum class Interpolation : uint8_t { step, linear, cubic_spline };

/// Keys of one channel: a time each, and `width` numbers each; three times as many for cubic splines
/// (in-tangent, value, out-tangent).
struct Keys {
    Interpolation interpolation = Interpolation::linear;
    size_t width = 1;
    std::vector<float> times_s;  ///< at least one, never decreasing
    std::vector<float> values;
};

/// `width` numbers; the first key before it, the last behind it. `rotation`: quaternions x y z w, along the
/// great arc, of length 1.
[[nodiscard]] std::vector<double> sample(const Keys& keys, double time_s, bool rotation);

/// A cubic spline as linear keys: its own, and between two of them as many as leave `step_s` or less, 63 at
/// most. Keys of another interpolation are returned as they are.
[[nodiscard]] Keys linear_keys(const Keys& keys, double step_s, bool rotation);

}  // namespace dermis::inline mesh::gltf
