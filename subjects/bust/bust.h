#pragma once
// The built-in head: an adult bust with closed eyes, made by code alone, with its skin.
//
//     Result<Bust> bust = make_bust({.tone = 4});
//     if (!bust) return bust.error();
//
// Shape: smooth blends of parts as a distance field (bust/field.h), proportions after published anthropometry
// (Farkas 1994, Anthropometry of the Head and Face) and an average of scans. Mesh: 60,000 to 200,000
// triangles, closed once vertices of equal position are welded, finer at lids, lips, nose and ears; one UV
// atlas 0..1 without overlap.

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/mesh/mesh.h"
#include "subjects/bust/params.h"

namespace dermis {

/// All maps are kBustMapSide square and share the mesh's atlas.
struct Bust {
    Mesh
        mesh;  ///< mm, Y up, faces +Z, origin between the ears; normals are the field's; tangents with w = +1
    Image albedo;          ///< RGB u8 sRGB
    Image normal;          ///< RGB u8, tangent space (x along +u, y up the image, z out)
    Image roughness;       ///< u8, perceptual
    Image specular;        ///< u8, factor on the reflectance at normal incidence
    Image kernel_size;     ///< u8: 0 on thick skin, more at ears, nostrils and lids, which are thin
    Image melanin, blood;  ///< u8, as pigment maps (optics/tissue/pigment_maps.h)
};
inline constexpr int kBustMapSide = 2048;

/// Loads it from the cache, or makes it (under 10 s on two cores) and stores it there (about 53 MB a set of
/// parameters). The same parameters give the same bytes on any number of cores. Errors: a parameter out of
/// range.
[[nodiscard]] Result<Bust> make_bust(const BustParams& params = {});

/// The same without touching the cache, maps of any side.
[[nodiscard]] Result<Bust> build_bust(const BustParams& params, int map_side);

}  // namespace dermis
