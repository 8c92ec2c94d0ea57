#include "table_options.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "bake_options.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

Result<void> set_range(TableAxis& axis, const std::string& text) {
    if (text.empty()) return {};
    DERMIS_TRY_ASSIGN(const Range range, parse_range("--range", text));
    axis.min = range.min;
    axis.max = range.max;
    return {};
}

const std::vector<std::string> kAxes = {"curvature", "radius"};

Result<void> choose_axis(const LutChoice& choice, TableAxis& axis) {
    if (!choice.axis.empty()) {
        if (choice.axis == "radius")
            axis = radius_axis(1, 32);
        else if (choice.axis == "curvature")
            axis = curvature_axis(0, 0.5);
        else
            return Error{unknown_name("axis", choice.axis, kAxes)};
    }
    DERMIS_TRY(set_range(axis, choice.range));
    if (!choice.warp.empty()) {
        const Result<AxisWarp> warp = find_warp(choice.warp);
        if (!warp) return warp.error();
        axis.warp = *warp;
    }
    return {};
}

Result<void> choose_construction(const LutChoice& choice, Convention& convention) {
    if (!choice.construction.empty()) {
        const Result<Construction> construction = find_construction(choice.construction);
        if (!construction) return construction.error();
        convention.how.construction = *construction;
    }
    if (choice.ring_weights == "area")
        convention.how.ring_weights = RingWeights::area;
    else if (!choice.ring_weights.empty() && choice.ring_weights != "line")
        return Error{
            unknown_name("ring weights", choice.ring_weights, std::vector<std::string>{"line", "area"})};
    if (!choice.variance_scale) return {};
    convention.how.variance_scale = *choice.variance_scale;
    return check_number("--variance-scale", *choice.variance_scale, kVarianceScaleRange);
}

}  // namespace

Result<LutOptions> LutChoice::options() const {
    Result<LutOptions> lut = lut_options(convention);
    if (!lut) return lut;
    if (!profile.empty()) {
        DERMIS_TRY_ASSIGN(Profile found, find_profile(profile));
        lut->profile = std::move(found);
    }
    if (!size.empty()) {
        DERMIS_TRY_ASSIGN(const Size sides, parse_size(size));
        lut->width = sides.width;
        lut->height = sides.height;
    }
    DERMIS_TRY(choose_axis(*this, lut->convention.axes[1]));
    DERMIS_TRY(choose_construction(*this, lut->convention));
    return lut;
}

Result<ZonalOptions> ZhChoice::options() const {
    DERMIS_TRY_ASSIGN(Profile found, find_profile(profile));
    DERMIS_TRY_ASSIGN(const Construction chosen, find_construction(construction));
    ZonalOptions zonal{.profile = std::move(found),
                       .width = width,
                       .how = {.construction = chosen, .variance_scale = variance_scale}};
    if (axis == "radius")
        zonal.curvature = radius_axis(1, 32);
    else if (axis != "curvature")
        return Error{unknown_name("axis", axis, kAxes)};
    DERMIS_TRY(set_range(zonal.curvature, range));
    if (layout == "remapped")
        zonal.layout = ZonalLayout::two_rows_remapped_8;
    else if (layout != "float")
        return Error{unknown_name("layout", layout, std::vector<std::string>{"float", "remapped"})};
    return zonal;
}

Result<ShadowOptions> ShadowChoice::options() const {
    DERMIS_TRY_ASSIGN(Profile found, find_profile(profile));
    DERMIS_TRY_ASSIGN(const Size sides, parse_size(size));
    DERMIS_TRY_ASSIGN(const Range widths, parse_range("--range", range));
    DERMIS_TRY_ASSIGN(const AxisWarp spacing, find_warp(warp));
    return ShadowOptions{.profile = std::move(found),
                         .width = sides.width,
                         .height = sides.height,
                         .min_width_mm = widths.min,
                         .max_width_mm = widths.max,
                         .width_warp = spacing,
                         .sharpening = sharpening};
}

Result<TableStorage> find_storage(const std::string& path, const std::string& name, TableStorage preferred) {
    static const std::vector<std::string> kNames = {"auto", "8", "16", "half", "float"};
    for (size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == name) {
            if (i == 0 && preferred != TableStorage::automatic && storage_for(path, preferred))
                return preferred;
            return storage_for(path, TableStorage(i));
        }
    return Error{unknown_name("storage", name, kNames)};
}

Result<MadeTable> make_table(LutOptions options) {
    std::string note =
        fit_where_needed(options.profile, options.convention.how, options.convention.integration);
    DERMIS_TRY_ASSIGN(Table table, bake_lut(options));
    return MadeTable{std::move(table), std::move(options.profile), options.storage, std::move(note)};
}

Result<MadeTable> make_table(ZonalOptions options) {
    std::string note = fit_where_needed(options.profile, options.how, Integration::exact);
    DERMIS_TRY_ASSIGN(Table table, bake_zonal_harmonics(options));
    return MadeTable{std::move(table), std::move(options.profile), preferred_storage(options.layout),
                     std::move(note)};
}

Result<MadeTable> make_table(const ShadowOptions& options) {
    DERMIS_TRY_ASSIGN(Table table, bake_shadow(options));
    return MadeTable{std::move(table), options.profile, TableStorage::automatic, ""};
}

TableStorage preferred_storage(ZonalLayout layout) {
    return layout == ZonalLayout::two_rows_remapped_8 ? TableStorage::u8 : TableStorage::automatic;
}

Result<void> check_zonal_storage(const std::string& path, ZonalLayout layout, TableStorage storage) {
    if (layout == ZonalLayout::two_rows_remapped_8 ||
        (storage != TableStorage::u8 && storage != TableStorage::u16))
        return {};
    return Error{path +
                 ": zonal harmonics reach 1.03, which a PNG cannot hold; write .exr, or --layout remapped"};
}

void choose_encoding(Table& table, TableStorage storage) {
    const Convention& convention = table.convention;
    if (convention.kind == TableKind::shadow ||
        (convention.kind == TableKind::diffuse && convention.integration == Integration::exact))
        table.convention.encoding = encoding_for(convention.kind, storage);
}

}  // namespace dermis::cli
