#pragma once
// The reference once for every scene and setting: kept in the disk cache by the content of all it depends
// on.

#include <atomic>
#include <string>

#include "dermis/reference/picture.h"

namespace dermis::inline judge {

/// A hash of everything that the reference's picture depends on: meshes, materials, the bytes of map
/// files, lights, camera, environment, profile, and the settings. Not names, exposure or tone map. Errors: a
/// map file or profile that cannot be read.
[[nodiscard]] Result<std::string> reference_hash(const Scene& scene, const ReferenceSettings& settings);

struct CachedReference {
    ReferencePicture picture;
    bool from_cache = false;
};

/// render_reference(), or the picture that it made before. A stopped picture is returned, but not kept.
/// Errors as both.
[[nodiscard]] Result<CachedReference> cached_reference(const Scene& scene, const ReferenceSettings& settings,
                                                       const ReferenceProgress& progress = {},
                                                       const std::atomic<bool>* stop = nullptr,
                                                       const ReferencePreview& preview = {});

}  // namespace dermis::inline judge
