#pragma once
// A technique's pictures for the judge: drawn `grid` times the size and averaged, beside the baseline's with
// all else equal.

#include <map>
#include <string>

#include "dermis/judge/scores.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/technique_list.h"

namespace dermis::inline judge {

struct PictureSettings {
    int width = 512, height = 512;
    int grid = 4;  ///< a pixel is the average of grid x grid
    int shadow_map_size = 4096;
    float penumbra_mm = 2;
};

struct TechniquePictures {
    Image radiance;  ///< linear, RGBA; beyond the skin as drawn
    Image effect;    ///< RGB: radiance less the baseline's
};

/// Keeps the pictures of the baseline, one for each setting of the parameters that it shares with a technique
/// (the specular model).
class PictureMaker {
  public:
    /// The renderer must outlive it.
    PictureMaker(Renderer& renderer, const Technique& baseline, const PictureSettings& settings)
        : renderer_(renderer), baseline_(baseline), settings_(settings) {}

    /// Errors name the contestant.
    [[nodiscard]] Result<TechniquePictures> make(const Contestant& contestant);

    /// Drawn by another maker, with this one's baseline.
    [[nodiscard]] Result<TechniquePictures> make(const Contestant& contestant, PictureMaker& drawn_by);

    /// The parts of the skin, from the baseline's G-buffer and the reference's share of skin.
    [[nodiscard]] Result<SkinMasks> masks(const Image& skin);

    [[nodiscard]] const Technique& baseline() const { return baseline_; }

  private:
    [[nodiscard]] Result<Image> draw(const Technique& technique, const ParameterValues& values);
    [[nodiscard]] Result<const Image*> baseline_beside(const Contestant& contestant);

    Renderer& renderer_;
    const Technique& baseline_;
    PictureSettings settings_;
    std::map<std::string, Image> baseline_pictures_;
};

}  // namespace dermis::inline judge
