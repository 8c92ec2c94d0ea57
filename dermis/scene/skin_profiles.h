#pragma once
// Profiles and weights of scattering that materials of skin have of their own.

#include <span>
#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

inline constexpr size_t kMostProfiles = 15;

/// The material's own profile, or the scene's.
[[nodiscard]] const std::string& profile_of(const Scene& scene, const Material& material);

/// Each profile that visible skin has, once, in the order of the materials; the scene's alone where there is
/// no skin.
[[nodiscard]] std::vector<std::string> skin_profiles(const Scene& scene);

/// Index into skin_profiles() of the material's; 0 for what is not skin.
[[nodiscard]] size_t profile_index(const Scene& scene, std::span<const std::string> profiles,
                                   const SceneObject& object, uint32_t material);

/// Some skin does not scatter all of its light.
[[nodiscard]] bool has_scatter_weights(const Scene& scene);

/// Finds the files of profiles of materials beside the scene's file, and reads each once. Errors: more than
/// kMostProfiles, a profile that is not known.
[[nodiscard]] Result<void> resolve_profiles(Scene& scene, const std::filesystem::path& scene_file);

}  // namespace dermis::inline scene
