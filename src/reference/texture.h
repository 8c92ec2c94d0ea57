#pragma once
// Maps as the ground truth reads them: level 0, bilinear, repeating. No mips: a pixel's footprint is averaged
// by its samples.

#include <array>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis {

/// Four channels at 8 bits where the file has 8, else in float; sRGB is decoded on every read. Missing
/// channels: one is grey, alpha is 1.
class Texture {
  public:
    Texture() = default;
    explicit Texture(const Image& image);

    [[nodiscard]] bool empty() const { return width_ == 0; }
    /// How many channels the image had, 1 to 4.
    [[nodiscard]] int channels() const { return channels_; }
    /// Linear; v runs down. Colours and alpha are interpolated after decoding.
    [[nodiscard]] Vec4 sample(Vec2 uv) const;

  private:
    [[nodiscard]] Vec4 texel(int x, int y) const;

    int width_ = 0, height_ = 0, channels_ = 0;
    std::vector<std::array<uint8_t, 4>> bytes_;
    std::vector<Vec4> floats_;
    std::array<float, 256> decoded_{};
};

}  // namespace dermis
