#include "bake_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "dermis/bake/rows.h"
#include "dermis/bake/table_report.h"
#include "dermis/base/text.h"
#include "dermis/optics/gaussian_fit.h"

namespace dermis::cli {

Command* bake_group(CommandLine& line) {
    if (Command* group = line.find("bake")) return group;
    Command* group = line.add("bake", "Bakes tables and maps for techniques",
                              "dermis bake lut --profile jensen_skin1 -o skin.exr --plot skin.svg");
    group->require_subcommand();
    return group;
}

void TableOutput::add_to(Command* command) {
    command
        ->add_output("-o,--output", path,
                     "file to write: .exr, .png, .ktx2, .dds, .h or .csv; FILE.json has its convention")
        ->required();
    command->add_option("--storage", storage,
                        "numbers in the file: auto, 8 or 16 (PNG), half or float (EXR)");
    command->add_output("--plot", plot_path, "SVG file: the curves, and the error of the written table");
}

Result<TableStorage> TableOutput::chosen_storage(TableStorage preferred) const {
    return find_storage(path, storage, preferred);
}

FileUse TableOutput::files(const std::string& profile) const {
    FileUse files = {.outputs = {path, sidecar_path(path)}, .inputs = {profile}};
    if (!plot_path.empty()) files.outputs.emplace_back(plot_path);
    return files;
}

Result<Range> parse_range(const std::string& option, const std::string& text) {
    const std::vector<std::string_view> ends = split(text, ',');
    const std::optional<double> min = parse_number(ends.front()), max = parse_number(ends.back());
    if (ends.size() != 2 || !min || !max)
        return Error{option + " is '" + text + "', must be MIN,MAX, like 0,0.5"};
    return Range{*min, *max};
}

std::string fit_where_needed(Profile& profile, const Preintegration& how, Integration integration) {
    const bool good = integration == Integration::exact && check_preintegrable(profile, how);
    if (good || std::holds_alternative<GaussianSum>(profile.model)) return "";
    const GaussianFit fit = to_gaussian_sum(profile);
    const std::string model = model_name(profile);
    profile.model = fit.sum;
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "the profile is %s and this convention needs Gaussians: fitted, %.2g %% of the light at a "
                  "wrong distance\n",
                  model.c_str(), 100 * std::ranges::max(fit.max_error));
    return text.data();
}

// Wide profiles scatter more light than FaceWorks' encoding holds.
static std::string cut_note(const Table& table) {
    if (table.convention.encoding != TableEncoding::difference) return "";
    size_t cut = 0;
    for (size_t i = 0; i < table.data.size(); ++i) {
        const int x = int(i / size_t(table.channels) % size_t(table.width));
        if (std::abs(table.data[i] - std::max(0.0, table.u_value(x))) > kMostDifference) ++cut;
    }
    if (cut == 0) return "";
    std::array<char, 120> text{};
    std::snprintf(
        text.data(), text.size(),
        "%.2g %% of its numbers differ from max(0, N.L) by more than the encoding's %g and are cut\n",
        100.0 * double(cut) / double(table.data.size()), kMostDifference);
    return text.data();
}

Result<int> deliver(MadeTable made, const TableOutput& output, TableStorage storage) {
    const Table& table = made.table;
    const Profile& profile = made.profile;
    choose_encoding(made.table, storage);
    const Result<LookupError> error = lookup_error(quantised(table, storage), exact_function(table, profile));
    if (!error) return error.error();
    if (!output.plot_path.empty()) {
        DERMIS_TRY_ASSIGN(const Plot plot, table_plot(table, profile, storage));
        DERMIS_TRY(write_plot(output.plot_path, plot));
    }
    DERMIS_TRY(write_table(output.path, table, storage));
    const Convention& convention = table.convention;
    std::printf("%s: %s\n", printable_line(output.path).c_str(), describe(table).c_str());
    std::printf("largest error of a lookup %.2g (%s %.3g, %s %.3g), rms %.2g\n", error->max,
                convention.axes[0].name.c_str(), error->u, convention.axes[1].name.c_str(), error->v,
                error->rms);
    std::printf("%s%s", made.note.c_str(), cut_note(table).c_str());
    return 0;
}

}  // namespace dermis::cli
