#pragma once
// Transmission through thin parts, for every technique whose shader includes
// shaders/include/transmission.glsl.

#include <string>
#include <vector>

#include "dermis/technique/technique.h"
#include "shaders/include/constants.h"

namespace dermis::inline technique {

enum class Transmission : int32_t { none = kTransmissionNone, shadow_map = kTransmissionShadowMap };

[[nodiscard]] const std::vector<std::string>& transmission_names();
/// The specialisation constant.
inline constexpr const char* kTransmissionConstant = "transmission";
inline constexpr const char* kTransmissionHelp =
    "transmission through ears and other thin parts, gathered from the shadow maps";

/// The pass's reads and constants.
void read_transmission(Pass& pass, Transmission transmission, const FrameContext& frame);

/// The same without the table, for shaders that compute it. Where other opaque surfaces shade skin, the pass
/// reads "lit_skin" (_1, _2), the shadow map's texels that hold skin; the renderer draws it for passes that
/// do.
void read_transmission_without_table(Pass& pass, Transmission transmission, const FrameContext& frame);

/// "skin_transmission", which shadow_map reads: the profile's R per mm^2 over its integral, as the albedo map
/// holds the albedo, at even steps of distance from 0 to transmission_reach_mm(), both ends included, and the
/// reach in alpha.
[[nodiscard]] TableImage transmission_table(const SkinContext& skin);

/// The table as a technique's tables; none where nothing is transmitted.
[[nodiscard]] std::vector<TableImage> transmission_tables(Transmission transmission, const SkinContext& skin);

/// Points nearer than this part of the reach count as so far: the shader's taps are not closer.
inline constexpr double kTransmissionNearest = 0.03;

/// Beyond it leaves a ten thousandth of the light, in the widest channel.
[[nodiscard]] double transmission_reach_mm(const Profile& profile);

}  // namespace dermis::inline technique
