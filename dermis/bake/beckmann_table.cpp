#include "dermis/bake/beckmann_table.h"

#include <cmath>

namespace dermis::inline bake {

double beckmann(double n_dot_h, double roughness) {
    if (n_dot_h <= 0 || (roughness <= 0 && n_dot_h < 1)) return 0;
    const double cosine_squared = n_dot_h * n_dot_h, m_squared = roughness * roughness;
    const double tangent_squared = (1 - cosine_squared) / cosine_squared;
    return std::exp(-tangent_squared / m_squared) / (m_squared * cosine_squared * cosine_squared);
}

Result<Table> bake_beckmann(const BeckmannOptions& options) {
    DERMIS_TRY(check_table_size(options.width, options.height));
    const bool gems = options.layout == BeckmannLayout::gems_8_bit;
    const TexelSampling sampling = gems ? TexelSampling::low_edge : TexelSampling::centre;
    Table table{.width = options.width, .height = options.height, .channels = 1};
    table.convention = {.kind = TableKind::beckmann,
                        .axes = {TableAxis{"n_dot_h", "1", 0, 1, AxisWarp::linear, sampling},
                                 TableAxis{"roughness", "1", 0, 1, AxisWarp::linear, sampling}},
                        .v_origin = gems ? VOrigin::bottom : VOrigin::top,
                        .encoding = gems ? TableEncoding::tenth_power : TableEncoding::linear,
                        .tool = tool_version()};
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x)
            table.data.push_back(float(beckmann(table.u_value(x), table.v_value(y))));
    return table;
}

}  // namespace dermis::inline bake
