#pragma once
// Internal to dermis/shading: numbers as the text of shaders.

#include <string>

#include "dermis/optics/preintegration.h"

namespace dermis::shading::export_text {

/// A float literal of six digits: "1.0", "0.000310047".
[[nodiscard]] std::string literal(double value);
/// "vec3(0.1, 0.2, 0.3)".
[[nodiscard]] std::string vec3_literal(const Rgb& rgb);
/// A constant on a line of its own.
[[nodiscard]] std::string vec3_constant(const std::string& name, const Rgb& value);
/// "0.31 %" of a part of 1.
[[nodiscard]] std::string percent(double part);

/// Two digits, rounded up: "0.0027".
[[nodiscard]] std::string error_text(double error);

}  // namespace dermis::shading::export_text
