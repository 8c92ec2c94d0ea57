// dermis profile: the published skins, and their parameters in other tools.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/bake/profile_report.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/optics/mtlx.h"
#include "dermis/optics/presets.h"
#include "fit_walk.h"
#include "profile_options.h"
#include "profile_skin.h"

namespace dermis::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ProfileOptions {
    ConversionChoice conversion;
    std::string name, plot, output;
    int terms = 6;
    bool json = false;
};

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
    if (!options.plot.empty()) DERMIS_TRY(write_plot(options.plot, comparison_plot(profiles)));
    return 0;
}

// ---- show ------------------------------------------------------------------------------------------------

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
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(options.name));
    DERMIS_TRY_ASSIGN(const GaussianFit fitted, fit_gaussians(profile, options.terms));
    const GaussianFit& fit = fitted;
    if (options.json)
        print(profile_json(profile, fit).dump(2) + "\n");
    else
        print_profile(profile, fit);
    if (!options.plot.empty()) DERMIS_TRY(write_plot(options.plot, profile_plot(profile, fit)));
    return 0;
}

// ---- convert ---------------------------------------------------------------------------------------------

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

Result<FileUse> converted_file(const ProfileOptions& options) {
    if (options.output.empty()) return FileUse{};
    const std::filesystem::path path = options.output;
    if (to_lower(path.extension().string()) != ".mtlx")
        return Error{options.output + ": profiles are written as .mtlx (MaterialX, OpenPBR)"};
    if (!options.conversion.to.empty() && options.conversion.to != "openpbr")
        return Error{"-o " + options.output + " holds OpenPBR; leave --to " + options.conversion.to +
                     " away"};
    if (options.json) return Error{"--json prints; give either it or -o"};
    return FileUse{.outputs = {path}, .inputs = {options.conversion.name}};
}

// A file of another tool, with what it means and what it does not keep, a line each.
Result<int> write_converted(const ProfileOptions& options) {
    const Result<Profile> profile = options.conversion.source_profile();
    if (!profile) return profile.error();
    ConversionChoice as_it_was = options.conversion;
    as_it_was.albedo.clear();
    DERMIS_TRY_ASSIGN(const Profile original, as_it_was.source_profile());
    DERMIS_TRY(write_text_file(options.output, mtlx_text(*profile)));
    print(printable_line(options.output) + ": " + profile->name + "\n");
    if (!profile->source.empty()) print("  from " + profile->source + "\n");
    for (const std::string& note : mtlx_notes(original, *profile)) print("  " + note + "\n");
    return 0;
}

Result<int> convert(const ProfileOptions& options) {
    if (!options.output.empty()) return write_converted(options);
    if (options.conversion.to.empty()) return Error{"convert needs --to TOOL, or -o FILE.mtlx"};
    const Result<Conversion> converted = options.conversion.convert();
    if (!converted) return converted.error();
    const BurleyProfile& source = converted->source;
    if (options.json) {
        print(conversion_json(*converted).dump(2) + "\n");
        return 0;
    }
    if (!converted->origin.empty()) print("from " + converted->origin + "\n");
    print("albedo " + value_text(source.albedo) + ", Burley d " + value_text(source.d_mm) +
          " mm (red, green, blue)\n");
    if (source.albedo == Rgb{1, 1, 1})
        print(
            "This profile is a pure blur (albedo 1). Lengths that depend on the albedo need that of the "
            "surface: --albedo R,G,B\n");
    for (const ToolSettings& settings : converted->settings) print_settings(settings);
    return 0;
}

std::string tool_list() {
    std::string names;
    for (const ToolConvention& tool : tool_conventions()) names += std::string(tool.name) + ", ";
    return names;
}

void add_fit_walk(CommandLine& line, Command* profile, const char* kProfileNames) {
    const auto options = std::make_shared<FitWalkOptions>();
    Command* command = line.add(
        "fit-walk", "Fits a profile to random walks, and says how far Burley's and the dipole are from it",
        "dermis profile fit-walk openpbr_skin_1 -o skin1_walks.csv", profile);
    command->add_option("NAME", options->name, kProfileNames);
    command->add_option("--g", options->g, {-0.99, 0.99},
                        "mean cosine of the volume's phase function; keeps the reduced mean free path");
    command->add_option("--eta", options->eta, {1, 3}, "the volume's index of refraction");
    command->add_option("--walks", options->walks, {3000, 1e9}, "number of walks")->capture_default_str();
    command->add_output("-o,--output", options->output, "CSV file: the profile as a table");
    command->add_flag("--albedos", options->albedos, "print the table over albedo as Markdown");
    line.when_chosen(
        command, [options] { return fit_walk_file(*options); }, [options] { return fit_walk(*options); });
}

}  // namespace

void add_profile_command(CommandLine& line) {
    Command* profile =
        line.add("profile", "Diffusion profiles: published skins, and their parameters in other tools",
                 "dermis profile convert jensen_skin1 --to hdrp");
    profile->require_subcommand();
    const auto options = std::make_shared<ProfileOptions>();
    Command* list_command =
        line.add("list", "Lists the built-in profiles", "dermis profile list --json", profile);
    list_command->add_output("--plot", options->plot, "SVG file: all profiles in one plot");
    list_command->add_flag("--json", options->json, "print JSON");
    const auto plot_file = [options] {
        FileUse files = {.outputs = {}, .inputs = {options->name}};
        if (!options->plot.empty()) files.outputs.emplace_back(options->plot);
        return Result<FileUse>(files);
    };
    line.when_chosen(list_command, plot_file, [options] { return list(*options); });

    Command* show_command = line.add("show", "Prints a profile's lengths, albedo and Gaussians",
                                     "dermis profile show jensen_skin1 --plot skin1.svg", profile);
    show_command->add_option("NAME", options->name, kProfileNames)->required();
    show_command->add_output("--plot", options->plot, "SVG file: the curves of the profile");
    show_command
        ->add_option("--terms", options->terms, kTermsRange, "number of Gaussians of the fit, 1 to 12")
        ->capture_default_str();
    show_command->add_flag("--json", options->json, "print JSON");
    line.when_chosen(show_command, plot_file, [options] { return show(*options); });

    Command* convert_command = line.add(
        "convert", "Converts a profile to another tool's parameters, with quantity, unit and boundary",
        "dermis profile convert --from hdrp --set scatteringDistance=1 --to unreal", profile);
    convert_command->add_option("NAME", options->conversion.name, kProfileNames);
    convert_command->add_option("--from", options->conversion.from,
                                "read the settings of this tool instead of a profile");
    convert_command->add_option("--set", options->conversion.assignments,
                                "KEY=NUMBER or KEY=R,G,B of --from; other keys keep the tool's default");
    convert_command->add_option("--to", options->conversion.to, tool_list() + "or all");
    convert_command->add_output("-o,--output", options->output,
                                "file to write instead: .mtlx, an OpenPBR surface of MaterialX");
    convert_command->add_option("--albedo", options->conversion.albedo,
                                "R,G,B: replaces the albedo, keeps Burley's d");
    convert_command->add_flag("--json", options->json, "print JSON");
    line.when_chosen(
        convert_command, [options] { return converted_file(*options); },
        [options] { return convert(*options); });

    add_fit_walk(line, profile, kProfileNames);
    add_profile_skin(line, profile);

    Command* table_command =
        line.add("table", "Prints presets, tool conventions and fit errors as Markdown tables",
                 "dermis profile table > tables.md", profile);
    line.when_chosen(table_command, writes_nothing, [] {
        print(profile_tables_markdown());
        return Result<int>(0);
    });
}

}  // namespace dermis::cli
