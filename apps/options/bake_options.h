#pragma once
// What the bake commands share: the `bake` command itself, and options that mean the same in each of them.

#include <optional>
#include <string>

#include "command.h"
#include "dermis/bake/table_io.h"
#include "dermis/optics/profile.h"
#include "table_options.h"

namespace dermis::cli {

/// `dermis bake`, made by whichever subcommand asks first.
[[nodiscard]] Command* bake_group(CommandLine& line);

/// -o FILE, --storage, --plot.
struct TableOutput {
    std::string path, plot_path, storage = "auto";
    void add_to(Command* command);
    [[nodiscard]] Result<TableStorage> chosen_storage(TableStorage preferred = TableStorage::automatic) const;
    /// The table, its sidecar, the plot. `profile` is read if it is a file.
    [[nodiscard]] FileUse files(const std::string& profile = "") const;
};

/// "0,0.5".
struct Range {
    double min = 0, max = 0;
};
[[nodiscard]] Result<Range> parse_range(const std::string& option, const std::string& text);

/// A ring, a variance scale and the taps of published code need a sum of Gaussians: another profile becomes
/// its fit. The text to print says so, and how good the fit is; empty where nothing was fitted.
[[nodiscard]] std::string fit_where_needed(Profile& profile, const Preintegration& how,
                                           Integration integration);

/// Writes the table, the plot if one is asked for, and prints what was written and how exact a lookup in it
/// is, then the table's note.
[[nodiscard]] Result<int> deliver(MadeTable made, const TableOutput& output, TableStorage storage);

}  // namespace dermis::cli
