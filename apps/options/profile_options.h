#pragma once
// What `dermis profile show` and `dermis profile convert` ask for, and their answers as JSON.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"

namespace dermis::cli {

/// For --help: what find_profile() takes.
inline constexpr const char* kProfileNames =
    "preset, .csv, .mtlx or .glb file, burley:R,G,B (d in mm), or skin:melanin=0.02";

inline constexpr NumberRange kTermsRange = {1, kMaxGaussianFitTerms};
/// Errors: --terms out of its range.
[[nodiscard]] Result<GaussianFit> fit_gaussians(const Profile& profile, int terms);
[[nodiscard]] nlohmann::ordered_json profile_json(const Profile& profile, const GaussianFit& fit);

[[nodiscard]] Rgb of_channels(const Profile& profile, double (*property)(const Profile&, int));
/// Within which such a part of the light leaves.
[[nodiscard]] Rgb radii_at(const Profile& profile, double fraction);

struct Conversion {
    BurleyProfile source;
    std::string origin;  ///< of a profile its source, with what was assumed of its file; else empty
    std::vector<ToolSettings> settings;  ///< one for each target
};

/// A profile (itself or by its name) or another tool's settings, to one tool or to "all".
struct ConversionChoice {
    std::optional<Profile> profile;
    std::string name, from, to, albedo;
    std::vector<std::string> assignments;  ///< KEY=NUMBER or KEY=R,G,B of `from`

    [[nodiscard]] Result<Conversion> convert() const;
    /// What is converted, as a profile: with its own model where --albedo does not replace the albedo.
    [[nodiscard]] Result<Profile> source_profile() const;
};
[[nodiscard]] nlohmann::ordered_json conversion_json(const Conversion& conversion);

}  // namespace dermis::cli
