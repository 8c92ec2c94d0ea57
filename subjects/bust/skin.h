#pragma once
// What the skin is like at a point of the standard head.

#include "dermis/base/vec.h"
#include "dermis/optics/tissue/pigment_table.h"
#include "subjects/bust/hairs.h"
#include "subjects/bust/params.h"
#include "subjects/bust/point.h"

namespace dermis::bust {

/// How much a point belongs to each zone, 0 to 1; soft-edged, so one value a vertex is enough. Lip borders,
/// brows and lashes are sharper and found per texel.
struct SkinZones {
    float cheek = 0, nose = 0, t_zone = 0, ear = 0, lid = 0, eye_ring = 0, beard = 0, scalp = 0, forehead = 0,
          neck = 0, mouth = 0, knob = 0, nostril = 0, perioral = 0;
};
inline constexpr int kZoneCount = sizeof(SkinZones) / sizeof(float);

[[nodiscard]] SkinZones skin_zones(Point p_standard);

/// sqrt(fraction / most), as in pigment maps (optics/tissue/pigment_maps.h).
struct PigmentTexel {
    float melanin = 0, blood = 0;
};

/// The skin model's tone of this number, 1 to 6 and between.
[[nodiscard]] PigmentTexel pigments_of_tone(double tone);

struct SkinSample {
    PigmentTexel pigments;
    Vec3 residue = {1, 1, 1};  ///< factor: stubble, shadow in the nostrils and between the lips
    Vec3 hair_linear;          ///< albedo that hairs add
    float roughness = 0.5f;    ///< perceptual
    float specular = 1;        ///< factor on the reflectance at normal incidence
    float kernel_size = 0;     ///< how much of its width light gains where the skin is thin (scene/material)
    float height_mm = 0;       ///< relief too fine for the mesh
};

/// Its colour without hairs and before the balance of paint_maps().
[[nodiscard]] Vec3 bare_albedo_linear(const SkinSample& sample, const PigmentTable& table);

/// About 0.7 microseconds.
[[nodiscard]] SkinSample skin_at(Point p_standard, const SkinZones& zones, const BustParams& params,
                                 const Hairs& hairs);

}  // namespace dermis::bust
