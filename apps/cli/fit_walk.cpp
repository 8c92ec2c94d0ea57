// dermis profile fit-walk: the profile of a skin's volume by random walks, and how far Burley's and Jensen's
// are from it.

#include "fit_walk.h"

#include <cstdio>
#include <filesystem>

#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/profile_file.h"
#include "dermis/rays/walk_profile.h"

namespace dermis::cli {
namespace {

Result<Profile> walked(const ScatteringMedium& medium, int walks, const std::string& what) {
    Progress line("walks of " + what, 0);
    return fit_walk_profile(medium, walks, 1, [&](double done) { line.set(done); });
}

// The volume of the profile's walks; g and eta replaced keep albedo and reduced mean free path.
Result<ScatteringMedium> medium_of(const FitWalkOptions& options) {
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(options.name));
    if (const std::string note = walk_volume_note(profile); !note.empty()) print_warning(note);
    ScatteringMedium medium = walk_medium_of(profile);
    if (options.g || options.eta)
        medium = dermis::medium_of(burley_of(medium), options.g.value_or(medium.g),
                                   options.eta.value_or(medium.eta));
    DERMIS_TRY(check(medium));
    return medium;
}

void print_errors(const Profile& by_walks, const ScatteringMedium& medium) {
    constexpr const char* kChannels[] = {"red", "green", "blue"};
    const Profile burley{.name = "Burley", .source = {}, .model = burley_of(medium)},
        dipole{.name = "dipole", .source = {}, .model = DipoleProfile{medium}};
    std::printf("%-7s %-7s %8s %10s %10s %12s\n", "", "", "albedo", "mean mm", "90 % mm", "misplaced");
    for (int c = 0; c < 3; ++c) {
        std::printf("%-7s %-7s %8.4f %10.4g %10.4g\n", kChannels[c], "walk", diffuse_albedo(by_walks, c),
                    mean_radius_mm(by_walks, c), inverse_cdf_mm(by_walks, c, 0.9));
        for (const Profile* profile : {&burley, &dipole})
            std::printf("%-7s %-7s %8.4f %10.4g %10.4g %10.1f %%\n", "", profile->name.c_str(),
                        diffuse_albedo(*profile, c), mean_radius_mm(*profile, c),
                        inverse_cdf_mm(*profile, c, 0.9),
                        100 * error_of(*profile, by_walks, c).light_at_distance);
    }
    std::printf("misplaced: the largest difference of the shares of light within a radius\n");
}

// Three albedos a picture of walks, as three channels.
Result<void> print_albedos(const FitWalkOptions& options) {
    constexpr double kAlbedos[][3] = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, {0.7, 0.8, 0.85}, {0.9, 0.93, 0.96}};
    std::printf(
        "| albedo | Burley: mean radius | 90 %% radius | misplaced | dipole: albedo | mean radius | "
        "90 %% radius | misplaced |\n|---|---|---|---|---|---|---|---|\n");
    for (const auto& albedo : kAlbedos) {
        const BurleyProfile burley{.albedo = {albedo[0], albedo[1], albedo[2]}};
        const ScatteringMedium medium =
            dermis::medium_of(burley, options.g.value_or(0), options.eta.value_or(1));
        DERMIS_TRY_ASSIGN(const Profile by_walks, walked(medium, options.walks, "twelve albedos"));
        for (int c = 0; c < 3; ++c) {
            const ProfileError b = error_of({.name = {}, .source = {}, .model = burley}, by_walks, c),
                               d = error_of({.name = {}, .source = {}, .model = DipoleProfile{medium}},
                                            by_walks, c);
            std::printf("| %.2f | %.2f | %.2f | %.1f %% | %.2f | %.2f | %.2f | %.1f %% |\n", albedo[c],
                        b.mean_ratio, b.r90_ratio, 100 * b.light_at_distance, d.albedo_ratio, d.mean_ratio,
                        d.r90_ratio, 100 * d.light_at_distance);
        }
    }
    return {};
}

}  // namespace

Result<FileUse> fit_walk_file(const FitWalkOptions& options) {
    if (options.albedos == !options.name.empty())
        return Error{"fit-walk needs a profile NAME, or --albedos for the table over albedo"};
    if (options.output.empty()) return FileUse{.outputs = {}, .inputs = {options.name}};
    if (options.albedos) return Error{"--albedos prints a table; leave out -o"};
    const std::filesystem::path path = options.output;
    if (to_lower(path.extension().string()) != ".csv")
        return Error{options.output + ": profiles of walks are written as .csv"};
    return FileUse{.outputs = {path}, .inputs = {options.name}};
}

Result<int> fit_walk(const FitWalkOptions& options) {
    if (options.albedos) {
        DERMIS_TRY(print_albedos(options));
        return 0;
    }
    DERMIS_TRY_ASSIGN(const ScatteringMedium medium, medium_of(options));
    DERMIS_TRY_ASSIGN(const Profile by_walks, walked(medium, options.walks, options.name));
    print_errors(by_walks, medium);
    if (options.output.empty()) return 0;
    const auto& table = std::get<TabulatedProfile>(by_walks.model);
    DERMIS_TRY(write_text_file(options.output, profile_csv(by_walks, table.r_mm())));
    std::printf("%s: use it as a profile, skin.profile=%s\n", options.output.c_str(), options.output.c_str());
    return 0;
}

}  // namespace dermis::cli
