#pragma once
// The parameters of techniques and subjects, as commands list them.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "dermis/base/parameter.h"

namespace dermis::cli {

/// "0 to 1 mm", or the choices.
[[nodiscard]] std::string range_text(const Parameter& parameter);

/// Lines of 80 columns at most, broken between words; each is indented and ends with a line break.
[[nodiscard]] std::string wrapped(std::string_view text, size_t indent);

/// Each parameter with default, range and meaning, then the presets and what differs in them.
[[nodiscard]] std::string parameters_text(const ParameterTable& table);
[[nodiscard]] nlohmann::json parameters_json(const ParameterTable& table);
[[nodiscard]] nlohmann::json presets_json(const ParameterTable& table);

}  // namespace dermis::cli
