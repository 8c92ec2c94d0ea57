#pragma once
// Techniques with their settings as text: "lambert,wrap[wrap=0.4],texture_space[preset=cheap,detail=map]".

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/technique/technique.h"

namespace dermis::inline technique {

struct Contestant {
    const Technique* technique = nullptr;
    ParameterValues values;
    std::string settings;  ///< as written, "diffuse=closed_form,shadow=plain"; empty: all defaults

    /// "preintegrated[diffuse=closed_form,shadow=plain]", or the id alone.
    [[nodiscard]] std::string name() const;
};

/// One technique, with or without settings in brackets, as below.
[[nodiscard]] Result<Contestant> parse_technique(std::span<const Technique> techniques,
                                                 std::string_view text);

/// Names separated by commas; each may carry settings in brackets, separated by commas. A comma between
/// numbers belongs to a colour, as in wrap[scatter_color_linear=.07,.01,.006]. Errors name the entry: an
/// unknown technique, preset or parameter, a value out of range, a combination that the technique refuses, a
/// missing bracket, two entries with the same settings, an empty list.
[[nodiscard]] Result<std::vector<Contestant>> parse_technique_list(std::span<const Technique> techniques,
                                                                   std::string_view text);

/// Every technique with its defaults, the baseline first.
[[nodiscard]] std::vector<Contestant> default_contestants(std::span<const Technique> techniques);

}  // namespace dermis::inline technique
