#pragma once
// What is walked at the vertices of a scene whose materials may have several profiles.

#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"
#include "dermis/rays/vertex_links.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

struct WalkedProfile {
    ScatteringMedium medium;
    GaussianSum gaussians;
};

/// What the functions below depend on beside shapes and `profiles`, which are in the order of
/// skin_profiles().
[[nodiscard]] std::string walks_key(const Scene& scene);

/// Gains (dermis/rays/vertex_gain.h), one array an object, each vertex by its material's profile. With
/// rest_bakes.gain they are of the rest pose.
[[nodiscard]] Result<std::vector<std::vector<Vec3>>> walk_scene_gains(
    const Scene& scene, std::span<const WalkedProfile> profiles);

/// Links likewise.
[[nodiscard]] Result<VertexLinks> walk_scene_links(const Scene& scene,
                                                   std::span<const WalkedProfile> profiles);

}  // namespace dermis::inline render
