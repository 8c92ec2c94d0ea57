#pragma once
// The material of a mesh file, before any image is decoded.

#include <optional>
#include <string>
#include <vector>

#include "dermis/base/shared_bytes.h"
#include "dermis/base/vec.h"

namespace dermis::inline mesh {

/// How an image continues beyond its edges.
enum class TextureWrap { repeat, clamp, mirror };

/// An image named by a mesh file or a scene: a path, the encoded bytes of an embedded one, or the pixels of
/// one that was made by code.
struct ImageSource {
    std::string name;     ///< path, or a name for errors (unique, when there are pixels)
    SharedBytes encoded;  ///< empty: read `name` from disk
    int width = 0, height = 0, channels = 0;
    SharedBytes pixels;    ///< 8 bit, rows from the top; sRGB where the map is a colour
    std::string named_by;  ///< the file that names it, for errors; may be empty
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;

    [[nodiscard]] bool present() const { return !name.empty() || !encoded.empty(); }
};

/// The point of the image, 0 .. 1, that is read at uv.
[[nodiscard]] Vec2 inside_image(const ImageSource& image, Vec2 uv);

/// Limit of each channel of Material::emission_linear.
inline constexpr float kMostEmission = 1000;

enum class NormalSpace { tangent, object };
enum class AlphaMode { opaque, mask, blend };

/// Lengths in mm, colours linear. Maps multiply the constant beside them, as in glTF.
struct Material {
    std::string name;
    Vec3 base_color_linear = {0.8f, 0.8f, 0.8f};
    bool base_color_stated = false;  ///< by the mesh file
    float opacity = 1;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  ///< of AlphaMode::mask: less opacity is none (cutoff_of_map)
    float roughness = 0.5f;     ///< perceptual, alpha = roughness^2
    float metallic = 0;
    float specular = 1;  ///< scales the dielectric F0
    float ior = 1.5f;
    std::string profile;  ///< of skin; empty: the scene's (scene::Skin)
    float scatter = 1;    ///< of skin: share of its diffuse light that scatters; the rest is Lambert's
    Vec3 emission_linear = {0, 0, 0};
    bool double_sided = false;  ///< kept for export: every surface is drawn from both sides

    NormalSpace normal_space = NormalSpace::tangent;
    float normal_scale = 1;

    ImageSource base_color_map;  ///< sRGB; A multiplies opacity unless the mode is opaque
    ImageSource melanin_map, blood_map,
        residue_map;           ///< `dermis bake pigments`; a scene paints base_color_map
    ImageSource pigment_mask;  ///< R: where the scene's scales of melanin and blood act
    ImageSource alpha_map;     ///< A, or else R: replaces the A of base_color_map
    ImageSource emission_map;  ///< sRGB
    ImageSource normal_map;    ///< data
    ImageSource wrinkle_stretch_map, wrinkle_compress_map;  ///< data: normals over normal_map, by tension
    ImageSource metallic_roughness_map;                     ///< roughness in G, metallic in B
    ImageSource specular_map;                               ///< factor in A when from glTF, in R otherwise
    ImageSource occlusion_map;                              ///< R
    ImageSource displacement_map;                           ///< R, mid and amplitude stated by the scene
    ImageSource thickness_map;                              ///< G
    ImageSource opacity_map;                                ///< coloured transmittance of translucent objects
    ImageSource transmission_map;                           ///< A
    ImageSource roughness_map;    ///< perceptual, R; when present it replaces metallic_roughness_map's
    ImageSource metallic_map;     ///< R; when present it replaces metallic_roughness_map's
    ImageSource kernel_size_map;  ///< R: 0 on thick skin, up to 1 where blurs widen because it is thin
    ImageSource scatter_map;      ///< R
    ImageSource curvature_map;    ///< (value - curvature_mid) * curvature_scale_per_mm; as bake_map has
                                  ///< it, or one channel: mean curvature

    /// Sizes of a tension (mesh/tension.h) at which the wrinkle maps begin and at which they are all.
    float wrinkle_from = 0.05f, wrinkle_full = 0.4f;
    /// Morph targets whose weights are the least shares of the wrinkle maps; empty: tension alone.
    std::string wrinkle_stretch_target, wrinkle_compress_target;

    float thickness_scale_mm = 1;         ///< thickness of a map value of 1
    float curvature_scale_per_mm = 1;     ///< curvature of a map value of 1
    float curvature_mid = 0;              ///< the map value of flat skin
    float displacement_mid = 0.5f;        ///< the map value of no displacement
    float displacement_amplitude_mm = 0;  ///< along the normal, for a step of 1 in map value
    int dilate_texels = 0;                ///< maps without a gutter: grow the UV islands by so much on load

    /// glTF's subsurface description, when the file has one (KHR_materials_volume, _diffuse_transmission,
    /// _volume_scatter, _scatter).
    struct Scattering {
        float thickness_mm = 0;
        Vec3 attenuation_color = {1, 1, 1};
        float attenuation_distance_mm = 0;  ///< 0: infinite
        Vec3 multiscatter_color = {0, 0, 0};
        float scatter_strength = 1;  ///< 0..1, below 1 in KHR_materials_scatter only
        float anisotropy = 0;        ///< Henyey-Greenstein g, -1..1
        float diffuse_transmission = 0;
        Vec3 diffuse_transmission_color = {1, 1, 1};
    };
    std::optional<Scattering> scattering;
};

/// Hair and lashes are often flat cards with an alpha map: the surface is cut out where map times the
/// vertices' alpha is below this value; 0: nothing is cut out. Shadows of blended materials are cut out at
/// 0.5 of the map; materials less than half opaque cast none.
[[nodiscard]] float cutoff_of_map(const Material& material);

/// Whether it is blended over the background, by its opacity times that of the alpha map and the vertices.
[[nodiscard]] bool is_blended(const Material& material);

/// A map and what it holds: "base color", "normal".
struct NamedMap {
    const char* kind;
    const ImageSource* image;
};
/// The maps that the material has. They point into it.
[[nodiscard]] std::vector<NamedMap> maps_of(const Material& material);

}  // namespace dermis::inline mesh
