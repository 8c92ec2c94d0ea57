#pragma once
// A skin's albedo map as maps of its pigments, and back, with edits.
//
// A texel of a melanin map is sqrt(fraction / kMostMelanin), of a blood map sqrt(fraction / kMostBlood)
// (pigment_table.h), so that 8 bits suffice to paint them. The residue is what the two pigments cannot make
// (hair, make-up, light that was painted in): a factor of each channel, 0.5 + log2(factor) / 16.

#include <functional>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/optics/tissue/pigment_table.h"

namespace dermis::inline optics {

/// Linear; made with 16 bits. An empty residue is a factor of 1.
struct PigmentMaps {
    Image melanin, blood, residue;  ///< 1, 1 and 3 channels
};

/// Changes of a skin; 0 changes nothing. A mask scales all of them.
struct SkinEdit {
    double melanin_scale = 1, blood_scale = 1;
    double tan = 0;     ///< 1 adds a melanin fraction of kTanMelanin
    double pallor = 0;  ///< 1 takes all blood away
    double blush = 0;   ///< 1 adds a blood fraction of kBlushBlood
    double age = 0;     ///< 1 doubles the unevenness of melanin and takes a third of the blood away
    friend bool operator==(const SkinEdit&, const SkinEdit&) = default;
};
inline constexpr double kBlushBlood = 0.03, kTanMelanin = 0.03;

using PigmentProgress = std::function<void(size_t texels)>;

/// `albedo`: one to four channels; alpha is ignored. `exposure` > 0 divides the colours before the pigments
/// are looked up: 1.3 for a map that is 30 % too bright. The residue keeps the factor, so the map comes back.
[[nodiscard]] PigmentMaps pigment_maps_of(const Image& albedo, const PigmentTable& table, double exposure = 1,
                                          const PigmentProgress& progress = {});

/// The residue with which maps of melanin and blood give this albedo map of their size.
void add_residue(PigmentMaps& maps, const Image& albedo, const PigmentTable& table);

/// What maps of one size do not have is taken from `missing`. Errors: maps of different sizes, no map.
struct PigmentPainting {
    const PigmentMaps* maps = nullptr;
    Pigments missing;
    SkinEdit edit;
    const Image* mask = nullptr;  ///< red channel; any size; nothing: 1 everywhere
};
/// u8, sRGB, three channels. Without an edit it is the map that the pigments were made of, within 1 / 255.
[[nodiscard]] Result<Image> albedo_of(const PigmentPainting& painting, const PigmentTable& table,
                                      const PigmentProgress& progress = {});

/// Mean pigments of the maps' texels, the lower and the upper tenth left out.
[[nodiscard]] Pigments mean_pigments(const PigmentPainting& painting);

}  // namespace dermis::inline optics
