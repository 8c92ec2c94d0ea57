#pragma once
// The parameters of techniques and subjects, as commands list them.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "dermis/base/parameter.h"

namespace dermis::cli {

/// "0 to 1 mm", or the choices.
[[nodiscard]] std::string range_text(const Parameter& parameter);

/// A line each, with range and default.
void print_parameters(const ParameterTable& table);
[[nodiscard]] nlohmann::json parameters_json(const ParameterTable& table);

}  // namespace dermis::cli
