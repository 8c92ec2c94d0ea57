// dermis profile: the published skins, and their parameters in other tools.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/bake/profile_report.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rgb = std::array<double, 3>;

struct ProfileOptions {
    std::string name, plot, from, to, albedo;
    std::vector<std::string> assignments;
    int terms = 6;
    bool json = false;
};

Rgb of_channels(const Profile& profile, double (*property)(const Profile&, int)) {
    return {property(profile, 0), property(profile, 1), property(profile, 2)};
}

Rgb radii_at(const Profile& profile, double fraction) {
    return {inverse_cdf_mm(profile, 0, fraction), inverse_cdf_mm(profile, 1, fraction),
            inverse_cdf_mm(profile, 2, fraction)};
}

void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

void print_row(const std::string& what, const Rgb& value) {
    std::printf("  %-34s %10s %10s %10s\n", what.c_str(), number_text(value[0]).c_str(),
                number_text(value[1]).c_str(), number_text(value[2]).c_str());
}

// ---- list ------------------------------------------------------------------------------------------------

Result<int> list(const ProfileOptions& options) {
    std::vector<Profile> profiles;
    for (const std::string& name : profile_names()) profiles.push_back(*find_profile(name));
    Json all = Json::array();
    if (!options.json) print("                                    albedo                 Burley d (mm)\n");
    for (const Profile& profile : profiles) {
        const BurleyProfile burley = burley_equivalent(profile);
        all.push_back({{"name", profile.name},
                       {"model", model_name(profile)},
                       {"albedo", burley.albedo},
                       {"d_mm", burley.d_mm},
                       {"source", profile.source}});
        if (!options.json)
            std::printf("%-16s %-17s  %-22s %-22s %s\n", profile.name.c_str(), model_name(profile).c_str(),
                        value_text(burley.albedo).c_str(), value_text(burley.d_mm).c_str(),
                        profile.source.c_str());
    }
    if (options.json) print(all.dump(2) + "\n");
    if (!options.plot.empty())
        if (const auto written = write_plot(options.plot, comparison_plot(profiles)); !written)
            return written.error();
    return 0;
}

// ---- show ------------------------------------------------------------------------------------------------

