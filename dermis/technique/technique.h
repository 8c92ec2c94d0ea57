#pragma once
// A technique: parameters, the tables it needs, and a pure function from settings to a list of
// passes.
//
// A folder techniques/<id>/ defines `dermis::Technique dermis::make_<id>_technique();` and is found by CMake.
// A technique draws the skin: it writes linear radiance into the colour target "radiance" and depth into
// "depth" (both declared and cleared by the renderer, so it loads them). Everything else in the scene is
// drawn by the renderer.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/parameter.h"
#include "dermis/optics/profile.h"
#include "dermis/technique/figure.h"
#include "dermis/technique/pass_list.h"

namespace dermis::inline technique {

/// The values of the frame that build() may use.
struct FrameContext {
    std::string view = "final";  ///< a debug view: final, diffuse, specular, or one of the technique's own
    float camera_distance_mm = 600;
    /// Where the camera stood in the frame before, if that had the same technique, settings and lights, so
    /// that persistent images hold what this frame would draw again; else 0.
    float previous_camera_distance_mm = 0;
    int shadow_map_size = 2048;    ///< of the frame's shadow maps, which a pass may test against
    int shadow_map_count = 1;      ///< "shadow_map", "shadow_map_1" ...; the first is always there
    bool has_other = false;        ///< the scene has opaque surfaces that are not skin, which shade skin
    bool has_translucent = false;  ///< the scene has translucent surfaces, which tint the key light
    bool has_second_light = false;
    bool reduced_diffuse = false;  ///< the scene's Skin::specular_reduces_diffuse
    /// Longest step in UV that a millimetre on the skin takes, in 99 % of its area.
    float densest_uv_per_mm = 0.004f;
    /// The median by area of the mean step over all directions.
    float typical_uv_per_mm = 0.003f;
    /// Sides of light maps over light_map_size: more than 1 where Dermis laid out the atlas, which has gaps.
    float light_map_scale = 1;
    /// Why no map can be baked over the skin's UV atlas, and what to change; empty: one can.
    std::string atlas_fault;
    bool has_skin_outside_atlas = true;  ///< some of the skin has UVs in other tiles than 0..1
    bool has_zonal_table = false;        ///< SkinContext::zonal_table is given
    bool has_beckmann_table = false;     ///< SkinContext::beckmann_table is given
    GaussianSum skin_gaussians;          ///< of the scene's profile
};

/// The skin and the scene that tables are baked for.
struct SkinContext {
    Profile profile;
    GaussianSum gaussians;            ///< the profile itself, or its fit
    std::string diffuse_table = {};   ///< a file to read instead of baking (bake/table_io.h); empty: none
    std::string zonal_table = {};     ///< the same for light from the environment
    std::string beckmann_table = {};  ///< the same for the distribution of specular=ksk
};

/// A table for the GPU: rows top to bottom, texels tightly packed in `format`.
struct TableImage {
    std::string name;
    ImageFormat format = ImageFormat::rgba16f;
    int width = 0, height = 0;
    std::vector<std::byte> bytes;
};

/// `texels`, floats or arrays of floats, as a table of `height` rows.
template <class T>
[[nodiscard]] TableImage table_image(std::string name, int height, const std::vector<T>& texels,
                                     ImageFormat format = ImageFormat::rgba32f) {
    const auto bytes = std::as_bytes(std::span(texels));
    const int width = int(bytes.size() / bytes_per_texel(format)) / height;
    return {std::move(name), format, width, height, {bytes.begin(), bytes.end()}};
}

struct Technique {
    std::string id;
    std::string summary;  ///< one line
    std::string source;   ///< author, year, title
    /// Scatters nothing: effects and costs of the others are stated against it. One technique of a catalog.
    bool is_baseline = false;
    /// Draws where no technique is chosen: it has the highest share of docs/scoreboard.md on heads. One
    /// technique of a catalog.
    bool is_default = false;
    ParameterTable parameters;
    std::vector<std::string> views;  ///< debug views beyond final, diffuse, specular
    /// Why no frame can be made of these settings and what to change, "a=x ignores b; drop b or set a=y";
    /// empty for a combination that can be. Absent where all can be. build(), tables() and the like see no
    /// other.
    std::function<std::string(const ParameterValues&)> refusal;
    std::function<PassList(const ParameterValues&, const FrameContext&)> build;
    /// Tables for these settings, baked on the CPU (cached by the bakers); absent when it needs none.
    std::function<Result<std::vector<TableImage>>(const ParameterValues&, const SkinContext&)> tables;
    /// The members of the uniform block "Skin" for these settings, computed when tables are; absent when no
    /// shader has it.
    std::function<Result<std::vector<NamedValue>>(const ParameterValues&, const SkinContext&)> skin_values;
    /// Cheaper settings for interaction on slow devices, where the picture has `scale` (under 1) of its
    /// sides: the same look with fewer texels, taps or passes. Absent when only pixels cost.
    std::function<ParameterValues(ParameterValues, float scale)> coarse;
    /// The figures of its source, for `dermis figures`; absent when it has none.
    std::function<std::vector<Figure>()> figures;
};

/// Error: an unknown id, with the nearest and all known ones.
[[nodiscard]] Result<const Technique*> find_technique(std::span<const Technique> techniques,
                                                      std::string_view id);

/// Error: none of them is the baseline.
[[nodiscard]] Result<const Technique*> find_baseline(std::span<const Technique> techniques);

/// Error: none of them is the default.
[[nodiscard]] Result<const Technique*> find_default(std::span<const Technique> techniques);

/// Errors: a value out of its range, a combination that the technique refuses.
[[nodiscard]] Result<void> check_settings(const Technique& technique, const ParameterValues& values);

}  // namespace dermis::inline technique
