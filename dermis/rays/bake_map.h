#pragma once
// Maps of a mesh, one value per texel of its UV atlas, which techniques read beside the artist's maps. They
// are here because thickness and occlusion need rays.

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/optics/profile.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

enum class MapKind {
    curvature,  ///< in 1/mm, positive where convex; of the curvature tensor S (mesh/curvature.h) in the frame
                ///< of tangent t and bitangent b: its mean (t.St + b.Sb) / 2, (t.St - b.Sb) / 2, and t.Sb
    thickness,  ///< mm of material under the surface: mean depth of inward rays, see
                ///< BakeMapSettings::cone_rad
    kernel_size,  ///< 0..0.996: how thin the skin is against the reach of light; blurs grow with it
    stretch,      ///< mm per unit of u, mm per unit of v, cosine of the angle between the two directions
    occlusion,    ///< ambient visibility 0..1, as vertex_occlusion.h has it
    gain          ///< of uniform light, over flat skin: red, green, blue of vertex_gain.h, between vertices
};

/// "curvature", "thickness", "kernel-size", "stretch", "occlusion", "gain".
[[nodiscard]] std::string_view map_kind_name(MapKind kind);

struct BakeMapSettings {
    MapKind kind = MapKind::curvature;
    int size = 2048;         ///< texels a side, 16..16384
    int gutter_texels = 16;  ///< islands grow by so much, 0..256
    /// Rays are traced on a grid of at most this many texels a side and interpolated: what they find is
    /// smooth.
    int ray_size = 1024;
    int rays = 32;           ///< a texel of that grid, 1..4096
    float smoothing_mm = 0;  ///< curvature: see compute_curvature
    /// Thickness: half angle of the cone around the inward normal, 0..1.5. Rays are cosine-weighted, and each
    /// counts with its depth, distance times cosine: exact for a slab whatever the angle; a sphere of radius
    /// R reads R (1 + cos^2 cone).
    float cone_rad = 0.7853982f;
    float max_mm =
        200;  ///< thickness where no ray finds the far side; occlusion: how far it looks (0: any distance)
    float walks_per_mm2 = 32;             ///< gain: 0.1..10000
    std::optional<Profile> profile;       ///< kernel_size and gain need it
    std::optional<std::string> material;  ///< else all skin
    /// Curvature is in the frame of the file's tangents with either.
    UvSet uvs = UvSet::atlas;
};

struct BakedMap {
    MapKind kind = MapKind::curvature;
    Image values;    ///< f32, linear, 1 channel (curvature, stretch, gain: 3), gutter included
    Image coverage;  ///< u8: 255 where a triangle lies
    std::string unit;
    float min = 0, max = 0;  ///< over covered texels, first channel
    Vec3 noise;              ///< gain: its standard error, root mean square
    std::vector<std::string> warnings;
};

/// Kernel size: s / (s + t), t the thickness and s the radius within which 95 % of the light of the profile's
/// widest channel leaves; at most 254/255, because 1 means "not written" in the texture-space method
/// (Gosselin, Sander, Mitchell 2004). Half where the skin is as thick as light spreads; an ear of 4 mm reads
/// .53 with the GPU Gems 3 profile.
[[nodiscard]] float kernel_size_of_thickness(float spread_mm, float thickness_mm);
[[nodiscard]] float spread_radius_mm(const Profile& profile);

/// Errors: sizes out of range, no UVs, no covered texel, an unknown material, no profile. Warnings: overlap,
/// UVs outside 0..1, thickness rays that leave through holes. 2048 x 2048 on the head scan: see bench/.
[[nodiscard]] Result<BakedMap> bake_map(std::span<const SceneObject> objects, const BakeMapSettings& settings,
                                        const std::function<void(double done)>& progress = {});

}  // namespace dermis::inline rays
