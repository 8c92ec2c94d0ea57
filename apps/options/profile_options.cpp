#include "profile_options.h"

#include <nlohmann/json.hpp>

#include "dermis/bake/profile_report.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

// "1,0.5,0.2"
Result<std::vector<double>> parse_numbers(std::string_view text, const std::string& place) {
    std::vector<double> numbers;
    for (const std::string_view part : split(text, ',')) {
        const auto number = parse_number(part);
        if (!number) return Error{place + ": '" + std::string(part) + "' is not a number"};
        numbers.push_back(*number);
    }
    return numbers;
}

// "key=1,0.5,0.2"
Result<void> assign(ToolSettings& settings, const std::string& assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos)
        return Error{"--set '" + assignment + "': write KEY=NUMBER or KEY=RED,GREEN,BLUE"};
    DERMIS_TRY_ASSIGN(const auto numbers, parse_numbers(std::string_view(assignment).substr(equals + 1),
                                                        "--set '" + assignment + "'"));
    return set_value(settings, trim(std::string_view(assignment).substr(0, equals)), numbers);
}

Result<Profile> source_of(const ConversionChoice& options) {
    const bool named = options.profile || !options.name.empty();
    if (named != options.from.empty()) return Error{"convert needs either a profile's name or --from TOOL"};
    if (options.from.empty()) {
        if (!options.assignments.empty())
            return Error{"--set changes the numbers of --from TOOL; name a tool"};
        const Result<Profile> profile = options.profile ? *options.profile : find_profile(options.name);
        if (!profile) return profile.error();
        // A channel without reflectance has no length to convert.
        DERMIS_TRY(check(Profile{profile->name, "", burley_equivalent(*profile)}));
        return profile;
    }
    DERMIS_TRY_ASSIGN(const ToolId tool, find_tool(options.from));
    ToolSettings settings = default_settings(tool);
    for (const std::string& assignment : options.assignments) DERMIS_TRY(assign(settings, assignment));
    DERMIS_TRY_ASSIGN(const BurleyProfile burley, to_canonical(settings));
    return Profile{options.from, "", burley};
}

// A profile with the albedo 1 is a blur only; --albedo gives the surface's own.
Result<BurleyProfile> with_albedo(BurleyProfile burley, const std::string& text) {
    DERMIS_TRY_ASSIGN(const auto numbers, parse_numbers(text, "--albedo"));
    if (numbers.size() != 1 && numbers.size() != 3) return Error{"--albedo takes one number or three"};
    for (size_t c = 0; c < 3; ++c) burley.albedo[c] = numbers[numbers.size() == 1 ? 0 : c];
    DERMIS_TRY(check(Profile{"--albedo", "", burley}));
    return burley;
}

nlohmann::ordered_json settings_json(const ToolSettings& settings) {
    const ToolConvention& tool = convention_of(settings.tool);
    nlohmann::ordered_json json = {
        {"tool", tool.name}, {"length", tool.length}, {"boundary", tool.boundary}, {"not_kept", tool.lost}};
    for (size_t k = 0; k < tool.keys.size(); ++k) {
        const ToolKey& key = tool.keys[k];
        nlohmann::ordered_json value = settings.values[k];
        if (key.count == 1) value = settings.values[k][0];
        json["values"][std::string(key.name)] = {{"value", value}, {"unit", key.unit}};
    }
    return json;
}

}  // namespace

Rgb of_channels(const Profile& profile, double (*property)(const Profile&, int)) {
    return {property(profile, 0), property(profile, 1), property(profile, 2)};
}

Rgb radii_at(const Profile& profile, double fraction) {
    return {inverse_cdf_mm(profile, 0, fraction), inverse_cdf_mm(profile, 1, fraction),
            inverse_cdf_mm(profile, 2, fraction)};
}

Result<GaussianFit> fit_gaussians(const Profile& profile, int terms) {
    DERMIS_TRY(check_number("--terms", terms, kTermsRange));
    return to_gaussian_sum(profile, terms);
}

nlohmann::ordered_json profile_json(const Profile& profile, const GaussianFit& fit) {
    nlohmann::ordered_json json = {{"name", profile.name},
                                   {"source", profile.source},
                                   {"model", model_name(profile)},
                                   {"albedo", of_channels(profile, diffuse_albedo)},
                                   {"mean_radius_mm", of_channels(profile, mean_radius_mm)},
                                   {"mean_square_radius_mm2", of_channels(profile, mean_square_radius_mm2)},
                                   {"burley_d_mm", burley_equivalent(profile).d_mm}};
    for (const double fraction : kReportedFractions)
        json["radius_mm"][number_text(fraction)] = radii_at(profile, fraction);
    for (const GaussianTerm& term : fit.sum.terms)
        json["gaussians"].push_back({{"variance_mm2", term.variance_mm2}, {"weight", term.weight}});
    json["fit_max_error"] = fit.max_error;
    json["fit_rms_error"] = fit.rms_error;
    return json;
}

Result<Profile> ConversionChoice::source_profile() const {
    Result<Profile> stated = source_of(*this);
    if (!stated || albedo.empty()) return stated;
    DERMIS_TRY_ASSIGN(const BurleyProfile changed, with_albedo(burley_equivalent(*stated), albedo));
    stated->model = changed;
    return stated;
}

Result<Conversion> ConversionChoice::convert() const {
    DERMIS_TRY_ASSIGN(const Profile profile_to_convert, source_profile());
    Conversion conversion{.source = burley_equivalent(profile_to_convert),
                          .origin = profile_to_convert.source};
    if (to == "all") {
        for (const ToolConvention& tool : tool_conventions())
            conversion.settings.push_back(to_tool(tool.id, conversion.source));
    } else {
        DERMIS_TRY_ASSIGN(const ToolId tool, find_tool(to));
        conversion.settings.push_back(to_tool(tool, conversion.source));
    }
    return conversion;
}

nlohmann::ordered_json conversion_json(const Conversion& conversion) {
    const BurleyProfile& source = conversion.source;
    nlohmann::ordered_json json = {{"canonical", {{"albedo", source.albedo}, {"burley_d_mm", source.d_mm}}}};
    if (!conversion.origin.empty()) json["source"] = conversion.origin;
    for (const ToolSettings& settings : conversion.settings)
        json["settings"].push_back(settings_json(settings));
    return json;
}

}  // namespace dermis::cli
