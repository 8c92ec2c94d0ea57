#pragma once
// The options of `dermis bake lut`, `zh` and `shadow`, and the tables that they ask for.

#include <optional>
#include <string>

#include "command.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/zonal_table.h"

namespace dermis::cli {

inline constexpr NumberRange kVarianceScaleRange = {1e-6, 1e6};

/// Empty text and no scale: as the convention has it.
struct LutChoice {
    std::string convention = "dermis", construction, ring_weights, profile, size, axis, range, warp;
    std::optional<double> variance_scale;

    [[nodiscard]] Result<LutOptions> options() const;
};

struct ZhChoice {
    std::string profile = "gpu_gems_3", construction = "sphere", axis = "curvature", range, layout = "float";
    double variance_scale = 1;
    int width = 256;

    [[nodiscard]] Result<ZonalOptions> options() const;
};

struct ShadowChoice {
    std::string profile = "gpu_gems_3", size = "256x64", range = "1,40", warp = "linear";
    double sharpening = 3;

    [[nodiscard]] Result<ShadowOptions> options() const;
};

/// The storage of this name. Without a name it is `preferred`, that of a published convention, if the file's
/// format allows it.
[[nodiscard]] Result<TableStorage> find_storage(const std::string& path, const std::string& name,
                                                TableStorage preferred);

/// A table and what is known of how it was made.
struct MadeTable {
    Table table;
    Profile profile;  ///< that was integrated, after a fit where one was needed
    TableStorage preferred = TableStorage::automatic;
    std::string note;  ///< of such a fit, a line; empty where nothing was fitted
};

[[nodiscard]] Result<MadeTable> make_table(LutOptions options);
[[nodiscard]] Result<MadeTable> make_table(ZonalOptions options);
[[nodiscard]] Result<MadeTable> make_table(const ShadowOptions& options);
/// What `automatic` is for such a table.
[[nodiscard]] TableStorage preferred_storage(ZonalLayout layout);

/// Whether zonal harmonics of this layout fit into such numbers.
[[nodiscard]] Result<void> check_zonal_storage(const std::string& path, ZonalLayout layout,
                                               TableStorage storage);
/// Sets the encoding that a table of our own has in such numbers; a published one keeps its own.
void choose_encoding(Table& table, TableStorage storage);

}  // namespace dermis::cli
