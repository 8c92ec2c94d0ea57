#pragma once
// The bust as files for other programs.

#include <filesystem>

#include "dermis/optics/profile.h"
#include "subjects/bust/bust.h"

namespace dermis {

/// By extension: .glb with albedo, normal, roughness and specular embedded as PNG (glTF has no place for the
/// kernel size) and the profile as a volume that scatters (optics/gltf_profile.h), or .obj with neither.
/// Errors: another extension, an unwritable file. About 3 s of one core
/// at 2048.
[[nodiscard]] Result<void> write_bust(const std::filesystem::path& path, const Bust& bust,
                                      const Profile& profile);

/// albedo.png, normal.png, roughness.png, specular.png and kernel_size.png into `folder`, which is made if
/// missing.
[[nodiscard]] Result<void> write_bust_maps(const std::filesystem::path& folder, const Bust& bust);

}  // namespace dermis
