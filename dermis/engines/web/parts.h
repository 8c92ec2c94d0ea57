#pragma once
// What web.cpp puts the page together from. Internal to dermis/engines.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/engines/target_curvature.h"
#include "dermis/engines/web.h"
#include "dermis/image/image.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/rig.h"

namespace dermis::inline engines::web {

/// scene.bin, which the page hands to the GPU as it is: little-endian values, one behind the other.
class Binary {
  public:
    /// Where the next value will be; blocks begin at a multiple of four.
    [[nodiscard]] size_t begin_block() {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return bytes_.size();
    }
    template <class T>
    void put(T value) {
        const size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &value, sizeof(T));
    }
    [[nodiscard]] size_t size() const { return bytes_.size(); }
    [[nodiscard]] std::vector<std::byte> finish() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

/// Three colours in 32 bits: mantissas of 9 bits under one exponent (EXT_texture_shared_exponent). Error at
/// most 0.2 % of the largest channel; negative channels count as 0.
[[nodiscard]] uint32_t shared_exponent(Vec3 color_linear);

/// The diffuse tables of all tones as layers of one texture of shared exponents; their other
/// functions as rows of another, of halves. Sizes and offsets as JSON. `baked_curvature_per_mm`: where the
/// tones' diffuse tables end. Errors: a table that is not rgba32f.
[[nodiscard]] Result<nlohmann::json> add_tables(Binary& binary, std::span<const WebTone> tones,
                                                float baked_curvature_per_mm);

/// Prefiltered cube without its largest level, spherical harmonics, and the split sum's second factor.
[[nodiscard]] Result<nlohmann::json> add_environment(Binary& binary, const Environment& environment);

/// With no more digits than the float has.
[[nodiscard]] nlohmann::json to_json(float value);
[[nodiscard]] nlohmann::json to_json(Vec3 v);

inline constexpr uint32_t kNotOnPage = ~0u;

struct MeshOnPage {
    nlohmann::json json;
    std::vector<uint32_t> number;  ///< on the page, of each vertex of the mesh; kNotOnPage: left out
};

/// Vertices and indices into `binary`, in the layout of engines/web/gpu.js; where they are, and the ranges of
/// what is stored as whole numbers, as JSON. `mesh` has curvature and occlusion. "parts" is the caller's: one
/// a submesh, with "first" and "count".
[[nodiscard]] Result<MeshOnPage> add_mesh(Binary& binary, const Mesh& mesh, size_t triangle_count);

/// A copy with tangents, where it has none as the page makes them.
[[nodiscard]] Mesh with_tangents(Mesh mesh);

/// Names of the morph targets that a clip moves or that the pose has.
[[nodiscard]] std::vector<std::string> used_targets(const Rig& rig);

/// What moves a mesh, into `binary` and as JSON: motion.cpp. `rig` is of the mesh with_tangents(), which
/// has the vertices of the curvatures; `number_on_page` as MeshOnPage has it.
[[nodiscard]] nlohmann::json add_motion(Binary& binary, const Rig& rig,
                                        std::span<const TargetCurvature> curvatures,
                                        std::span<const uint32_t> number_on_page);

/// The image behind a texture of shaders/include/surface.glsl, at most `side` texels wide and high; empty:
/// none.
[[nodiscard]] Result<Image> load_map(const Material& material, const Mesh& mesh, std::string_view texture,
                                     int side);
/// Names what materials of skin have that a "page" or a "package" drops: it has one profile for all skin.
void warn_of_materials(const Scene& scene, std::string_view product, std::vector<std::string>& warnings);
/// Three channels of 8 bits; what is missing is 1.
[[nodiscard]] Image three_channels(const Image& image);
/// Three maps of one channel as one picture of the largest one's size.
[[nodiscard]] Image packed(const std::array<Image, 3>& singles);

/// Adds the maps of `material` to `files` as "maps/N_albedo.jpg", "_normal.jpg" and "_surface.jpg"
/// (roughness, factor on the reflectance, occlusion). JSON: "maps" has the paths of those that there are,
/// "wraps" what one has beyond its edges along u and v, where it does not repeat. Error: maps of one picture
/// wrap differently.
[[nodiscard]] Result<nlohmann::json> add_maps(std::vector<WebFile>& files, const Material& material,
                                              const Mesh& mesh, const std::string& prefix, int map_side);

}  // namespace dermis::inline engines::web
