#pragma once
// Maps as the reference reads them: bilinear, beyond their edges as their material states. Where a pixel's
// footprint is averaged by its samples that is level 0; where every sample goes through the pixel's middle, a
// footprint picks from the same chain of smaller levels that a renderer without anisotropic filtering reads.

#include <array>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"
#include "dermis/mesh/material.h"

namespace dermis::inline rays {

/// How far uv moves from a pixel to its right and lower neighbour; zero: as sharp as the map is.
struct UvFootprint {
    Vec2 across, down;
    [[nodiscard]] bool is_zero() const { return across == Vec2{} && down == Vec2{}; }
};

/// Four channels at 8 bits where the file has 8, else in float; sRGB is decoded on every read. Missing
/// channels: one is grey, alpha is 1.
class Texture {
  public:
    Texture() = default;
    explicit Texture(const Image& image, TextureWrap u = TextureWrap::repeat,
                     TextureWrap v = TextureWrap::repeat);

    [[nodiscard]] bool empty() const { return levels_.empty(); }
    /// How many channels the image had, 1 to 4.
    [[nodiscard]] int channels() const { return channels_; }
    /// Linear; v runs down. Colours and alpha are interpolated after decoding. The level is the logarithm of
    /// the longer of the footprint's sides in texels (Vulkan specification, "Scale Factor Operation").
    [[nodiscard]] Vec4 sample(Vec2 uv, const UvFootprint& footprint = {}) const;

  private:
    struct Level {
        int width = 0, height = 0;
        std::vector<std::array<uint8_t, 4>> bytes;
        std::vector<Vec4> floats;
    };
    [[nodiscard]] Vec4 texel(const Level& level, int x, int y) const;
    [[nodiscard]] Vec4 decoded(std::array<uint8_t, 4> texel) const;
    [[nodiscard]] Vec4 sample_level(const Level& level, Vec2 uv) const;
    [[nodiscard]] Level half_size(const Level& level) const;

    int channels_ = 0;
    TextureWrap wrap_u_ = TextureWrap::repeat, wrap_v_ = TextureWrap::repeat;
    bool encoded_ = false;       // 8-bit colours are sRGB
    std::vector<Level> levels_;  // full to 1 x 1, each half the one before, as GPUs make them
    std::array<float, 256> decoded_{};
};

}  // namespace dermis::inline rays
