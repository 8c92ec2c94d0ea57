#pragma once
// What a normalised profile leaves out: how much more or less than flat skin a place returns
// (docs/transport.md). For every technique whose shader includes shaders/include/gain.glsl.

#include <string>
#include <vector>

#include "dermis/base/parameter.h"
#include "dermis/technique/pass_list.h"
#include "shaders/include/constants.h"

namespace dermis::inline technique {

enum class Gain : int32_t {
    none = kGainNone,
    curvature = kGainCurvature,
    map = kGainMap,
    links = kGainLinks
};

[[nodiscard]] const std::vector<std::string>& gain_names();
inline constexpr const char* kGainHelp =
    "light that skin returns beyond the profile: none, by curvature in closed form, map, walked at each "
    "vertex "
    "under even light, or links, walked from vertex to vertex, thin parts included (no transmission is "
    "added)";

/// The specialisation constant; the renderer supplies the form, and the light of links, to frames with a pass
/// that has it.
inline constexpr const char* kGainConstant = "gain";
/// After read_transmission(), which links replace.
void use_gain(Pass& pass, Gain gain);

/// Gain::none where the values have no such parameter; they stay as they are there.
[[nodiscard]] Gain gain_of(const ParameterValues& values);
[[nodiscard]] ParameterValues with_gain(ParameterValues values, Gain gain);
/// With gain=none: the technique's part that the profile describes.
[[nodiscard]] ParameterValues without_gain(ParameterValues values);

}  // namespace dermis::inline technique
