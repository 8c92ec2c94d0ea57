#pragma once
// Random arguments over the whole domain of every shading function, and the comparison of two results.

#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/shading/shading.h"

namespace dermis::shading {

/// Square, as they are also the pixels of a picture: 102,400 inputs of each function.
inline constexpr int kSampleSide = 320;
inline constexpr size_t kSampleCount = size_t(kSampleSide) * kSampleSide;

/// A function with its arguments, `argument_floats` a sample.
struct Sampled {
    std::string name;
    Type result = Type::scalar;
    std::vector<Type> arguments;
    size_t argument_floats = 0;
    std::vector<float> inputs;
    double relative_bound = 0;  ///< of a difference between two languages, of the value or of 0.1
};

/// Every function of `units`. Errors: a parameter whose domain samples.cpp does not name.
[[nodiscard]] Result<std::vector<Sampled>> sample_functions(const std::vector<Unit>& units);

/// Four floats a sample, unused ones 0; in the order of the functions.
using Outputs = std::vector<std::vector<float>>;

/// The largest difference over the function's bound: 1 is just allowed. Infinite where one is not a number.
/// The shorter one counts.
[[nodiscard]] double worst_difference(const Sampled& function, const std::vector<float>& a,
                                      const std::vector<float>& b);

}  // namespace dermis::shading
