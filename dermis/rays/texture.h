#pragma once
// Maps as the reference reads them: bilinear, beyond their edges as their material states. Where a pixel's
// footprint is averaged by its samples that is level 0; where every sample goes through the pixel's middle, a
// footprint picks from the same chain of smaller levels that a renderer without anisotropic filtering reads.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"
#include "dermis/mesh/material.h"
#include "dermis/scene/scene.h"

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

// Where the alpha map of a material lets rays pass: cards of hair and lashes. The renderer has the same rules
// (shaders/include/cut_out.glsl, shaders/renderer/standard.frag).

/// The alpha of one material on its mesh, which must outlive it.
class CutOutMap {
  public:
    /// Null for a material that is whole. Errors name the map.
    [[nodiscard]] static Result<std::unique_ptr<CutOutMap>> load(const SceneObject& object,
                                                                 uint32_t material);

    /// The map's times the vertices', at the barycentric weights u and v of the second and third corner.
    [[nodiscard]] float alpha(uint32_t triangle, float u, float v) const;
    [[nodiscard]] bool passes(uint32_t triangle, float u, float v) const {
        return alpha(triangle, u, v) < cutoff_;
    }
    /// For rays that blend what they meet.
    [[nodiscard]] bool shows_nothing(uint32_t triangle, float u, float v) const {
        return is_blended_ ? alpha(triangle, u, v) == 0 : passes(triangle, u, v);
    }

  private:
    CutOutMap(const Mesh& mesh, float cutoff, bool is_blended, Texture alpha)
        : mesh_(&mesh), cutoff_(cutoff), is_blended_(is_blended), alpha_(std::move(alpha)) {}

    const Mesh* mesh_;
    float cutoff_;
    bool is_blended_;
    Texture alpha_;
};

}  // namespace dermis::inline rays
