#include "catalog/catalog.h"

#include <algorithm>
#include <cstring>

#include "catalog/parts.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/slab_gain.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/technique.h"
#include "techniques/preintegrated/constants.h"

namespace dermis {
namespace {

Vec4 texel_of(const TableImage& rows, int row, int column) {
    Vec4 texel;
    std::memcpy(&texel, &rows.bytes[sizeof(Vec4) * size_t(row * rows.width + column)], sizeof texel);
    return texel;
}

}  // namespace

const Catalog& built_in_catalog() {
    static const Catalog catalog = {
        .techniques = built_in_techniques(), .subjects = built_in_subjects(), .shaders = built_in_shaders()};
    return catalog;
}

Result<ShadowPlaces> package_shadow_places(const Profile& profile) {
    DERMIS_TRY_ASSIGN(const Technique* technique,
                      find_technique(built_in_catalog().techniques, "preintegrated"));
    const SkinContext skin = {.profile = profile, .gaussians = to_gaussian_sum(profile).sum};
    DERMIS_TRY_ASSIGN(const std::vector<TableImage> tables,
                      technique->tables(ParameterValues(technique->parameters), skin));
    const auto rows = std::ranges::find(tables, "skin_rows", &TableImage::name);
    if (rows == tables.end()) return Error{"the technique makes no table skin_rows"};
    ShadowPlaces places = {.all = {}, .first = size_t(kShadowFirstTaps)};
    for (int i = 0; i < kShadowGatherTaps; ++i) {
        const Vec4 weight = texel_of(*rows, kRowTapWeights, i), place = texel_of(*rows, kRowTapPlaces, i);
        places.all.push_back({.offset_mm = {place.x, place.y, place.z},
                              .weight = {weight.x, weight.y, weight.z},
                              .penumbra = weight.w});
    }
    return places;
}

Result<PackageGain> package_gain(const Profile& profile, const std::map<std::string, std::string>& settings) {
    DERMIS_TRY_ASSIGN(const Technique* technique,
                      find_technique(built_in_catalog().techniques, "preintegrated"));
    ParameterValues values(technique->parameters);
    DERMIS_TRY(values.set_all(settings));
    if (values.text(*technique->parameters.find("gain")) == gain_names()[size_t(Gain::none)])
        return PackageGain{};
    return PackageGain{.of_curvature = walked_gain_form(walk_medium_of(profile)),
                       .of_slabs = walked_slab_gain(profile)};
}

}  // namespace dermis