Json profile_json(const Profile& profile, const GaussianFit& fit) {
    Json json = {{"name", profile.name},
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

void print_profile(const Profile& profile, const GaussianFit& fit) {
    print(profile.name + ": " + model_name(profile) + "\n" + profile.source + "\n\n");
    std::printf("  %-34s %10s %10s %10s\n", "", "red", "green", "blue");
    print_row("diffuse albedo", of_channels(profile, diffuse_albedo));
    print_row("mean radius (mm)", of_channels(profile, mean_radius_mm));
    print_row("Burley d of that mean radius (mm)", burley_equivalent(profile).d_mm);
    for (const double fraction : kReportedFractions)
        print_row("radius of " + number_text(100 * fraction) + " % of the light (mm)",
                  radii_at(profile, fraction));
    for (const double thickness_mm : {1.0, 3.0}) {
        Rgb passed;
        for (int c = 0; c < 3; ++c) passed[size_t(c)] = slab_transmittance(profile, c, thickness_mm);
        print_row("transmittance of " + number_text(thickness_mm) + " mm", passed);
    }
    if (const auto* dipole = std::get_if<DipoleProfile>(&profile.model)) {
        Rgb length;
        for (int c = 0; c < 3; ++c) length[size_t(c)] = diffuse_mean_free_path_mm(dipole->medium, c);
        print_row("diffuse mean free path (mm)", length);
    }
    if (!std::holds_alternative<GaussianSum>(profile.model)) {
        print_row("fit of Gaussians, largest error", fit.max_error);
        print_row("fit of Gaussians, rms error", fit.rms_error);
    }
    print("\n  Gaussians: variance (mm^2)             weight\n");
    for (const GaussianTerm& term : fit.sum.terms) print_row(number_text(term.variance_mm2), term.weight);
}

Result<int> show(const ProfileOptions& options) {
    const Result<Profile> profile = find_profile(options.name);
    if (!profile) return profile.error();
    if (options.terms < 1 || options.terms > kMaxGaussianFitTerms)
        return Error{"--terms is " + std::to_string(options.terms) + "; it must be 1 to " +
                     std::to_string(kMaxGaussianFitTerms)};
    const GaussianFit fit = to_gaussian_sum(*profile, options.terms);
    if (options.json)
        print(profile_json(*profile, fit).dump(2) + "\n");
    else
        print_profile(*profile, fit);
    if (!options.plot.empty())
        if (const auto written = write_plot(options.plot, profile_plot(*profile, fit)); !written)
            return written.error();
    return 0;
}

// ---- convert ---------------------------------------------------------------------------------------------

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
    const auto numbers =
        parse_numbers(std::string_view(assignment).substr(equals + 1), "--set '" + assignment + "'");
    if (!numbers) return numbers.error();
    return set_value(settings, trim(std::string_view(assignment).substr(0, equals)), *numbers);
}

Result<BurleyProfile> source_of(const ProfileOptions& options) {
    if (options.name.empty() == options.from.empty())
        return Error{"convert needs either a profile's name or --from TOOL"};
    if (options.from.empty()) {
        if (!options.assignments.empty())
            return Error{"--set changes the numbers of --from TOOL; name a tool"};
        const Result<Profile> profile = find_profile(options.name);
        if (!profile) return profile.error();
        const BurleyProfile burley = burley_equivalent(*profile);
        // A channel without reflectance has no length to convert.
        if (const auto checked = check(Profile{profile->name, "", burley}); !checked) return checked.error();
        return burley;
    }
    const Result<ToolId> tool = find_tool(options.from);
    if (!tool) return tool.error();
    ToolSettings settings = default_settings(*tool);
    for (const std::string& assignment : options.assignments)
        if (const auto set = assign(settings, assignment); !set) return set.error();
    return to_canonical(settings);
}

// A profile with the albedo 1 is a blur only; --albedo gives the surface's own.
Result<BurleyProfile> with_albedo(BurleyProfile burley, const std::string& text) {
    if (text.empty()) return burley;
    const auto numbers = parse_numbers(text, "--albedo");
    if (!numbers) return numbers.error();
    if (numbers->size() != 1 && numbers->size() != 3) return Error{"--albedo takes one number or three"};
    for (size_t c = 0; c < 3; ++c) burley.albedo[c] = (*numbers)[numbers->size() == 1 ? 0 : c];
    if (const auto checked = check(Profile{"--albedo", "", burley}); !checked) return checked.error();
    return burley;
}

Json settings_json(const ToolSettings& settings) {
    const ToolConvention& tool = convention_of(settings.tool);
    Json json = {
        {"tool", tool.name}, {"length", tool.length}, {"boundary", tool.boundary}, {"not_kept", tool.lost}};
    for (size_t k = 0; k < tool.keys.size(); ++k) {
        const ToolKey& key = tool.keys[k];
        Json value = settings.values[k];
        if (key.count == 1) value = settings.values[k][0];
        json["values"][std::string(key.name)] = {{"value", value}, {"unit", key.unit}};
    }
    return json;
}

void print_settings(const ToolSettings& settings) {
    const ToolConvention& tool = convention_of(settings.tool);
    print("\n" + std::string(tool.name) + "\n");
    print("  its length: " + std::string(tool.length) + "\n  boundary:   " + std::string(tool.boundary) +
          "\n");
    if (!tool.lost.empty()) print("  not kept:   " + std::string(tool.lost) + "\n");
    for (size_t k = 0; k < tool.keys.size(); ++k) {
        const ToolKey& key = tool.keys[k];
        std::printf("  %-28s %-32s %-5s %s\n", std::string(key.name).c_str(),
                    value_text(settings.values[k], key.count).c_str(), std::string(key.unit).c_str(),
                    std::string(key.meaning).c_str());
    }
}

Result<int> convert(const ProfileOptions& options) {
    const Result<BurleyProfile> stated = source_of(options);
    if (!stated) return stated.error();
    const Result<BurleyProfile> source = with_albedo(*stated, options.albedo);
    if (!source) return source.error();
    std::vector<ToolId> targets;
    if (options.to == "all") {
        for (const ToolConvention& tool : tool_conventions()) targets.push_back(tool.id);
    } else {
        const Result<ToolId> tool = find_tool(options.to);
        if (!tool) return tool.error();
        targets.push_back(*tool);
    }
    Json json = {{"canonical", {{"albedo", source->albedo}, {"burley_d_mm", source->d_mm}}}};
    if (!options.json)
        print("albedo " + value_text(source->albedo) + ", Burley d " + value_text(source->d_mm) +
              " mm (red, green, blue)\n");
    if (!options.json && source->albedo == Rgb{1, 1, 1})
        print(
            "This profile is a pure blur (albedo 1). Lengths that depend on the albedo need that of the "
            "surface: --albedo R,G,B\n");
    for (const ToolId target : targets) {
        const ToolSettings settings = to_tool(target, *source);
        if (options.json)
            json["settings"].push_back(settings_json(settings));
        else
            print_settings(settings);
    }
    if (options.json) print(json.dump(2) + "\n");
    return 0;
}

std::string tool_list() {
    std::string names;
    for (const ToolConvention& tool : tool_conventions()) names += std::string(tool.name) + ", ";
    return names;
}

}  // namespace

