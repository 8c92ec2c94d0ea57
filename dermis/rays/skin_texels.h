#pragma once
// The skin as points, one a texel of its UV atlas.

#include <cstdint>
#include <memory>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

struct SkinTexel {
    uint32_t index = 0;  ///< in the map, rows from the top
    Vec3 p_mm;
    Vec3 n_geometry;
    Vec3 n;  ///< with the normal map, its mean over the texel: shorter than 1 where normals differ
    float area_mm2 = 0;  ///< 0 where the skin is inside a cavity (rays/flesh.h)
};

struct SkinTexels {
    int size = 0;
    std::vector<SkinTexel> texels;
    Image coverage;  ///< u8: 255 where skin lies
};

/// All skin of the scene that has UVs, which shares one atlas of `size` texels a side. Errors: a map that
/// cannot be read, the ray library fails.
class SkinTexelReader {
  public:
    [[nodiscard]] static Result<SkinTexelReader> create(const Scene& scene);
    ~SkinTexelReader();
    SkinTexelReader(SkinTexelReader&&) noexcept;
    [[nodiscard]] SkinTexels read(int size) const;

  private:
    struct Impl;
    explicit SkinTexelReader(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Median by area of a texel's side on the skin; 0 without texels.
[[nodiscard]] float typical_texel_mm(const SkinTexels& skin);

}  // namespace dermis::inline rays
