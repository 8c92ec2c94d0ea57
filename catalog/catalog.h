#pragma once
// All techniques, subjects and shaders of this repository, for programs, tests and benchmarks. The libraries
// of dermis/ get it as an argument.

#include <map>
#include <string>
#include <vector>

#include "dermis/engines/package.h"
#include "dermis/render/catalog.h"
#include "dermis/shading/shading.h"

namespace dermis {

/// Made at the first call, by any thread.
[[nodiscard]] const Catalog& built_in_catalog();

/// The files of engines/ but for engines/web, and LICENSE.
[[nodiscard]] std::span<const PackageTemplate> built_in_package_templates();

/// The places at which packages look up the shadows of a light for this skin: PackageInput::shadow_places.
[[nodiscard]] Result<ShadowPlaces> package_shadow_places(const Profile& profile);

/// The gain that packages of this skin have, PackageInput::gain. `settings`: of the technique preintegrated;
/// none with gain=none. Of walks, which are cached: about 4 s of processor time.
[[nodiscard]] Result<PackageGain> package_gain(const Profile& profile,
                                               const std::map<std::string, std::string>& settings = {});

/// The files of engines/web, LICENSE, and the shaders that the page shares with the renderer.
[[nodiscard]] std::span<const shading::Source> built_in_web_texts();

}  // namespace dermis
