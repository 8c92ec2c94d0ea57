#pragma once
// The sky that SkinHead.cs sets, as Unity's shader Skybox/Panoramic draws it, prefiltered by Dermis in place
// of Unity.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "dermis/base/result.h"
#include "dermis/gpu/device.h"

namespace dermis::unity_head {

/// A cube in Unity's axes whose levels have even roughnesses from 0 to 1. Errors: the script turns the sky in
/// another way than is modelled.
[[nodiscard]] Result<gpu::TextureData> sky_cube(const std::filesystem::path& package,
                                                const nlohmann::json& scene);

}  // namespace dermis::unity_head
