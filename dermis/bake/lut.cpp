#include "dermis/bake/lut.h"

#include "dermis/bake/rows.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::inline bake {
namespace {

const std::vector<std::string>& names() {
    static const std::vector<std::string> all = {"dermis", "penner", "unity_2011", "faceworks"};
    return all;
}

Profile skin() {
    return {"gpu_gems_3", "d'Eon, Luebke 2007", gpu_gems_3_skin()};
}

LutOptions unity_2011() {
    LutOptions options{.profile = skin(), .width = 512, .height = 512};
    options.convention.axes = {
        TableAxis{"n_dot_l", "1", -1, 1, AxisWarp::linear, TexelSampling::low_edge},
        TableAxis{"curvature_per_mm", "1/mm", 0, 0.5, AxisWarp::linear, TexelSampling::high_edge}};
    options.convention.v_origin = VOrigin::bottom;
    options.convention.how = kUnity2011Ring;
    options.convention.integration = Integration::unity_taps;
    options.storage = TableStorage::u8;
    return options;
}

LutOptions faceworks() {
    LutOptions options{.profile = skin(), .width = 512, .height = 512};
    options.convention.axes = {TableAxis{"n_dot_l", "1", -1, 1}, curvature_axis(0.01, 1)};
    options.convention.encoding = TableEncoding::difference;
    options.convention.how = {.construction = Construction::full_ring};
    options.convention.integration = Integration::faceworks_taps;
    options.storage = TableStorage::u8;
    return options;
}

Result<void> check(const LutOptions& options) {
    if (Result<void> size = check_table_size(options.width, options.height); !size) return size;
    const Convention& convention = options.convention;
    if (convention.kind != TableKind::diffuse)
        return Error{"bake_lut bakes kind 'diffuse', not '" + std::string(name_of(convention.kind)) + "'"};
    if (convention.axes[0].name != "n_dot_l")
        return Error{"the columns of a lut are 'n_dot_l', not '" + convention.axes[0].name + "'"};
    if (Result<void> axis = check_axis(convention.axes[0], -1, 1); !axis) return axis;
    return check_curvature_axis(convention.axes[1]);
}

}  // namespace

TableAxis curvature_axis(double min_per_mm, double max_per_mm) {
    return {.name = "curvature_per_mm", .unit = "1/mm", .min = min_per_mm, .max = max_per_mm};
}

TableAxis radius_axis(double min_mm, double max_mm) {
    return {.name = "radius_mm", .unit = "mm", .min = min_mm, .max = max_mm};
}

Result<LutOptions> lut_options(std::string_view convention_name) {
    LutOptions options{.profile = skin()};
    options.convention.axes = {TableAxis{"n_dot_l", "1", -1, 1}, curvature_axis(0, 0.5)};
    if (convention_name == "dermis") return options;
    if (convention_name == "penner") {
        options.convention.how.construction = Construction::half_ring;
        return options;
    }
    if (convention_name == "unity_2011") return unity_2011();
    if (convention_name == "faceworks") return faceworks();
    return Error{unknown_name("convention", convention_name, names())};
}

Result<Table> bake_lut(const LutOptions& options) {
    DERMIS_TRY(check(options));
    Table table{.width = options.width, .height = options.height, .convention = options.convention};
    table.convention.profile = options.profile.name;
    table.convention.tool = tool_version();
    std::vector<double> n_dot_l;
    for (int x = 0; x < table.width; ++x) n_dot_l.push_back(table.u_value(x));

    std::vector<double> radii_mm;
    for (int y = 0; y < table.height; ++y)
        radii_mm.push_back(radius_of(table.convention.axes[1], table.v_value(y)));
    const Convention& convention = options.convention;
    Result<std::vector<float>> data =
        integrate_model(options.profile, convention.integration, n_dot_l, radii_mm, convention.how);
    if (!data) return data.error();
    table.data = std::move(*data);
    return table;
}

}  // namespace dermis::inline bake
