#pragma once
// The skin as points in space, from its texels, thinned out where they lie closer than a sum over them needs.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
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

/// One texel, or all of a small cube that face about the same way: their mass centre, and means by area.
struct SkinPoint {
    Vec3 p_mm;
    float area_mm2 = 0;
    float variance_mm2 = 0;  ///< along an axis, of the place in what was merged
    Vec3 n_geometry;
    Vec3 n;
    Vec3 squares, mixed;  ///< of the parts of n: xx, yy, zz; yz, xz, xy
};

/// The points that lie in one cube of space, and the box that bounds them.
struct SkinCube {
    size_t first = 0;  ///< number of its first point
    std::span<const SkinPoint> points;
    Vec3 low_mm, high_mm;

    [[nodiscard]] float squared_distance_mm2(Vec3 p_mm) const {
        const auto out = [](float x, float low, float high) {
            return std::max(std::max(low - x, x - high), 0.0f);
        };
        const Vec3 way{out(p_mm.x, low_mm.x, high_mm.x), out(p_mm.y, low_mm.y, high_mm.y),
                       out(p_mm.z, low_mm.z, high_mm.z)};
        return dot(way, way);
    }
};

/// Points in the order of the cubes that they lie in, so that those near a place are found.
class SkinPoints {
  public:
    /// One point a texel; order()[i] is the texel of point i.
    SkinPoints(std::span<const SkinTexel> texels, float cube_mm);
    /// `finer` merged over cubes of side_mm, in cubes of about cube_mm.
    SkinPoints(const SkinPoints& finer, float side_mm, float cube_mm);

    SkinPoints(SkinPoints&&) = default;  // a copy's cubes would show the points of the first

    [[nodiscard]] const std::vector<SkinPoint>& points() const { return points_; }
    [[nodiscard]] const std::vector<uint32_t>& order() const { return order_; }

    /// Calls body(cube, the cubes of `others` that may have points within reach_mm of one of its points) for
    /// one in `step` of the cubes, on all cores.
    using Near = std::span<const SkinCube* const>;
    void for_each_cube(const SkinPoints& others, float reach_mm, size_t step,
                       const std::function<void(const SkinCube& cube, Near near)>& body) const;
    [[nodiscard]] size_t number_of(const SkinPoint& point) const { return size_t(&point - points_.data()); }
    [[nodiscard]] size_t cube_count() const { return cubes_.size(); }
    [[nodiscard]] size_t cube_number_of(const SkinCube& cube) const { return size_t(&cube - cubes_.data()); }

  private:
    struct Place;
    void sort(std::vector<Place> places, const std::function<SkinPoint(std::span<const Place>)>& merged);
    [[nodiscard]] std::vector<const SkinCube*> around(Vec3 low_mm, Vec3 high_mm) const;

    std::vector<SkinPoint> points_;
    std::vector<uint32_t> order_;
    float cube_mm_;
    std::vector<SkinCube> cubes_;
    std::unordered_map<uint64_t, size_t> index_;
};

}  // namespace dermis::inline rays
