#pragma once
// The bust as files for other programs.

#include <filesystem>
#include <string_view>

#include "dermis/optics/profile.h"
#include "subjects/bust/bust.h"

namespace dermis {

/// By extension: .glb with albedo, normal, roughness and specular embedded as PNG (glTF has no place for the
/// kernel size) and the profile as a volume that scatters (optics/gltf_profile.h), or .obj with neither.
/// Errors: another extension, an unwritable file. About 3 s of one core
/// at 2048.
/// kBustMaps are written into `maps_folder` unless it is empty. All files or none.
[[nodiscard]] Result<void> write_bust(const std::filesystem::path& path, const Bust& bust,
                                      const Profile& profile, const std::filesystem::path& maps_folder = {});

/// Whether write_bust() knows the extension.
[[nodiscard]] Result<void> check_bust_path(const std::filesystem::path& path);

inline constexpr std::string_view kBustMaps[] = {"albedo.png",   "normal.png",      "roughness.png",
                                                 "specular.png", "kernel_size.png", "melanin.png",
                                                 "blood.png",    "residue.png"};

}  // namespace dermis
