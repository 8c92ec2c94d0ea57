#pragma once
// A technique's pictures for the judge: drawn `grid` times the size and averaged, beside lambert's with all
// else equal.

#include <map>
#include <string>

#include "dermis/judge/scores.h"
#include "dermis/judge/technique_list.h"
#include "dermis/render/renderer.h"

namespace dermis::inline judge {

struct PictureSettings {
    int width = 512, height = 512;
    int grid = 4;  ///< a pixel is the average of grid x grid
    int shadow_map_size = 4096;
    float penumbra_mm = 2;
};

struct TechniquePictures {
    Image radiance;  ///< linear, RGBA; beyond the skin as drawn
    Image effect;    ///< RGB: radiance less lambert's
};

/// Keeps the pictures of lambert that it was asked for; one a setting of the parameters that lambert shares
/// with a technique (the specular model).
class PictureMaker {
  public:
    /// The renderer must outlive it; `lambert` is the technique without scattering.
    PictureMaker(Renderer& renderer, const Technique& lambert, const PictureSettings& settings)
        : renderer_(renderer), lambert_(lambert), settings_(settings) {}

    /// Errors name the contestant.
    [[nodiscard]] Result<TechniquePictures> make(const Contestant& contestant);

    /// The parts of the skin, from lambert's G-buffer and the truth's share of skin.
    [[nodiscard]] Result<SkinMasks> masks(const Image& skin);

  private:
    [[nodiscard]] Result<Image> draw(const Technique& technique, const ParameterValues& values);
    [[nodiscard]] Result<const Image*> lambert_beside(const Contestant& contestant);

    Renderer& renderer_;
    const Technique& lambert_;
    PictureSettings settings_;
    std::map<std::string, Image> lambert_pictures_;
};

}  // namespace dermis::inline judge
