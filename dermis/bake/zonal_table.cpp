#include "dermis/bake/zonal_table.h"

#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"

namespace dermis::inline bake {

std::array<Rgb, 3> zonal_harmonics_at(const Profile& profile, double radius_mm, const Preintegration& how) {
    if (const auto* sum = std::get_if<GaussianSum>(&profile.model))
        return preintegrated_zonal_harmonics(*sum, radius_mm, how);
    return preintegrated_zonal_harmonics(radial_profile(profile), radius_mm);
}

Result<Table> bake_zonal_harmonics(const ZonalOptions& options) {
    const bool remapped = options.layout == ZonalLayout::two_rows_remapped_8;
    const int orders = remapped ? 2 : 3;
    DERMIS_TRY(check_table_size(options.width, orders));
    DERMIS_TRY(check_curvature_axis(options.curvature));
    DERMIS_TRY(check_preintegrable(options.profile, options.how));

    Table table{.width = options.width, .height = orders};
    // Texel l is order l.
    table.convention = {.kind = TableKind::zonal_harmonics,
                        .axes = {options.curvature, TableAxis{"order", "1", -0.5, orders - 0.5}},
                        .how = options.how,
                        .profile = options.profile.name,
                        .tool = tool_version()};
    if (remapped) {
        table.convention.encoding = TableEncoding::range;
        table.convention.encoded_min = 0.75;
        table.convention.encoded_max = 1.05;
    }
    table.data.resize(size_t(table.width) * size_t(orders) * 3);
    parallel_for(size_t(table.width), 4, [&](size_t begin, size_t end) {
        for (size_t x = begin; x < end; ++x) {
            const double radius_mm = radius_of(options.curvature, table.u_value(double(x)));
            const std::array<Rgb, 3> zonal = zonal_harmonics_at(options.profile, radius_mm, options.how);
            for (size_t l = 0; l < size_t(orders); ++l)
                for (size_t c = 0; c < 3; ++c)
                    table.data[3 * (l * size_t(table.width) + x) + c] = float(zonal[l][c]);
        }
    });
    return table;
}

}  // namespace dermis::inline bake