void add_profile_command(CommandLine& line) {
    Command* profile =
        line.add("profile", "Diffusion profiles: published skins, and their parameters in other tools",
                 "dermis profile convert jensen_skin1 --to hdrp");
    profile->require_subcommand();
    const auto options = std::make_shared<ProfileOptions>();
    const char* name_help = "a preset's name, a CSV file, or burley:R,G,B (d in mm)";

    Command* list_command =
        line.add("list", "Lists the built-in profiles", "dermis profile list --json", profile);
    list_command->add_option("--plot", options->plot, "SVG file: all profiles in one plot");
    list_command->add_flag("--json", options->json, "print JSON");
    line.when_chosen(list_command, [options] { return list(*options); });

    Command* show_command = line.add("show", "Prints a profile's lengths, albedo and Gaussians",
                                     "dermis profile show jensen_skin1 --plot skin1.svg", profile);
    show_command->add_option("name", options->name, name_help)->required();
    show_command->add_option("--plot", options->plot, "SVG file: the curves of the profile");
    show_command->add_option("--terms", options->terms, "number of Gaussians of the fit, 1 to 12")
        ->capture_default_str();
    show_command->add_flag("--json", options->json, "print JSON");
    line.when_chosen(show_command, [options] { return show(*options); });

    Command* convert_command = line.add(
        "convert", "Converts a profile to another tool's parameters, with quantity, unit and boundary",
        "dermis profile convert --from unreal --set mean_free_path_distance=3 --to blender_burley", profile);
    convert_command->add_option("name", options->name, name_help);
    convert_command->add_option("--from", options->from,
                                "read the settings of this tool instead of a profile");
    convert_command->add_option(
        "--set", options->assignments,
        "KEY=NUMBER or KEY=R,G,B of --from; what is not set keeps the tool's default");
    convert_command->add_option("--to", options->to, tool_list() + "or all")->required();
    convert_command->add_option("--albedo", options->albedo, "R,G,B: replaces the albedo, keeps Burley's d");
    convert_command->add_flag("--json", options->json, "print JSON");
    line.when_chosen(convert_command, [options] { return convert(*options); });

    Command* table_command = line.add("table", "Prints the tables of docs/profiles.md as Markdown",
                                      "dermis profile table > tables.md", profile);
    line.when_chosen(table_command, [] {
        print(profile_tables_markdown());
        return Result<int>(0);
    });
}

}  // namespace dermis::cli
