#pragma once
// Profiles in glTF materials: KHR_materials_volume (ratified), entered through
// KHR_materials_diffuse_transmission (release candidate), scattering by KHR_materials_volume_scatter or its
// successor KHR_materials_scatter (both proposals).
//
// attenuationColor and attenuationDistance (metres) are sigma_t = -ln(colour) / distance, a channel each; 1 /
// sigma_t is the mean free path. multiscatterColorFactor is what a half-space of the volume reflects of
// diffuse light, linear Rec. 709: the profile's albedo.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// The member of a material's `extras` that holds its profile exactly. Other programs keep
/// or ignore it.
inline constexpr const char* kGltfExactProfile = "dermis_profile";

/// The volume of the first material that scatters, as a Burley profile named after it; or its exact profile,
/// where the volume is still that profile's. `file` is a GLB or
/// glTF's JSON; meshes, buffers and textures are not looked at. `place` names it in errors. What was assumed
/// or not read follows in `source`, separated by semicolons.
/// Errors: neither, truncated, no material that scatters, one without a volume or without attenuation, a
/// number that is missing, not finite or out of its range.
[[nodiscard]] Result<Profile> parse_gltf_profile(std::span<const std::byte> file, std::string_view place);
[[nodiscard]] Result<Profile> read_gltf_profile(const std::filesystem::path& path);

/// The volume of a profile, isotropic.
struct GltfVolume {
    Rgb multiscatter_color, attenuation_color;
    double attenuation_distance_m;
};
/// `surface_albedo` takes the place of an albedo of 1, which a blur has whose colour lies in a map: a volume
/// without absorption reflects white.
[[nodiscard]] GltfVolume gltf_volume(const Profile& profile, const Rgb& surface_albedo);
/// JSON of the material's `extras`.
[[nodiscard]] std::string gltf_extras(const Profile& profile);
/// The parts of the profile that the volume loses, in one line.
[[nodiscard]] std::string gltf_note(const Profile& profile);

}  // namespace dermis::inline optics
