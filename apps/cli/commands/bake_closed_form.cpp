// dermis bake closed_form: the coefficients that replace the table, and their error.

#include <cstdio>
#include <memory>

#include "bake_options.h"
#include "dermis/bake/fit_errors.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "profile_options.h"

namespace dermis::cli {
namespace {

struct BakeClosedFormOptions {
    std::string profile = "gpu_gems_3", construction = "sphere", output, plot;
    double max_curvature_per_mm = 1;
    int rows = 257;
};

std::string coefficients_csv(const ClosedForm& form) {
    std::string text = "curvature_per_mm,channel,a,q,s,k0,k1\n";
    for (size_t i = 0; i < form.rows.size(); ++i) {
        const ClosedFormCoefficients& row = form.rows[i];
        const double curvature = form.max_curvature_per_mm * double(i) / double(form.rows.size() - 1);
        for (size_t c = 0; c < 3; ++c) {
            text += to_text(curvature) + "," + "rgb"[c];
            for (const Rgb* values : {&row.a, &row.q, &row.s, &row.k0, &row.k1})
                text += "," + to_text(float((*values)[c]));
            text += '\n';
        }
    }
    return text;
}

std::vector<double> plotted_radii(double least_mm) {
    std::vector<double> radii;
    for (double r = least_mm; r < 100.5; r *= 1.07) radii.push_back(r);
    return radii;
}

Result<int> run(const BakeClosedFormOptions& options) {
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(options.profile));
    const Result<Construction> construction = find_construction(options.construction);
    if (!construction) return construction.error();
    const GaussianSum gaussians = to_gaussian_sum(profile).sum;
    DERMIS_TRY_ASSIGN(const ClosedForm form, fit_closed_form(gaussians, options.max_curvature_per_mm,
                                                             options.rows, {.construction = *construction}));
    if (!options.output.empty()) {
        DERMIS_TRY(write_text_file(options.output, coefficients_csv(form)));
        print_path(options.output);
    }
    std::printf("%s, %s: largest error of the fit at its own %zu curvatures %.5f (%.2f of an 8-bit code)\n\n",
                profile.name.c_str(), options.construction.c_str(), form.rows.size(), form.max_error,
                form.max_error * 255);
    if (*construction != Construction::sphere) return 0;
    const double radii[] = {1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 100};
    std::printf("%s", fit_error_table(measure_fit_errors(form, gaussians, radii)).c_str());
    if (options.plot.empty()) return 0;
    const std::vector<double> all = plotted_radii(1 / options.max_curvature_per_mm);
    const Plot plot = fit_error_plot(measure_fit_errors(form, gaussians, all), profile.name);
    DERMIS_TRY(write_plot(options.plot, plot));
    return 0;
}

}  // namespace

void add_bake_closed_form_command(CommandLine& line) {
    auto options = std::make_shared<BakeClosedFormOptions>();
    Command* command = line.add(
        "closed_form", "Coefficients and errors of the closed form, which needs no table",
        "dermis bake closed_form --profile jensen_skin1 -o skin.csv --plot errors.svg", bake_group(line));
    command->add_option("--profile", options->profile, kProfileNames);
    command->add_option("--construction", options->construction,
                        "sphere, full_ring or half_ring (-90 to 90 degrees)");
    command->add_option("--max-curvature", options->max_curvature_per_mm, {1e-6, 1000},
                        "curvature of the last row in 1/mm");
    command->add_option("--rows", options->rows, {2, 65536},
                        "number of rows, in equal steps of curvature from 0");
    command->add_output("-o,--output", options->output, "CSV file of the coefficients");
    command->add_output("--plot", options->plot, "SVG file: errors over radius (sphere only)");
    line.when_chosen(
        command,
        [options] {
            FileUse files = {.inputs = {options->profile}};
            for (const std::string& path : {options->output, options->plot})
                if (!path.empty()) files.outputs.emplace_back(path);
            return Result<FileUse>(files);
        },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
