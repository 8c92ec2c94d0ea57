#pragma once
// A cube map on the CPU with a mip pyramid and borders, so that bilinear lookups see across face edges.

#include <vector>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline scene {

/// Direction (not unit) of a point of a face, s to the right and t down in 0..1; faces +X -X +Y -Y +Z -Z as
/// Vulkan has them (specification, "Cube Map Face Selection").
[[nodiscard]] Vec3 cube_direction(int face, float s, float t);

struct CubePoint {
    int face = 0;
    float s = 0, t = 0;
};
[[nodiscard]] CubePoint cube_point(Vec3 d);

/// Mean solid angle of a texel of a cube with `size` texels a side, steradian.
[[nodiscard]] float cube_texel_solid_angle(int size);

class CubePyramid {
  public:
    /// Level 0 has `size` (a power of two) texels a side, each the mean of 2 x 2 samples of the panorama; the
    /// last level has one.
    CubePyramid(const Image& panorama, int size);

    [[nodiscard]] int size() const { return levels_.front().size; }
    /// Trilinear; `level` is clamped to the pyramid.
    [[nodiscard]] Vec3 sample(Vec3 d, float level) const;
    [[nodiscard]] Vec3 texel(int level, int face, int x, int y) const;

  private:
    // A border of one texel on every side of every face.
    struct Level {
        int size = 0;
        std::vector<Vec3> texels;

        explicit Level(int side) : size(side), texels(size_t(6) * size_t(side + 2) * size_t(side + 2)) {}
        [[nodiscard]] const Vec3& at(int face, int x, int y) const { return texels[index(face, x, y)]; }
        [[nodiscard]] Vec3& at(int face, int x, int y) { return texels[index(face, x, y)]; }
        [[nodiscard]] size_t index(int face, int x, int y) const {
            const size_t stride = size_t(size) + 2;
            return (size_t(face) * stride + size_t(y + 1)) * stride + size_t(x + 1);
        }
        [[nodiscard]] Vec3 sample(const CubePoint& point) const;
        void fill_borders();
    };

    static Level half_size(const Level& level, std::vector<float>& solid_angles);

    std::vector<Level> levels_;
};

}  // namespace dermis::inline scene
