#include "dermis/technique/transmission.h"

#include <algorithm>
#include <cmath>

#include "dermis/technique/forward.h"

namespace dermis::inline technique {
namespace {

constexpr const char* kTable = "skin_transmission";
constexpr double kPartReached = 0.9999;

}  // namespace

const std::vector<std::string>& transmission_names() {
    static const std::vector<std::string> kNames = {"none", "shadow_map"};
    return kNames;
}

void read_transmission_without_table(Pass& pass, Transmission transmission, const FrameContext& frame) {
    const bool lit_skin = transmission != Transmission::none && frame.has_other;
    for (int i = 0; i < kMaxShadowMaps; ++i)
        pass.reads.emplace_back(
            shadow_image("lit_skin", i),
            shadow_image(lit_skin ? "lit_skin" : "shadow_map", i < frame.shadow_map_count ? i : 0));
    pass.constants.emplace_back(kTransmissionConstant, int32_t(transmission));
}

// Something must be bound even where the shader, by its constants, never looks.
void read_transmission(Pass& pass, Transmission transmission, const FrameContext& frame) {
    pass.reads.emplace_back(kTable, transmission == Transmission::none ? "no_image" : kTable);
    read_transmission_without_table(pass, transmission, frame);
}

double transmission_reach_mm(const Profile& profile) {
    double reach = 0;
    for (int c = 0; c < 3; ++c)
        if (diffuse_albedo(profile, c) > 0) reach = std::max(reach, inverse_cdf_mm(profile, c, kPartReached));
    return reach > 0 && std::isfinite(reach) ? reach : 1;
}

TableImage transmission_table(const SkinContext& skin) {
    const double reach = transmission_reach_mm(skin.profile);
    std::vector<float> rgba;
    for (int i = 0; i < kTransmissionTexels; ++i) {
        const double distance_mm =
            reach * std::max(double(i) / (kTransmissionTexels - 1), kTransmissionNearest);
        for (int c = 0; c < 3; ++c) {
            const double albedo = diffuse_albedo(skin.profile, c);
            rgba.push_back(albedo > 0 ? float(reflectance_per_mm2(skin.profile, c, distance_mm) / albedo)
                                      : 0.0f);
        }
        rgba.push_back(float(reach));
    }
    return table_image(kTable, 1, rgba);
}

std::vector<TableImage> transmission_tables(Transmission transmission, const SkinContext& skin) {
    if (transmission == Transmission::none) return {};
    return {transmission_table(skin)};
}

}  // namespace dermis::inline technique
