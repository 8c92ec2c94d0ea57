#pragma once
// A skin as a folder that an engine opens: shader, table, import settings, example, README, licence.
//
//     Result<std::vector<PackageFile>> files = make_package("godot", {.profile = skin, ...});
//
// A package is a folder of text files (engines/<engine>), in which words between @ are replaced,
// and one Engine (engine.h) that names what is generated beside them. The same input gives the same bytes.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/optics/gain_form.h"
#include "dermis/optics/profile.h"
#include "dermis/shading/shading.h"

namespace dermis::inline engines {

/// `path` is relative to the package's folder, with '/'.
struct PackageFile {
    std::string path;
    std::vector<std::byte> bytes;
};

/// A file of this repository by its path: "engines/godot/README.md", "LICENSE". The functions of
/// engines/common and the licence are for every engine, its scripts for those in a browser.
struct PackageTemplate {
    std::string path, text;
};

/// A place around a point at which a package looks up the shadow of a light
/// (shaders/include/skin/gathered_shadow.glsl).
struct ShadowPlace {
    Vec3 offset_mm;      ///< on two tangents, and off the surface
    Vec3 weight;         ///< of each channel
    float penumbra = 1;  ///< weight in the penumbra alone
};

struct ShadowPlaces {
    std::vector<ShadowPlace> all;
    size_t first = 0;  ///< where so many agree with the filtered shadow, the others are not read
};

/// What this skin returns beyond its profile; as it is: nothing (docs/transport.md).
struct PackageGain {
    GainForm of_curvature;
    Rgb of_slabs = {1, 1, 1};  ///< on light through thin parts
};

/// What an engine needs of a head beyond what every head holds.
struct HeadFormat {
    bool map_files = false;         ///< the maps of skin are files of their own, not in the GLB
    bool linear_keys = false;       ///< clips without cubic splines
    bool ambient_probe = false;     ///< scene.json has Unity's numbers for light from all around
    bool reflected_shares = false;  ///< what of light from all around a lobe reflects is a picture
    bool reflections = false;       ///< what lobes see of the environment is a picture
    /// The head stands still, numbers of its vertices are maps, and lights have maps of their
    /// shadows: for an engine whose materials read neither vertices' numbers nor shadows.
    bool still_maps = false;
};

struct PackageInput {
    Profile profile;
    std::span<const shading::Source> functions;  ///< shaders/include/skin
    std::span<const PackageTemplate> templates;
    ShadowPlaces shadow_places = {};
    PackageGain gain = {};
    /// A head with its maps (engines/head.h). With it the package has the files of its template folder head/.
    std::span<const PackageFile> head = {};
};

/// "godot", ...
[[nodiscard]] std::vector<std::string> engine_names();

/// Success when there is such an engine. Error: an unknown name; the message has the closest known one.
[[nodiscard]] Result<void> check_engine(std::string_view name);

/// What its head holds beyond what every head does.
[[nodiscard]] HeadFormat head_format(std::string_view engine);

/// The functions of engines/common/gain.glsl with this skin's gain, for shading::skin_text().
[[nodiscard]] Result<shading::Source> gain_source(std::span<const PackageTemplate> templates,
                                                  const PackageGain& gain);

/// All files in the order of their paths. Errors: an unknown engine, a profile that cannot be pre-integrated.
[[nodiscard]] Result<std::vector<PackageFile>> make_package(std::string_view engine,
                                                            const PackageInput& input);

}  // namespace dermis::inline engines
